// SPDX-License-Identifier: BSD-3-Clause
// What a coupled time loop relies on: steps repeat, restart and scale, and trouble is told.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "shell/dynamics.hpp"
#include "shell/statics.hpp"
#include "support/free_flight.hpp"

namespace luff::shell {
namespace {

/// Units of length, time and mass.
struct Units {
  double L = 1;
  double T = 1;
  double M = 1;
};

/// A flag clamped along x = 0 under gravity, pressure and a force at its end, in any units.
struct Flag {
  explicit Flag(Units u = {}, double damping = 0.1, int n = 6)
      : units(u),
        mesh(test::sheet(u.L, 0.5 * u.L, n, n / 2)),
        shell(mesh,
              {.thickness = 0.01 * u.L,
               .density = 100 * u.M / (u.L * u.L * u.L),
               .material = SaintVenantKirchhoff{1e6 * u.M / (u.L * u.T * u.T), 0.4},
               .damping_mass = damping / u.T,
               .damping_stiffness = 1e-3 * damping * u.T,
               .gravity = Vec3(0, 0.3, -1) * u.L / (u.T * u.T)},
              {{.kind = SupportKind::Clamped,
                .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}},
              "flag")
  {
  }

  std::vector<Load> loads() const
  {
    const double p = 0.1 * units.M / (units.L * units.T * units.T), F = 0.05 * units.M * units.L / (units.T * units.T);
    return {Pressure{{}, [=](const Vec3&, double) { return p; }},
            PointForce{{mesh.n_vertices() - 1}, [=](const Vec3&, double) { return Vec3(0, 0, F); }}};
  }

  Eigen::VectorXd fluid(double size = 1e-3) const
  {
    return size * units.M * units.L / (units.T * units.T) * test::random_vector(3 * mesh.n_vertices(), 5);
  }

  Units units;
  surface::TriangleMesh mesh;
  Shell shell;
};

constexpr double dt = 0.01;

void advance(Dynamics& dynamics, const Flag& flag, int steps)
{
  const double step = dt * flag.units.T;
  for (int n = 0; n < steps; ++n) {
    const double t = dynamics.accepted().t + step;
    const auto trial = dynamics.solve(t, step, flag.fluid(), dynamics.predicted_positions(step));
    dynamics.accept(trial.positions, t, step, flag.fluid());
  }
}

TEST(Dynamics, SolvingLeavesTheAcceptedStateAlone)
{
  const Flag flag;
  Dynamics dynamics(flag.shell, flag.loads());
  advance(dynamics, flag, 3);
  const State before = dynamics.accepted();
  dynamics.solve(before.t + dt, dt, flag.fluid(1), dynamics.predicted_positions(dt));
  EXPECT_EQ(before.x, dynamics.accepted().x);
  EXPECT_EQ(before.v, dynamics.accepted().v);
  EXPECT_EQ(before.a, dynamics.accepted().a);
  EXPECT_EQ(before.t, dynamics.accepted().t);
}

TEST(Dynamics, RepeatedSolveGivesTheSamePositionsAndKeepsTheTangent)
{
  const Flag flag;
  Dynamics dynamics(flag.shell, flag.loads());
  advance(dynamics, flag, 3);
  const double t = dynamics.accepted().t + dt;
  const Eigen::VectorXd guess = dynamics.predicted_positions(dt);
  const auto first = dynamics.solve(t, dt, flag.fluid(), guess);
  const auto other = dynamics.solve(t, dt, flag.fluid(1.5e-3), first.positions);
  const auto again = dynamics.solve(t, dt, flag.fluid(), other.positions);
  EXPECT_LT((again.positions - first.positions).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_GT((other.positions - first.positions).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_EQ(other.report.factorisations, 0);
  EXPECT_LE(other.report.iterations, 5);
}

TEST(Dynamics, BorrowedMassHoldsTheShellBackAndDoesNotChangeWhereItComesToRest)
{
  const Flag flag;
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::generalised_alpha(0.8)}) {
    Dynamics own(flag.shell, flag.loads(), {.scheme = scheme});
    Dynamics borrowing(flag.shell, flag.loads(), {.scheme = scheme});
    borrowing.borrow_mass(3.0);
    const Eigen::VectorXd guess = own.predicted_positions(dt);
    const Eigen::VectorXd force = flag.fluid(1.0);
    const Eigen::VectorXd answer = own.solve(dt, dt, force, guess).positions;
    Eigen::VectorXd x = borrowing.solve(dt, dt, force, guess).positions;
    const double whole_way = (answer - guess).norm();
    EXPECT_LT((x - guess).norm(), 0.6 * whole_way);
    EXPECT_GT((x - guess).norm(), 0.2 * whole_way);
    for (int iteration = 0; iteration < 60; ++iteration)
      x = borrowing.solve(dt, dt, force, x).positions;
    EXPECT_LE((x - answer).norm(), 1e-6 * whole_way);
  }
}

TEST(Dynamics, AcceptedKinematicsAreNewmarks)
{
  const Flag flag;
  Dynamics dynamics(flag.shell, flag.loads());
  advance(dynamics, flag, 2);
  const State before = dynamics.accepted();
  const auto trial = dynamics.solve(before.t + dt, dt, flag.fluid(), dynamics.predicted_positions(dt));
  const Kinematics k = dynamics.kinematics(trial.positions, dt);
  dynamics.accept(trial.positions, before.t + dt, dt, flag.fluid());
  EXPECT_EQ(k.v, dynamics.accepted().v);
  EXPECT_EQ(k.a, dynamics.accepted().a);
  EXPECT_LT((before.x + dt * 0.5 * (before.v + k.v) - trial.positions).norm(), 1e-13);
  for (const int v : test::vertices_where(flag.mesh, [](auto& X) { return X.x() == 0; })) {
    EXPECT_EQ(Vec3(dynamics.accepted().x.segment<3>(3 * v)), flag.mesh.vertices[v]);
    EXPECT_EQ(Vec3(dynamics.accepted().v.segment<3>(3 * v)), Vec3::Zero());
  }
}

/// Positions of 1e4 have digits of 2e-12, which divided by the step are 2e-9 of the velocity.
TEST(Dynamics, MomentumIsKeptFarFromTheOrigin)
{
  surface::TriangleMesh mesh = test::sheet(1, 0.5, 6, 3);
  for (Vec3& X : mesh.vertices)
    X.x() += 1e4;
  const Shell shell(mesh, {.thickness = 0.02, .density = 1, .material = SaintVenantKirchhoff{1e5, 0.3}}, {});
  Eigen::VectorXd v0(3 * mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v)
    v0.segment<3>(3 * v) = Vec3(1, 0, std::pow(mesh.vertices[v].x() - 1e4, 2));
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::midpoint(), TimeScheme::generalised_alpha(0.5)}) {
    Dynamics dynamics(shell, {}, {.scheme = scheme}, 0, v0);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(v0.size());
    const Vec3 before = test::sum(shell.mass_times(v0));
    for (int n = 1; n <= 20; ++n)
      dynamics.accept(dynamics.solve(1e-3 * n, 1e-3, none, dynamics.predicted_positions(1e-3)).positions, 1e-3 * n,
                      1e-3, none);
    EXPECT_LT((test::sum(shell.mass_times(dynamics.accepted().v)) - before).norm(), 1e-13 * before.norm());
  }
}

TEST(Dynamics, FirstAccelerationBalancesTheForces)
{
  const Flag flag;
  const Dynamics dynamics(flag.shell, flag.loads());
  Eigen::VectorXd balance = Loads(flag.shell, flag.loads()).at(0).force(flag.shell.reference_positions()) -
                            flag.shell.mass_times(dynamics.accepted().a);
  flag.shell.clear_held(balance);
  const double membrane_round_off = 1e-15 * 1e6 * 0.01;  // of E h L, left in the internal force of the reference
  EXPECT_GT(flag.shell.mass_times(dynamics.accepted().a).norm(), 0.1);
  EXPECT_LT(balance.norm(), membrane_round_off);
}

TEST(Dynamics, RestartFromACheckpointGivesTheSameBits)
{
  const Flag flag;
  Dynamics whole(flag.shell, flag.loads());
  advance(whole, flag, 7);
  const Checkpoint checkpoint = whole.checkpoint();
  advance(whole, flag, 20);
  Dynamics restarted(flag.shell, flag.loads());
  restarted.restore(checkpoint);
  advance(restarted, flag, 20);
  EXPECT_EQ(whole.accepted().x, restarted.accepted().x);
  EXPECT_EQ(whole.accepted().a, restarted.accepted().a);
  EXPECT_EQ(whole.ledger().external_work, restarted.ledger().external_work);
  EXPECT_EQ(whole.step(), restarted.step());
}

/// Positions after a few steps in units of length.
Eigen::VectorXd positions_in(Units units, int steps)
{
  const Flag flag(units);
  Dynamics dynamics(flag.shell, flag.loads());
  advance(dynamics, flag, steps);
  return dynamics.accepted().x / units.L;
}

TEST(Dynamics, UnitsThatArePowersOfTwoChangeNoBit)
{
  EXPECT_EQ(positions_in({}, 10), positions_in({.L = 0x1p-10, .T = 0x1p-7, .M = 0x1p-33}, 10));
}

TEST(Dynamics, MillimetresAndMilligramsChangeOnlyRoundOff)
{
  const double difference =
      (positions_in({}, 10) - positions_in({.L = 1e-3, .T = 1e-2, .M = 1e-9}, 10)).lpNorm<Eigen::Infinity>();
  std::printf("  largest difference %.1e of the length\n", difference);
  EXPECT_LT(difference, 1e-12);
}

TEST(Dynamics, OneAndTwoThreadsGiveTheSameBits)
{
  const Flag flag({}, 0.1, 50);
  ASSERT_GT(flag.mesh.n_triangles(), 2000) << "too few for the loops to be shared among threads";
  Dynamics dynamics(flag.shell, flag.loads());
  const auto positions = [&](int threads) {
    omp_set_num_threads(threads);
    dynamics.restore(Dynamics(flag.shell, flag.loads()).checkpoint());
    return dynamics.solve(dt, dt, flag.fluid(1e-6), dynamics.predicted_positions(dt)).positions;
  };
  const Eigen::VectorXd one = positions(1), two = positions(2);
  omp_set_num_threads(1);
  EXPECT_EQ(one, two);
}

// Ten million lengths away coordinates have nine digits left; increments stop shrinking there instead of at 1e-12.
TEST(Dynamics, ShellFarFromTheOriginStopsAtItsRoundOff)
{
  const Flag flag;
  surface::TriangleMesh far_mesh = flag.mesh;
  surface::translate(far_mesh, Vec3(1e7, 0, 0));
  const Shell far(far_mesh, flag.shell.pieces()[0].properties,
                  {{.kind = SupportKind::Clamped,
                    .vertices = test::vertices_where(far_mesh, [](auto& X) { return X.x() == 1e7; })}});
  Dynamics dynamics(far, flag.loads());
  const auto trial = dynamics.solve(dt, dt, flag.fluid(), dynamics.predicted_positions(dt));
  EXPECT_TRUE(trial.report.stopped_at_round_off);
  EXPECT_LT(trial.report.increment, 1e-8);
}

TEST(Dynamics, SmallChangesOfTheTimeStepKeepTheTangent)
{
  const Flag flag;
  Dynamics dynamics(flag.shell, flag.loads());
  for (const auto& [step, factorisations] : {std::pair{dt, 1}, std::pair{1.02 * dt, 0}, std::pair{0.5 * dt, 1}}) {
    const auto trial = dynamics.solve(step, step, flag.fluid(), dynamics.predicted_positions(step));
    EXPECT_EQ(trial.report.factorisations, factorisations) << step;
  }
}

TEST(Dynamics, FailureTellsStepTimePlaceAndRemedy)
{
  const Flag flag;
  DynamicsOptions options;
  options.newton.max_iterations = 2;
  Dynamics dynamics(flag.shell, flag.loads(), options, 1.5);
  try {
    dynamics.solve(1.5 + dt, dt, flag.fluid(10), dynamics.predicted_positions(dt));
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    for (const char* part : {"step 1", "t = 1.51", "shell 'flag'", "2 iterations", "vertex", "smaller steps"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in: " << text;
  }
}

TEST(Dynamics, ForcesThatAreNotNumbersStopTheStep)
{
  const Flag flag;
  Dynamics dynamics(flag.shell, flag.loads());
  Eigen::VectorXd fluid = flag.fluid();
  fluid[20] = std::nan("");
  EXPECT_THROW(dynamics.solve(dt, dt, fluid, dynamics.predicted_positions(dt)), NonConvergence);
}

TEST(Dynamics, SharpFoldStopsTheRunAndKeepsTheState)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.5, 6, 3, surface::Pattern::Diagonal);
  const Shell shell(mesh, {.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1, 0.3}}, {}, "flag");
  Dynamics dynamics(shell, {});
  // Folded along the line of edges x = 1/2, to a slope of 10, by 84.29 degrees.
  Eigen::VectorXd folded = shell.reference_positions();
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (const double beyond = mesh.vertices[v].x() - 0.5; beyond > 0.01) {
      folded[3 * v] = 0.5 + 0.1 * beyond;
      folded[3 * v + 2] = beyond;
    }
  const Folds found = folds(shell, folded);
  EXPECT_NEAR(found.largest, 84.29, 0.01);
  EXPECT_EQ(found.n_sharp, 3);
  try {
    dynamics.accept(folded, dt, dt, Eigen::VectorXd::Zero(folded.size()));
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("step 1, t = 0.01: shell 'flag' folds by 84 degrees"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(dynamics.accepted().x, shell.reference_positions());
}

// Half a shell may crease over the plane in which it is mirrored, or a clamped one over its clamp: no two triangles of
// the mesh show it, and the pull-out of the open cylinder folded flat that way, unseen.
TEST(Dynamics, FoldsOverMirroredEdgesCountTwiceTheTurn)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.5, 4, 3, surface::Pattern::Diagonal);
  const std::vector<int> edge = test::vertices_where(mesh, [](const Vec3& X) { return X.x() == 0; });
  constexpr double turn = 30 * std::numbers::pi / 180;
  Eigen::VectorXd turned = surface::interleaved(mesh.vertices);
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    turned[3 * v] = std::cos(turn) * mesh.vertices[v].x();
    turned[3 * v + 2] = std::sin(turn) * mesh.vertices[v].x();
  }
  const Properties thin{.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1, 0.3}};
  const Motion turning{.rotation = Motion::Rotation{-Vec3::UnitY(), Vec3::Zero(), [](double t) { return t; }}};
  for (const Support& support : {Support{.kind = SupportKind::Clamped, .vertices = edge},
                                 Support{.kind = SupportKind::Symmetry, .vertices = edge, .normal = Vec3::UnitX()},
                                 Support{.kind = SupportKind::Clamped, .vertices = edge, .motion = turning}}) {
    const Shell shell(mesh, thin, {support});
    const Folds found = folds(shell, turned);
    EXPECT_NEAR(found.largest, 60, 1e-9);
    EXPECT_EQ(found.n_sharp, 3);
    EXPECT_LT(folds(shell, shell.reference_positions()).largest, 1e-9);
    EXPECT_NEAR(folds(shell, turned, turn).largest, support.motion ? 0 : 60, 1e-9);  // the clamp turns along
  }
}

TEST(Dynamics, FoldsOfTheReferenceDontCount)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const Shell shell(mesh, {.thickness = 0.1, .density = 1, .material = SaintVenantKirchhoff{1, 0}}, {});
  EXPECT_LT(folds(shell, shell.reference_positions()).largest, 1e-10);
}

TEST(Dynamics, MasslessShellIsRefused)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const Shell shell(mesh, {.thickness = 0.1, .density = 0, .material = SaintVenantKirchhoff{1, 0}}, {});
  EXPECT_THROW(Dynamics(shell, {}), InputError);
}

TEST(Statics, ShellThatCanMoveRigidlyIsRefused)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 3, 3);
  const std::vector<int> edge = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; });
  const auto refused = [&](const std::vector<Support>& supports) {
    const Shell shell(mesh, {.thickness = 1e-4, .density = 1, .material = SaintVenantKirchhoff{1, 0.3}}, supports,
                      "flag");
    try {
      solve_static(shell, {}, {.steps = 1});
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("shell 'flag' can move"), std::string::npos) << error.what();
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{.kind = SupportKind::Hinged, .vertices = edge}}));
  EXPECT_TRUE(refused({{.kind = SupportKind::Fixed, .vertices = edge, .components = {true, false, true}}}));
  EXPECT_FALSE(refused({{.kind = SupportKind::Clamped, .vertices = edge}}));
  EXPECT_FALSE(refused({{.kind = SupportKind::Hinged, .vertices = test::outline(mesh, 1, 1)}}));
}

}  // namespace
}  // namespace luff::shell
