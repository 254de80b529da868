// SPDX-License-Identifier: BSD-3-Clause
// Static equilibrium through limit points, snap-back and bifurcations.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/path_following.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

/// Half of a shallow two-bar truss: a strip from a hinge up to the crown, which moves only along z. It stays straight,
/// so that the vertical force at which the crown has sunk by w is, in the Green-Lagrange strain,
///
///   P = E A w (H - w)(2 H - w) / (2 l^3),       largest and smallest: +- E A H^3 / (3 sqrt(3) l^3).
struct TwoBarTruss {
  static constexpr double rise = 0.1, span = 1, width = 0.25, thickness = 0.1, young = 1e6;

  TwoBarTruss()
      : mesh(bar()),
        crown(test::vertices_where(mesh, [](const Vec3& X) { return X.x() == span; })),
        shell(
            mesh, {.thickness = thickness, .density = 1, .material = SaintVenantKirchhoff{young, 0}},
            {{.kind = SupportKind::Hinged, .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })},
             {.kind = SupportKind::Fixed, .vertices = crown, .components = {true, true, false}}})
  {
  }

  static surface::TriangleMesh bar()
  {
    surface::TriangleMesh mesh = test::sheet(span, width, 6, 2);
    for (Vec3& X : mesh.vertices)
      X.z() = rise * X.x() / span;
    return mesh;
  }

  static double force(double w)
  {
    const double l = std::hypot(span, rise);
    return young * width * thickness * w * (rise - w) * (2 * rise - w) / (2 * l * l * l);
  }
  static double limit_force() { return force(rise * (1 - 1 / std::sqrt(3.0))); }

  /// Grow to 2.2 times the limit force.
  static double full_force() { return 2.2 * limit_force(); }
  std::vector<Load> loads() const
  {
    return {PointForce{crown, [](const Vec3&, double) { return Vec3(0, 0, -full_force()); }}};
  }
  double sinking(const Eigen::VectorXd& x) const { return rise - x[3 * crown.front() + 2]; }

  surface::TriangleMesh mesh;
  std::vector<int> crown;
  Shell shell;
};

std::string message_of(const std::function<void()>& act)
{
  try {
    act();
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

TEST(TwoBarTruss, LoadControlStopsAtTheLimitPointAndSaysSo)
{
  const TwoBarTruss truss;
  double reached = 0;
  const std::string message = message_of([&] {
    solve_static(truss.shell, truss.loads(), {.steps = 10},
                 [&](const StaticStep& step) { reached = step.load_factor; });
  });
  EXPECT_EQ(reached, 0.4);
  EXPECT_NE(message.find("limit point near load factor 0.45"), std::string::npos) << message;
  EXPECT_NE(message.find("arc-length"), std::string::npos);
  EXPECT_NE(message.find("displacement-control"), std::string::npos);
}

TEST(TwoBarTruss, ArcLengthFollowsTheExactPathThroughBothLimitPoints)
{
  const TwoBarTruss truss;
  double largest_error = 0, highest = 0, lowest = 1;
  const StaticStep last =
      follow_arc_length(truss.shell, truss.loads(), {.statics = {.steps = 20}}, [&](const StaticStep& step) {
        const double w = truss.sinking(step.positions), limit = TwoBarTruss::limit_force();
        largest_error = std::max(
            largest_error, std::abs(TwoBarTruss::full_force() * step.load_factor - TwoBarTruss::force(w)) / limit);
        const double s = (TwoBarTruss::rise - w) / TwoBarTruss::rise;
        EXPECT_EQ(step.report.negative_pivots, std::abs(s) < 1 / std::sqrt(3.0) ? 1 : 0) << s;
        if (s > 0)
          highest = std::max(highest, step.load_factor);
        lowest = std::min(lowest, step.load_factor);
      });
  EXPECT_EQ(last.load_factor, 1);
  std::printf("  %d steps, largest error %.1e of the limit force; turned at %.4f and %.4f of the full load\n",
              last.step, largest_error, highest, lowest);
  EXPECT_LT(largest_error, 1e-9);
  EXPECT_GT(highest, 0.43);
  EXPECT_LT(lowest, -0.43);
}

TEST(TwoBarTruss, DisplacementControlFollowsTheSamePath)
{
  const TwoBarTruss truss;
  const ControlledDisplacement crown{truss.crown, 2, -2.2 * TwoBarTruss::rise};
  double largest_error = 0;
  const StaticStep last =
      control_displacement(truss.shell, truss.loads(), crown, {.steps = 22}, [&](const StaticStep& step) {
        const double w = truss.sinking(step.positions), limit = TwoBarTruss::limit_force();
        EXPECT_NEAR(w, 0.1 * TwoBarTruss::rise * step.step, 1e-12);
        largest_error = std::max(
            largest_error, std::abs(TwoBarTruss::full_force() * step.load_factor - TwoBarTruss::force(w)) / limit);
      });
  EXPECT_EQ(last.step, 22);
  EXPECT_LT(largest_error, 1e-9);
}

TEST(TwoBarTruss, DisplacementControlAgreesWithLoadControlBeforeTheLimit)
{
  const TwoBarTruss truss;
  std::vector<Load> below = truss.loads();
  std::get<PointForce>(below[0]).force = [](const Vec3&, double) {
    return Vec3(0, 0, -0.9 * TwoBarTruss::limit_force());
  };
  const StaticStep by_load = solve_static(truss.shell, below, {.steps = 4});
  const StaticStep by_displacement =
      control_displacement(truss.shell, below, {truss.crown, 2, -truss.sinking(by_load.positions)}, {.steps = 4});
  EXPECT_NEAR(by_displacement.load_factor, 1, 1e-9);
  EXPECT_LT((by_load.positions - by_displacement.positions).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(TwoBarTruss, DampingSnapsToTheStableEquilibriumOfTheExactPath)
{
  const TwoBarTruss truss;
  int snaps = 0;
  const StaticStep last = solve_static(
      truss.shell, truss.loads(), {.steps = 10, .stabilisation = Stabilisation::Damping}, [&](const StaticStep& step) {
        snaps += step.damped_iterations > 0 ? 1 : 0;
        const double w = truss.sinking(step.positions), limit = TwoBarTruss::limit_force();
        EXPECT_NEAR(TwoBarTruss::force(w), TwoBarTruss::full_force() * step.load_factor, 1e-8 * limit);
        EXPECT_EQ(w > TwoBarTruss::rise, step.load_factor > 1 / 2.2) << step.load_factor;
        EXPECT_EQ(step.report.negative_pivots, 0);
      });
  EXPECT_EQ(last.load_factor, 1);
  EXPECT_EQ(snaps, 1);
}

/// A quarter of a hinged cylindrical roof under a central force [sze_2004_popular], section 3.6 of the paper; thickness
/// 6.35: it snaps back.
struct Roof {
  static constexpr double radius = 2540, half_length = 254, half_angle = 0.1, force = 3000;

  explicit Roof(double thickness, int n = 8)
      : mesh(quarter(n)),
        shell(mesh, {.thickness = thickness, .density = 1, .material = SaintVenantKirchhoff{3102.75, 0.3}}, supports())
  {
  }

  static surface::TriangleMesh quarter(int n)
  {
    surface::TriangleMesh mesh = test::sheet(half_length, half_angle, n, n, surface::Pattern::Alternating);
    for (Vec3& X : mesh.vertices)
      X = Vec3(X.x(), radius * std::sin(X.y()), radius * std::cos(X.y()));
    return mesh;
  }

  /// A straight edge of a curved mesh doesn't tell the plane of symmetry: the normals are given.
  std::vector<Support> supports() const
  {
    const auto where = [&](auto holds) { return test::vertices_where(mesh, holds); };
    const double edge = radius * std::sin(half_angle);
    const auto side = where([=](auto& X) { return X.y() == edge; });
    const auto middle = where([](auto&X) { return X.x() == 0; }), crown = where([](auto&X) { return X.y() == 0; });
    return {{.kind = SupportKind::Hinged, .vertices = side},
            {.kind = SupportKind::Symmetry, .vertices = middle, .normal = Vec3(1, 0, 0)},
            {.kind = SupportKind::Symmetry, .vertices = crown, .normal = Vec3(0, 1, 0)}};
  }

  std::vector<int> centre() const
  {
    return test::vertices_where(mesh, [](auto& X) { return X.x() == 0 && X.y() == 0; });
  }
  std::vector<Load> loads() const
  {
    return {PointForce{centre(), [](const Vec3&, double) { return Vec3(0, 0, -force / 4); }}};
  }
  double sinking(const Eigen::VectorXd& x) const { return radius - x[3 * centre().front() + 2]; }

  surface::TriangleMesh mesh;
  Shell shell;
};

TEST(Roof, ArcLengthPassesASnapBackWhereDisplacementControlStops)
{
  const Roof roof(6.35);
  double sunk_most_before_turning = 0, lowest = 1;
  bool turned_back = false;
  const StaticStep last = follow_arc_length(roof.shell, roof.loads(), {.statics = {.steps = 40}},
                                            [&, previous = 0.0](const StaticStep& step) mutable {
                                              const double w = roof.sinking(step.positions);
                                              if (w < previous && !turned_back) {
                                                turned_back = true;
                                                sunk_most_before_turning = previous;
                                              }
                                              lowest = std::min(lowest, step.load_factor);
                                              previous = w;
                                            });
  std::printf("  %d steps; turned back at w = %.2f, lowest load %.0f, full load at w = %.3f\n", last.step,
              sunk_most_before_turning, lowest * Roof::force, roof.sinking(last.positions));
  EXPECT_TRUE(turned_back);
  // On 24 x 24 squares: -386.
  EXPECT_NEAR(lowest * Roof::force, -386, 0.02 * 386);
  const std::string message = message_of([&] {
    control_displacement(
        roof.shell, roof.loads(), {roof.centre(), 2, -1.2 * sunk_most_before_turning}, {.steps = 40, .max_halvings = 4},
        [&](const StaticStep& step) { EXPECT_LT(roof.sinking(step.positions), 1.01 * sunk_most_before_turning); });
  });
  EXPECT_NE(message.find("snaps back"), std::string::npos) << message;

  const StaticStep snapped =
      solve_static(roof.shell, roof.loads(), {.steps = 10, .stabilisation = Stabilisation::Damping});
  EXPECT_EQ(snapped.load_factor, 1);
  EXPECT_LT((snapped.positions - last.positions).lpNorm<Eigen::Infinity>(), 1e-8 * roof.shell.size());
}

// A straight column stays an equilibrium beyond Euler's load, an unstable one. The elastica with ends turned by 60
// degrees bows out by 0.593 / 2 of its length at 1.152 times Euler's load [timoshenko_1961_theory], table 2-4.
TEST(Column, NegativePivotsTellThatAStraightColumnIsUnstableAndDampingBendsIt)
{
  const double h = 0.02, young = 1e6, width = 0.1;
  const surface::TriangleMesh mesh = test::sheet(1, width, 64, 2, surface::Pattern::Alternating);
  const auto foot = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; });
  const auto head = test::vertices_where(mesh, [](auto& X) { return X.x() == 1; });
  const Shell column(mesh, {.thickness = h, .density = 1, .material = SaintVenantKirchhoff{young, 0}},
                     {{.kind = SupportKind::Hinged, .vertices = foot},
                      {.kind = SupportKind::Fixed, .vertices = head, .components = {false, true, true}}});
  const double euler = std::numbers::pi * std::numbers::pi * young * width * h * h * h / 12;
  const std::vector<Load> push{PointForce{head, [=](const Vec3&, double) { return Vec3(-1.152 * euler, 0, 0); }}};
  const auto bow = [&](const Eigen::VectorXd& x) {
    double most = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v)
      most = std::max(most, std::abs(x[3 * v + 2]));
    return most;
  };
  solve_static(column, push, {.steps = 5}, [&](const StaticStep& step) {
    EXPECT_LT(bow(step.positions), 1e-9);
    EXPECT_EQ(step.report.negative_pivots, step.step == 5 ? 1 : 0);
  });
  const StaticStep bent = solve_static(column, push, {.steps = 5, .stabilisation = Stabilisation::Damping});
  std::printf("  bows out by %.4f of its length at 1.152 times Euler's load\n", bow(bent.positions));
  EXPECT_EQ(bent.report.negative_pivots, 0);
  EXPECT_NEAR(bow(bent.positions), 0.2965, 0.01 * 0.2965);
}

}  // namespace
}  // namespace luff::shell
