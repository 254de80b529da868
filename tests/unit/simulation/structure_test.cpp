// SPDX-License-Identifier: BSD-3-Clause
// Positions, velocities and accelerations of sheets belong together.
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/structure.hpp"
#include "surface/generators.hpp"

namespace luff::simulation {
namespace {

surface::TriangleMesh strip()
{
  return surface::rectangle({.a = Vec3(1, 0, 0), .b = Vec3(0, 0.5, 0), .divisions = {4, 2}});
}

/// A strip held at x = 0 and pulled down at its other end.
Shells pulled_strip()
{
  const surface::TriangleMesh mesh = strip();
  shell::Support held{.kind = shell::SupportKind::Clamped};
  std::vector<int> end;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (mesh.vertices[v].x() == 0.0)
      held.vertices.push_back(v);
    if (mesh.vertices[v].x() == 1.0)
      end.push_back(v);
  }
  Shells part;
  part.shell = std::make_unique<shell::Shell>(
      mesh, shell::Properties{.thickness = 0.05, .density = 2.0, .material = shell::SaintVenantKirchhoff{1000.0, 0.3}},
      std::vector<shell::Support>{held}, "strip");
  const shell::PointForce pull{end, [](const Vec3&, double t) { return Vec3(0, 0, -0.01 - t); }};
  part.dynamics = std::make_unique<shell::Dynamics>(*part.shell, std::vector<shell::Load>{pull});
  return part;
}

RigidSheet moving_sheet(std::function<Vec3(const Vec3&, double)> position)
{
  shell::Motion motion;
  motion.translation = [position = std::move(position)](const Vec3& X, double t) -> Vec3 { return position(X, t) - X; };
  return {.name = "sheet", .mesh = strip(), .motion = std::move(motion), .moves = true};
}

Structure strip_and_sheet(std::function<Vec3(const Vec3&, double)> position)
{
  return Structure(pulled_strip(), {moving_sheet(std::move(position))});
}

immersed::SheetLoads no_loads(const Structure& structure)
{
  const std::vector<Vec3> zero(structure.vertices(), Vec3::Zero());
  immersed::SheetLoads loads;
  loads.minus = zero;
  loads.plus = zero;
  return loads;
}

/// Advances the structure by some steps without a flow.
TimeStep advance(Structure& structure, double dt, int steps)
{
  TimeStep step;
  for (int n = 0; n < steps; ++n) {
    step = {.t_old = n * dt, .t_new = (n + 1) * dt, .dt = dt, .index = n + 1};
    const Eigen::VectorXd guess = structure.predict(step);
    structure.accept(step, structure.solve(step, no_loads(structure), guess));
  }
  return {.t_old = step.t_new, .t_new = step.t_new + dt, .dt = dt, .index = steps + 1};
}

Vec3 still(const Vec3& x, double)
{
  return x;
}

TEST(AStructure, NumbersShellsBeforeRigidSheets)
{
  const Structure structure = strip_and_sheet(still);
  ASSERT_EQ(structure.sheets().size(), 2U);
  EXPECT_TRUE(structure.sheets()[0].deforms);
  EXPECT_FALSE(structure.sheets()[1].deforms);
  EXPECT_EQ(structure.sheets()[1].first_vertex, 15);
  EXPECT_EQ(structure.sheets()[1].first_triangle, 16);
  EXPECT_EQ(structure.vertices(), 30);
  EXPECT_GE(structure.triangles()[16][0], 15);
}

TEST(AStructure, PredictsWithVelocityAndAccelerationOfTheAcceptedState)
{
  Structure structure = strip_and_sheet(still);
  const TimeStep next = advance(structure, 0.01, 5);
  const shell::State& now = structure.shells().dynamics->accepted();
  const Eigen::VectorXd expected = now.x + next.dt * now.v + 0.5 * next.dt * next.dt * now.a;
  EXPECT_LT((structure.predict(next) - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_GT((expected - now.x).cwiseAbs().maxCoeff(), 1e-4) << "the strip moves";
}

TEST(AStructure, GivesPositionsTheVelocityOfNewmark)
{
  Structure structure = strip_and_sheet(still);
  const TimeStep next = advance(structure, 0.01, 5);
  const shell::State now = structure.shells().dynamics->accepted();
  const Eigen::VectorXd d = structure.predict(next);
  const std::vector<Vec3> v = structure.velocity(d, next);
  for (int n = 0; n < 15; ++n) {
    const Vec3 expected = 2.0 / next.dt * (d - now.x).segment<3>(3 * n) - now.v.segment<3>(3 * n);
    EXPECT_LT((v[n] - expected).norm(), 1e-11) << n;
  }
}

TEST(AStructure, AcceptsThePositionsAndVelocitiesThatItShowedTheFlow)
{
  Structure structure = strip_and_sheet(still);
  const TimeStep next = advance(structure, 0.01, 5);
  const Eigen::VectorXd d = structure.solve(next, no_loads(structure), structure.predict(next));
  const immersed::SheetMotion shown = structure.motion(d, next);
  structure.accept(next, d);
  const auto positions = structure.accepted_positions(next.t_new);
  const auto velocities = structure.accepted_velocities(next.t_new, next.dt);
  for (int n = 0; n < structure.vertices(); ++n) {
    EXPECT_EQ(positions[n], shown.position[n]) << n;
    EXPECT_LT((velocities[n] - shown.velocity[n]).norm(), 1e-14) << n;
  }
}

TEST(AStructure, KeepsTheAcceptedStateHoweverOftenItSolves)
{
  Structure structure = strip_and_sheet(still);
  const TimeStep next = advance(structure, 0.01, 3);
  const auto before = structure.accepted_positions(next.t_old);
  const Eigen::VectorXd first = structure.solve(next, no_loads(structure), structure.predict(next));
  const Eigen::VectorXd again = structure.solve(next, no_loads(structure), first);
  EXPECT_LT((again - first).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(structure.accepted_positions(next.t_old), before);
}

TEST(AStructure, NamesTheVertexOfTheLargestResidual)
{
  const Structure structure = strip_and_sheet(still);
  Eigen::VectorXd r = Eigen::VectorXd::Constant(45, 0.1);
  r[3 * 4 + 1] = -2.0;
  EXPECT_EQ(structure.place_of(r), "vertex 4 of shell 'strip' at (0.25, 0.25, 0)");
  r[3 * 2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(structure.place_of(r), "vertex 2 of shell 'strip' at (0, 0.5, 0)");
}

TEST(ARigidSheet, HasTheRatesOfAPolynomialMotionToRoundOff)
{
  const auto path = [](const Vec3& x, double t) -> Vec3 { return x + Vec3(t, t * t, t * t * t); };
  const Structure structure = strip_and_sheet(path);
  const TimeStep step{.t_old = 0.9, .t_new = 1.0, .dt = 0.1, .index = 1};
  const immersed::SheetMotion motion = structure.motion(structure.predict(step), step);
  for (int n = 15; n < 30; ++n) {
    EXPECT_LT((motion.velocity[n] - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
    EXPECT_LT((motion.acceleration[n] - Vec3(0.0, 2.0, 6.0)).norm(), 1e-9);
  }
}

TEST(ARigidSheet, HasTheRatesOfARotationToFourthOrderOfTheStep)
{
  const double rate = 3.0;
  const auto turn = [rate](const Vec3& x, double t) -> Vec3 {
    return {x.x() * std::cos(rate * t) - x.y() * std::sin(rate * t),
            x.x() * std::sin(rate * t) + x.y() * std::cos(rate * t), x.z()};
  };
  const Structure structure = strip_and_sheet(turn);
  const auto error = [&](double dt) {
    const TimeStep step{.t_old = 1.0 - dt, .t_new = 1.0, .dt = dt, .index = 1};
    const immersed::SheetMotion motion = structure.motion(structure.predict(step), step);
    double worst = 0.0;
    for (int n = 15; n < 30; ++n)
      worst = std::max(worst, (motion.velocity[n] - rate * Vec3::UnitZ().cross(motion.position[n])).norm());
    return worst;
  };
  // e = dt/10: the error of the fourth-order difference of a sine of amplitude R, R omega (omega e)^4/30.
  const double radius = std::hypot(1.0, 0.5);
  EXPECT_NEAR(error(0.02), radius * rate * std::pow(0.1 * rate * 0.02, 4) / 30.0, 2e-12);
  EXPECT_NEAR(std::log2(error(2.0) / error(1.0)), 4.0, 0.1);
}

TEST(ARigidSheet, ThatDoesNotMoveHasNoVelocity)
{
  RigidSheet fixed = moving_sheet(still);
  fixed.moves = false;
  const Structure structure({}, {std::move(fixed)});
  const TimeStep step{.t_old = 0.0, .t_new = 0.1, .dt = 0.1, .index = 1};
  for (const Vec3& v : structure.motion(Eigen::VectorXd(0), step).velocity)
    EXPECT_EQ(v, Vec3(Vec3::Zero()));
  EXPECT_EQ(structure.length(), 1.0);
}

}  // namespace
}  // namespace luff::simulation
