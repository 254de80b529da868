// SPDX-License-Identifier: BSD-3-Clause
// Shells that touch themselves, each other and rigid bodies: they never pass through, and no energy appears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "shell/dynamics.hpp"
#include "shell/statics.hpp"
#include "support/shells.hpp"
#include "support/surfaces.hpp"

namespace luff::shell {
namespace {

// Sheets of some centimetres as thin and soft as tissue, with the mass of the water that moves with them [SI].
constexpr double thickness = 5e-4;
constexpr ContactLaw law{.distance = thickness, .stiffness = 1000};

Properties soft()
{
  return {.thickness = thickness,
          .density = 9000,
          .material = SaintVenantKirchhoff{.young = 5e5, .poisson = 0.4},
          .damping_mass = 20};
}

DynamicsOptions options_with(std::optional<ContactOptions> contact)
{
  DynamicsOptions options;
  options.scheme = TimeScheme::newmark(0.1);
  options.contact = std::move(contact);
  options.fold_limit = 180;
  return options;
}

/// What happened on the way.
struct Course {
  int crossings = 0;  ///< edges through triangles, whether contact was on or not
  int most_pairs = 0;
  double smallest_gap = 1;
  double largest_energy = 0;
  double energy_gained = 0;  ///< largest growth of what should stay constant
  int steps = 0;
  long iterations = 0;
  int halvings = 0;
};

double total(const EnergyLedger& e)
{
  return e.kinetic + e.elastic + e.contact + e.damping_work - e.external_work;
}

/// One step from the accepted state; false when it must be repeated with half its length.
bool advance(Dynamics& dynamics, double dt, Course& course)
{
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * dynamics.shell().n_vertices());
  const double t = dynamics.accepted().t + dt;
  try {
    const Dynamics::Trial trial = dynamics.solve(t, dt, none, dynamics.predicted_positions(dt));
    dynamics.accept(trial.positions, t, dt, none);
    course.iterations += trial.report.iterations;
  } catch (const NonConvergence&) {
    ++course.halvings;
    return false;
  }
  ++course.steps;
  return true;
}

void watch(const Dynamics& dynamics, const ContactPieces& pieces, double start, Course& course)
{
  const EnergyLedger& e = dynamics.ledger();
  course.largest_energy = std::max(course.largest_energy, e.kinetic + e.elastic + e.contact);
  course.energy_gained = std::max(course.energy_gained, total(e) - start);
  if (dynamics.contact() == nullptr) {
    course.crossings += crossings(pieces, dynamics.accepted().x, true).count;
    return;
  }
  const ContactReport& report = dynamics.contact()->report();
  course.smallest_gap = std::min(course.smallest_gap, report.smallest_gap);
  course.most_pairs = std::max(course.most_pairs, report.active_pairs);
  course.crossings += dynamics.contact()->crossings().count;
}

/// March to t_end, halving steps that find no equilibrium as the time loop does.
Course march(Dynamics& dynamics, double dt, double t_end)
{
  const ContactPieces pieces(std::vector<ContactSheet>{{"shell", dynamics.shell().reference(), true}});
  const double start = total(dynamics.ledger());
  Course course;
  int halvings = 0;
  while (dynamics.accepted().t < t_end * (1 - 1e-9)) {
    const bool done = advance(dynamics, std::ldexp(dt, -halvings), course);
    halvings = done ? 0 : halvings + 1;
    if (halvings > 3)
      ADD_FAILURE() << "no equilibrium with an eighth of the step at t = " << dynamics.accepted().t;
    if (halvings > 3)
      return course;
    if (done)
      watch(dynamics, pieces, start, course);
  }
  return course;
}

surface::TriangleMesh joined(surface::TriangleMesh a, const surface::TriangleMesh& b)
{
  test::append(a, b);
  return a;
}

surface::TriangleMesh mapped(surface::TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& place)
{
  for (Vec3& X : mesh.vertices)
    X = place(X);
  return mesh;
}

/// Two leaflets of 2 cm that stand clamped 4 mm apart, of different meshes, blown together from outside.
struct Leaflets {
  surface::TriangleMesh mesh =
      joined(mapped(test::sheet(0.02, 0.02, 6, 6), [](const Vec3& X) { return Vec3(X.y(), -0.002, X.x()); }),
             mapped(test::sheet(0.02, 0.02, 5, 7), [](const Vec3& X) { return Vec3(X.y(), 0.002, X.x()); }));
  Shell shell{mesh,
              soft(),
              {{.kind = SupportKind::Clamped,
                .vertices = test::vertices_where(mesh, [](const Vec3& X) { return X.z() == 0; })}},
              "leaflets"};

  /// Towards the plane between them on both.
  static Load pressed(double pressure)
  {
    const auto p = [pressure](const Vec3& X, double t) {
      return std::copysign(pressure, -X.y()) * std::min(1.0, t / 0.02);
    };
    return Pressure{{}, p};
  }
};

TEST(ShellContact, KeepsTwoLeafletsApartThatAreBlownTogether)
{
  const Leaflets leaflets;
  const double sign = surface::unit_normal(leaflets.mesh, 0).y();
  Dynamics dynamics(leaflets.shell, {Leaflets::pressed(150 * sign)}, options_with(ContactOptions{.law = law}));
  const Course course = march(dynamics, 1e-3, 0.08);
  EXPECT_EQ(course.crossings, 0);
  EXPECT_GT(course.most_pairs, 100);
  EXPECT_GT(course.smallest_gap, 0.05 * thickness);
  EXPECT_LT(course.energy_gained, 0.02 * course.largest_energy);
  EXPECT_LE(course.halvings, 2);
  EXPECT_LT(course.iterations, 8L * course.steps);
}

TEST(ShellContact, IsWhatKeepsThemApart)
{
  const Leaflets leaflets;
  const double sign = surface::unit_normal(leaflets.mesh, 0).y();
  Dynamics dynamics(leaflets.shell, {Leaflets::pressed(150 * sign)}, options_with(std::nullopt));
  EXPECT_GT(march(dynamics, 1e-3, 0.08).crossings, 100);
}

/// A strip bent to a hairpin: a leg of 3 cm, half a circle of radius 3 mm, and the leg back.
surface::TriangleMesh hairpin()
{
  constexpr double leg = 0.03, radius = 0.003, bend = std::numbers::pi * radius;
  return mapped(test::sheet(2 * leg + bend, 0.008, 30, 3), [=](const Vec3& X) {
    const double s = X.x();
    if (s <= leg)
      return Vec3(s, X.y(), 0);
    if (s >= leg + bend)
      return Vec3(2 * leg + bend - s, X.y(), 2 * radius);
    const double angle = (s - leg) / radius;
    return Vec3(leg + radius * std::sin(angle), X.y(), radius * (1 - std::cos(angle)));
  });
}

struct Hairpin {
  surface::TriangleMesh mesh = hairpin();
  Shell shell{mesh,
              soft(),
              {{.kind = SupportKind::Clamped,
                .vertices = test::vertices_where(mesh, [](const Vec3& X) { return X.x() == 0 && X.z() == 0; })}},
              "hairpin"};

  Load squeeze() const
  {
    const double sign = surface::unit_normal(mesh, 0).z() > 0 ? 1 : -1;  // of the lower leg; the upper's is opposite
    return Pressure{{}, [=](const Vec3&, double t) { return sign * 20 * std::min(1.0, t / 0.05); }};
  }
};

TEST(ShellContact, KeepsAStripFromPassingThroughItselfWhenItFolds)
{
  const Hairpin pin;
  Dynamics dynamics(pin.shell, {pin.squeeze()}, options_with(ContactOptions{.law = law}));
  const Course course = march(dynamics, 2e-3, 0.12);
  EXPECT_EQ(course.crossings, 0);
  EXPECT_GT(course.most_pairs, 50);
  EXPECT_LT(course.energy_gained, 0.02 * course.largest_energy);
  EXPECT_LE(course.halvings, 2);

  Dynamics unaware(pin.shell, {pin.squeeze()}, options_with(std::nullopt));
  EXPECT_GT(march(unaware, 2e-3, 0.12).crossings, 0) << "without contact it does pass";
}

TEST(ShellContact, CatchesASheetThatFallsOnARisingBody)
{
  Properties p = soft();
  p.gravity = Vec3(0, 0, -10);
  const surface::TriangleMesh mesh =
      mapped(test::sheet(0.04, 0.04, 7, 7), [](const Vec3& X) -> Vec3 { return X + Vec3(-0.02, -0.02, 0.004); });
  const Shell shell(mesh, p, {}, "sheet");
  // Two triangles of 2 cm, turned a little against the sheet, that rise by 3 mm.
  const surface::TriangleMesh plate = surface::rectangle(
      {.origin = Vec3(-0.011, -0.009, 0), .a = Vec3(0.02, 0.003, 0), .b = Vec3(-0.003, 0.02, 0), .divisions = {1, 1}});
  ContactOptions contact{.law = law, .bodies = {{"plate", plate, false}}};
  contact.body_positions = [plate](double t) {
    Eigen::VectorXd x = surface::interleaved(plate.vertices);
    for (Eigen::Index v = 0; v < x.size() / 3; ++v)
      x[3 * v + 2] += 0.0015 * (1 - std::cos(std::numbers::pi * std::min(1.0, t / 0.05)));
    return x;
  };
  Dynamics dynamics(shell, {}, options_with(contact));
  const Course course = march(dynamics, 1e-3, 0.06);
  EXPECT_EQ(course.crossings, 0);
  EXPECT_GT(course.most_pairs, 5);
  EXPECT_LT(course.energy_gained, 0.02 * course.largest_energy);
  double lowest_above_plate = 1;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.vertices[v].head<2>().norm() < 0.007)
      lowest_above_plate = std::min(lowest_above_plate, dynamics.accepted().x[3 * v + 2]);
  EXPECT_GT(lowest_above_plate, 0.003) << "free fall would have taken it to -0.014";
}

TEST(ShellContact, OfTwoFreeSheetsKeepsTheirMomentum)
{
  const surface::TriangleMesh mesh = joined(
      test::sheet(0.02, 0.02, 4, 4),
      mapped(test::sheet(0.02, 0.02, 3, 5), [](const Vec3& X) -> Vec3 { return X + Vec3(0.004, 0.002, 0.002); }));
  Properties p = soft();
  p.damping_mass = 0;
  const Shell shell(mesh, p, {}, "sheets");
  Eigen::VectorXd v0 = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v)
    v0[3 * v + 2] = mesh.vertices[v].z() > 0 ? -0.1 : 0;
  Dynamics dynamics(shell, {}, options_with(ContactOptions{.law = law}), 0, v0);
  const auto momentum = [&](const Eigen::VectorXd& v) {
    const Eigen::VectorXd Mv = shell.mass_times(v);
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index i = 0; i < Mv.size(); i += 3)
      sum += Mv.segment<3>(i);
    return sum;
  };
  const Course course = march(dynamics, 1e-3, 0.06);
  EXPECT_GT(course.most_pairs, 20);
  EXPECT_EQ(course.crossings, 0);
  const Vec3 before = momentum(v0), after = momentum(dynamics.accepted().v);
  EXPECT_LT((after - before).norm(), 1e-4 * before.norm()) << "Newton's method stops at 1e-6 of the forces";
  EXPECT_LT(course.energy_gained, 0.02 * course.largest_energy);
}

TEST(ShellContact, GoesOnFromACheckpointWithTheSameBits)
{
  const Leaflets leaflets;
  const double sign = surface::unit_normal(leaflets.mesh, 0).y();
  const std::vector<Load> loads{Leaflets::pressed(150 * sign)};
  const DynamicsOptions options = options_with(ContactOptions{.law = law});
  Dynamics dynamics(leaflets.shell, loads, options);
  Course course;
  while (dynamics.contact()->report().active_pairs == 0 && dynamics.accepted().t < 0.08)
    ASSERT_TRUE(advance(dynamics, 1e-3, course));
  ASSERT_GT(dynamics.contact()->report().active_pairs, 0);
  Dynamics again(leaflets.shell, loads, options);
  again.restore(dynamics.checkpoint());
  for (int step = 0; step < 2; ++step) {
    ASSERT_TRUE(advance(dynamics, 5e-4, course));
    ASSERT_TRUE(advance(again, 5e-4, course));
  }
  EXPECT_EQ(dynamics.accepted().x, again.accepted().x);
  EXPECT_EQ(dynamics.ledger().contact, again.ledger().contact);
}

StaticOptions statics_with(std::optional<ContactOptions> contact, int steps)
{
  StaticOptions options;
  options.steps = steps;
  options.time = 1;
  options.fold_limit = 180;
  options.contact = std::move(contact);
  return options;
}

/// The worst of all equilibria on the way, and the last.
struct Stills {
  StaticStep last;
  int crossings = 0;
  int most_pairs = 0;
  double smallest_gap = 1;
  int iterations = 0;
};

Stills load_up(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options)
{
  Stills stills;
  stills.last = solve_static(shell, loads, options, [&](const StaticStep& step) {
    stills.iterations += step.iterations;
    if (!step.contact)
      return;
    EXPECT_EQ(step.report.negative_pivots, 0) << "the equilibrium is stable";
    stills.crossings += step.contact->crossings;
    stills.most_pairs = std::max(stills.most_pairs, step.contact->report.active_pairs);
    stills.smallest_gap = std::min(stills.smallest_gap, step.contact->report.smallest_gap);
  });
  return stills;
}

TEST(StaticContact, PressesTwoLeafletsTogetherToWhereTheirDampedMotionEnds)
{
  const Leaflets leaflets;
  const std::vector<Load> loads{Traction{{}, [](const Vec3& X, double t) -> Vec3 {
                                           return {0, std::copysign(50 * std::min(1.0, t / 0.02), -X.y()), 0};
                                         }}};
  const Stills stills = load_up(leaflets.shell, loads, statics_with(ContactOptions{.law = law}, 10));
  Dynamics dynamics(leaflets.shell, loads, options_with(ContactOptions{.law = law}));
  march(dynamics, 1e-3, 0.08);
  march(dynamics, 1e-2, 1.2);
  const double apart = (dynamics.accepted().x - stills.last.positions).lpNorm<Eigen::Infinity>();
  std::printf("  %d iterations, %d pairs; %.1e of the thickness apart\n", stills.iterations, stills.most_pairs,
              apart / thickness);
  EXPECT_EQ(stills.crossings, 0);
  EXPECT_GT(stills.most_pairs, 50);
  EXPECT_LT(stills.iterations, 100);
  EXPECT_LT(apart, 1e-3 * thickness);
}

TEST(StaticContact, PressesTwoLeafletsTogetherByAPressureToABalanceOfTheirMotion)
{
  const Leaflets leaflets;
  // The edges are free: the pressure has no potential, and its stiffness is not symmetric.
  const std::vector<Load> loads{Leaflets::pressed(150 * surface::unit_normal(leaflets.mesh, 0).y())};
  const Stills stills = load_up(leaflets.shell, loads, statics_with(ContactOptions{.law = law}, 10));
  EXPECT_EQ(stills.crossings, 0);
  EXPECT_GT(stills.most_pairs, 100);
  EXPECT_LT(stills.iterations, 100);
  Dynamics dynamics(leaflets.shell, loads, options_with(ContactOptions{.law = law}));
  Checkpoint still = dynamics.checkpoint();
  still.state = {stills.last.positions, Eigen::VectorXd::Zero(still.state.x.size()),
                 Eigen::VectorXd::Zero(still.state.x.size()), 1};
  dynamics.restore(still);
  march(dynamics, 2e-3, 1.02);
  const double moved = (dynamics.accepted().x - stills.last.positions).lpNorm<Eigen::Infinity>();
  std::printf("  %d iterations, %d pairs, gap %.3g; moved by %.1e of the thickness\n", stills.iterations,
              stills.most_pairs, stills.smallest_gap, moved / thickness);
  EXPECT_LT(moved, 1e-3 * thickness) << "a hundredth of the pressure would move them by a tenth";
}

TEST(StaticContact, LaysAStripOnItself)
{
  const Hairpin pin;
  const std::vector<Load> loads{Traction{{}, [](const Vec3& X, double) -> Vec3 {
                                           return {0, 0, X.z() > 0.003 ? -20.0 : 0.0};
                                         }}};
  const Stills stills = load_up(pin.shell, loads, statics_with(ContactOptions{.law = law}, 10));
  std::printf("  static: %d iterations, %d pairs, gap %.3g\n", stills.iterations, stills.most_pairs,
              stills.smallest_gap);
  EXPECT_EQ(stills.crossings, 0);
  EXPECT_GT(stills.most_pairs, 15);

  StaticOptions unaware = statics_with(std::nullopt, 10);
  unaware.stabilisation = Stabilisation::Damping;
  const ContactPieces pieces(std::vector<ContactSheet>{{"pin", pin.mesh, true}});
  int most = 0;
  solve_static(pin.shell, loads, unaware,
               [&](const StaticStep& step) { most = std::max(most, crossings(pieces, step.positions, true).count); });
  EXPECT_GT(most, 0) << "without contact it passes through itself";
}

TEST(StaticContact, BendsAStripOverABodyThatComesUpWithTheLoad)
{
  const surface::TriangleMesh mesh = test::sheet(0.04, 0.01, 16, 4);
  const Shell shell(mesh, soft(),
                    {{.kind = SupportKind::Clamped,
                      .vertices = test::vertices_where(mesh, [](const Vec3& X) { return X.x() == 0; })}},
                    "strip");
  const surface::TriangleMesh plate = surface::rectangle(
      {.origin = Vec3(0.03, -0.005, -0.002), .a = Vec3(0.02, 0, 0), .b = Vec3(0, 0.02, 0), .divisions = {1, 1}});
  ContactOptions contact{.law = law, .bodies = {{"plate", plate, false}}};
  contact.body_positions = [plate](double factor) {
    Eigen::VectorXd x = surface::interleaved(plate.vertices);
    for (Eigen::Index v = 0; v < x.size() / 3; ++v)
      x[3 * v + 2] += 0.012 * factor;
    return x;
  };
  const Stills stills = load_up(shell, {}, statics_with(contact, 6));
  std::printf("  static: %d iterations, %d pairs, gap %.3g\n", stills.iterations, stills.most_pairs,
              stills.smallest_gap);
  EXPECT_EQ(stills.crossings, 0);
  EXPECT_GT(stills.most_pairs, 3);
  double lowest_above_plate = 1;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.vertices[v].x() > 0.035)
      lowest_above_plate = std::min(lowest_above_plate, stills.last.positions[3 * v + 2]);
  EXPECT_GT(lowest_above_plate, 0.01) << "where the plate comes to";
}

TEST(StaticContact, RefusesDampingBesideIt)
{
  const Hairpin pin;
  StaticOptions options = statics_with(ContactOptions{.law = law}, 1);
  options.stabilisation = Stabilisation::Damping;
  EXPECT_THROW(solve_static(pin.shell, {}, options), InputError);
}

}  // namespace
}  // namespace luff::shell
