// SPDX-License-Identifier: BSD-3-Clause
// Supports that move, springs, and planes of symmetry in any direction.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "core/error.hpp"
#include "shell/dynamics.hpp"
#include "shell/modes.hpp"
#include "shell/statics.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"
#include "support/surfaces.hpp"

namespace luff::shell {
namespace {

const Properties soft{.thickness = 0.02, .density = 3, .material = SaintVenantKirchhoff{1e5, 0.3}};

template <class Predicate>
std::vector<int> where(const surface::TriangleMesh& mesh, Predicate holds)
{
  return test::vertices_where(mesh, holds);
}

Motion turn_and_shift(double degrees, const Vec3& shift)
{
  return {.translation = [=](const Vec3&, double t) -> Vec3 { return t * shift; },
          .rotation = Motion::Rotation{Vec3(1, 2, -1), Vec3(0.3, -0.2, 0.1),
                                       [=](double t) { return t * degrees * M_PI / 180; }}};
}

// Clamped along two edges that meet, so that images of images turn too.
TEST(MovingSupport, RigidMotionOfAClampTakesACurvedShellAlongWithoutStrain)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const Motion motion = turn_and_shift(140, Vec3(3, -2, 1));
  const std::vector<int> edges = where(mesh, [](auto& X) { return X.x() == 0 || X.y() == 0; });
  const Shell shell(mesh, soft, {{.kind = SupportKind::Clamped, .vertices = edges, .motion = motion}});
  const StaticStep last = solve_static(shell, {}, {.steps = 40, .time = 1});
  const Images images = shell.images_at(last.positions, 1);
  double largest = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    largest = std::max(largest, (Vec3(last.positions.segment<3>(3 * v)) - motion.position(mesh.vertices[v], 1)).norm());
  const double scale = 1e5 * 0.02 * surface::total_area(mesh);
  std::printf("  energy %.1e of E h A, largest distance from the rigid motion %.1e\n",
              shell.elastic_energy(last.positions, images) / scale, largest);
  EXPECT_LT(shell.elastic_energy(last.positions, images), 1e-12 * scale);
  EXPECT_LT(largest, 1e-9);
  // The images of the reference would bend it.
  EXPECT_GT(shell.elastic_energy(last.positions), 1e-6 * scale);
}

// Both ends of a flat strip turn towards each other: a beam bent by end rotations +-theta without force has the
// curvature 2 theta/L.
TEST(MovingSupport, ClampsThatTurnBendAStripLikeABeam)
{
  const double theta = 1e-4;
  const surface::TriangleMesh mesh = test::sheet(1, 0.1, 24, 2, surface::Pattern::Alternating);
  const auto turned = [&](double x, double sign) {
    return Support{.kind = SupportKind::Clamped,
                   .vertices = where(mesh, [=](auto& X) { return X.x() == x; }),
                   .motion = Motion{.rotation = Motion::Rotation{Vec3::UnitY(), Vec3(x, 0, 0),
                                                                 [=](double) { return sign * theta; }}}};
  };
  Properties beam = soft;
  beam.thickness = 0.005;
  beam.material = SaintVenantKirchhoff{1e6, 0};
  const Shell strip(mesh, beam, {turned(0, -1), turned(1, 1)});
  const StaticStep bent = solve_static(strip, {}, {.steps = 1, .time = 1});
  const double EI = 1e6 * std::pow(0.005, 3) / 12 * 0.1;
  const double energy = strip.elastic_energy(bent.positions, strip.images_at(bent.positions, 1));
  const double middle = bent.positions[3 * where(mesh, [](auto& X) { return X.x() == 0.5; })[1] + 2];
  std::printf("  energy over EI (2 theta/L)^2 L/2: %.4f, height over theta L/4: %.4f\n",
              energy / (EI * 2 * theta * theta), middle / (theta / 4));
  EXPECT_NEAR(middle / (theta / 4), 1, 0.02);
  EXPECT_NEAR(energy / (EI * 2 * theta * theta), 1, 0.02);
}

TEST(MovingSupport, HeldVerticesMoveAsPrescribedAndTheLedgerCountsTheirWork)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.4, 6, 3);
  const Motion motion{
      .translation = [](const Vec3& X, double t) { return Vec3(0, 0.2 * t * t * X.y(), 0.1 * (1 - std::cos(9 * t))); },
      .rotation = Motion::Rotation{Vec3::UnitY(), Vec3::Zero(), [](double t) { return 0.3 * (1 - std::cos(7 * t)); }}};
  const std::vector<int> edge = where(mesh, [](auto& X) { return X.x() == 0; });
  Properties damped = soft;
  damped.damping_mass = 0.3;
  damped.gravity = Vec3(0.2, 0, -1);
  const Shell shell(mesh, damped, {{.kind = SupportKind::Clamped, .vertices = edge, .motion = motion}});
  const auto imbalance = [&](const TimeScheme& scheme, int steps) {
    const double dt = 0.4 / steps;
    Dynamics dynamics(shell, {}, {.scheme = scheme, .first_step = dt});
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
    const EnergyLedger& e = dynamics.ledger();
    double largest = 0;
    for (int n = 1; n <= steps; ++n) {
      const auto trial = dynamics.solve(n * dt, dt, none, dynamics.predicted_positions(dt));
      dynamics.accept(trial.positions, n * dt, dt, none);
      largest = std::max(largest, std::abs(e.kinetic + e.elastic + e.damping_work - e.external_work - e.support_work));
    }
    for (const int v : edge) {
      const Rates rates = motion.rates(mesh.vertices[v], 0.4, dt);
      EXPECT_LT((dynamics.accepted().x.segment<3>(3 * v) - motion.position(mesh.vertices[v], 0.4)).norm(), 1e-12);
      EXPECT_LT((dynamics.accepted().v.segment<3>(3 * v) - rates.velocity).norm(), 1e-9);
    }
    EXPECT_GT(std::abs(e.support_work), 1e-4);
    return largest / std::abs(e.support_work);
  };
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::generalised_alpha(0.8), TimeScheme::midpoint()}) {
    const double coarse = imbalance(scheme, 400), fine = imbalance(scheme, 800);
    std::printf("  imbalance over the supports' work %.1e, at half the step %.1e\n", coarse, fine);
    EXPECT_LT(fine, 1e-3);
    EXPECT_LT(fine, 0.35 * coarse);
  }
}

/// Middle of a curved shell between two planes of symmetry, pressed and pulled at its free corner, all turned by R.
Eigen::VectorXd turned_back(const Mat3& R)
{
  surface::TriangleMesh mesh = test::curved_sheet();
  const std::vector<int> along_y = where(mesh, [](auto& X) { return X.x() == 0; });
  const std::vector<int> along_x = where(mesh, [](auto& X) { return X.y() == 0; });
  const std::vector<int> foot = where(mesh, [](auto& X) { return X.y() == 1.1 && X.x() < 0.2; });
  const int corner = mesh.n_vertices() - 1;
  for (Vec3& X : mesh.vertices)
    X = R * X;
  Properties heavy = soft;
  heavy.gravity = R * Vec3(0, 0, -0.3);
  const Shell shell(mesh, heavy,
                    {{.kind = SupportKind::Symmetry, .vertices = along_y, .normal = Vec3(R * Vec3(-2, 0, 0))},
                     {.kind = SupportKind::Symmetry, .vertices = along_x},
                     {.kind = SupportKind::Hinged, .vertices = foot}});
  const StaticStep last =
      solve_static(shell,
                   {Pressure{{}, [](const Vec3&, double) { return 0.05; }},
                    PointForce{{corner}, [=](const Vec3&, double) -> Vec3 { return R * Vec3(0.01, 0.02, 0.03); }}},
                   {.steps = 4, .fold_limit = 180});
  Eigen::VectorXd back = last.positions;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    back.segment<3>(3 * v) = R.transpose() * Vec3(last.positions.segment<3>(3 * v));
  return back;
}

TEST(Symmetry, PlanesMayHaveAnyDirection)
{
  test::Chance chance(3);
  const Eigen::VectorXd straight = turned_back(Mat3::Identity()), turned = turned_back(chance.turn());
  const Eigen::VectorXd start = surface::interleaved(test::curved_sheet().vertices);
  std::printf("  moved by up to %.2f; turned and straight differ by %.1e\n",
              (straight - start).lpNorm<Eigen::Infinity>(), (turned - straight).lpNorm<Eigen::Infinity>());
  EXPECT_GT((straight - start).lpNorm<Eigen::Infinity>(), 0.05);
  EXPECT_LT((turned - straight).lpNorm<Eigen::Infinity>(), 1e-9);
}

// Triangles of a coarse cylinder meet the planes through its straight edges at an angle.
TEST(Symmetry, OfAStraightEdgeOfACurvedShellIsNormalToTheAxisThatIsNear)
{
  const surface::TriangleMesh quarter = surface::cylinder({.angle = {0, 90}, .divisions = {3, 2}});
  const auto energy = [&](std::optional<Vec3> normal) {
    const Shell shell(quarter, soft,
                      {{.kind = SupportKind::Symmetry,
                        .vertices = test::vertices_where(quarter, [](auto& X) { return std::abs(X.x()) < 1e-12; }),
                        .normal = normal}});
    return shell.elastic_energy(shell.reference_positions() + 1e-3 * test::random_vector(3 * shell.n_vertices(), 5));
  };
  EXPECT_EQ(energy({}), energy(Vec3::UnitX()));
}

TEST(Symmetry, ObliquePlanesLeaveTheFrequenciesAsTheyAre)
{
  const auto frequencies = [](const Mat3& R, int n) {
    surface::TriangleMesh mesh = test::curved_sheet(n, n);
    const std::vector<int> in_plane = where(mesh, [](auto& X) { return X.x() == 0; });
    const std::vector<int> foot = where(mesh, [](auto& X) { return X.y() == 0; });
    for (Vec3& X : mesh.vertices)
      X = R * X;
    const Shell shell(mesh, soft,
                      {{.kind = SupportKind::Symmetry, .vertices = in_plane, .normal = Vec3(R.col(0))},
                       {.kind = SupportKind::Clamped, .vertices = foot}});
    const Modes modes = natural_modes(shell, 4);
    return Eigen::VectorXd(modes.omega_squared.cwiseSqrt());
  };
  test::Chance chance(4);
  for (const int n : {4, 10}) {  // dense and by Lanczos's method
    const Eigen::VectorXd straight = frequencies(Mat3::Identity(), n), turned = frequencies(chance.turn(), n);
    EXPECT_LT((turned - straight).norm(), 1e-7 * straight.norm()) << n;
  }
}

// A stiff plate of mass m on springs: omega^2 = k/m up and down; hinged on an edge with a turning spring: k b/(m
// L^2/3).
TEST(Springs, StiffPlateVibratesAtTheFrequenciesOfItsSprings)
{
  const double L = 1, b = 0.5, k = 30, k_turn = 5;
  const surface::TriangleMesh mesh = test::sheet(L, b, 6, 3);
  const Properties stiff{.thickness = 0.2, .density = 10, .material = SaintVenantKirchhoff{1e9, 0.3}};
  const double mass = 10 * 0.2 * L * b;
  const auto end = [&](double x) { return where(mesh, [=](auto& X) { return X.x() == x; }); };
  std::vector<Support> supports;
  for (const double x : {0.0, L})
    supports.push_back({.kind = SupportKind::Elastic, .vertices = end(x), .stiffness = Vec3(1e3, 1e3, k / 2)});
  const Eigen::VectorXd on_springs = test::natural_frequencies(Shell(mesh, stiff, supports));
  EXPECT_NEAR(on_springs[0] / std::sqrt(k / mass), 1, 1e-5);
  const Eigen::VectorXd on_hinge = test::natural_frequencies(
      Shell(mesh, stiff,
            {{.kind = SupportKind::Hinged, .vertices = end(0)},
             {.kind = SupportKind::Elastic, .vertices = end(0), .turning_stiffness = k_turn}}));
  EXPECT_NEAR(on_hinge[0] / std::sqrt(k_turn * b / (mass * L * L / 3)), 1, 1e-4);
}

TEST(Springs, ForceAndStiffnessAreDerivativesOfTheEnergy)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const std::vector<int> edge = where(mesh, [](auto& X) { return X.y() == 0; });
  const Support elastic{
      .kind = SupportKind::Elastic, .vertices = edge, .stiffness = Vec3(10, 20, 30), .turning_stiffness = 7};
  const Shell with(mesh, soft, {elastic}), without(mesh, soft, {});
  const Eigen::VectorXd x = with.reference_positions() + 0.03 * test::random_vector(3 * mesh.n_vertices(), 1);
  const Eigen::VectorXd d = test::random_vector(x.size(), 2);
  const auto energy = [&](const Eigen::VectorXd& y) { return with.elastic_energy(y) - without.elastic_energy(y); };
  const auto force = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return with.internal_force(y) - without.internal_force(y);
  };
  const double e = 1e-5;
  EXPECT_NEAR((energy(x + e * d) - energy(x - e * d)) / (2 * e), force(x).dot(d), 1e-7 * force(x).norm() * d.norm());
  BlockMatrix K(with.pattern()), K_without(with.pattern());
  with.add_tangent(x, K);
  without.add_tangent(x, K_without);
  K.add(-1, K_without);
  const Eigen::VectorXd slope = (force(x + e * d) - force(x - e * d)) / (2 * e);
  EXPECT_LT((slope - K * d).norm(), 1e-7 * slope.norm());
}

TEST(MovingSupport, ImpossibleMotionsAreRefused)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 4, 4);
  const std::vector<int> edge = where(mesh, [](auto& X) { return X.x() == 0; });
  const Motion motion{.translation = [](const Vec3&, double t) { return Vec3(1 + t, 0, 0); }};
  const auto refusal = [&](const std::vector<Support>& supports) -> std::string {
    try {
      const Shell shell(mesh, soft, supports, "flag");
      const Dynamics dynamics(shell, {}, {.first_step = 0.1});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const Support moved{.kind = SupportKind::Hinged, .vertices = edge, .motion = motion};
  EXPECT_NE(refusal({moved, moved}).find("support 2 (hinged): vertex 0 already moves along x"), std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Symmetry, .vertices = edge, .motion = motion}}).find("only clamped, hinged"),
            std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Elastic, .vertices = edge}}).find("must be at least 0, and one of them"),
            std::string::npos);
  EXPECT_NE(
      refusal({{.kind = SupportKind::Elastic, .vertices = {12}, .turning_stiffness = 1}}).find("no boundary edge"),
      std::string::npos);
  EXPECT_NE(refusal({moved}).find("the motion of a support starts 1 away"), std::string::npos);
}

}  // namespace
}  // namespace luff::shell
