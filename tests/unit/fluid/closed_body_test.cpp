// SPDX-License-Identifier: BSD-3-Clause
// Closed bodies in the flow, and parts of the fluid that sheets seal off.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "parallel/vector_field.hpp"
#include "support/balls.hpp"
#include "support/flow.hpp"
#include "surface/generators.hpp"
#include "surface/solid.hpp"

namespace luff::test {
namespace {

using fluid::SideBoundary;
using fluid::SideKind;

const SideBoundary slip{.kind = SideKind::Slip};
const SideBoundary wall{.kind = SideKind::Wall};
const SideBoundary symmetry{.kind = SideKind::Symmetry};
const SideBoundary outflow{.kind = SideKind::Outflow};

SideBoundary inflow(const Vec3& velocity)
{
  return {SideKind::Velocity, fluid::VectorFunction::uniform(velocity)};
}

const fluid::Boundaries closed_box{{{wall, wall}, {wall, wall}, {slip, slip}}};

std::array<std::vector<double>, 3> stretched_box()
{
  return {stretched_faces(-1, 1, 20, 0.2), stretched_faces(-1, 1, 18, -0.3), stretched_faces(-1, 1, 16, 0.1)};
}

/// max |div U| h over all cells, those inside bodies included.
double largest_divergence(const TestFlow& flow)
{
  const auto U = views(flow.solver.state().U);
  double largest = 0.0;
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    const double net =
        U[0](i + 1, j, k) - U[0](i, j, k) + U[1](i, j + 1, k) - U[1](i, j, k) + U[2](i, j, k + 1) - U[2](i, j, k);
    const double h = std::min({flow.grid.width(0, i), flow.grid.width(1, j), flow.grid.width(2, k)});
    largest = std::max(largest, std::abs(net) * h / flow.grid.volume(i, j, k));
  });
  return largest;
}

/// A ball that moves and spins through fluid at rest in a box without an outlet.
Ball swimming(double t)
{
  return {.radius = 0.35,
          .centre = Vec3(-0.3, 0.05, -0.02) + t * Vec3(1.0, 0.2, 0.1),
          .velocity = {1.0, 0.2, 0.1},
          .spin = {0.5, -1.0, 2.0}};
}

TEST(ClosedBody, MovesThroughAClosedBoxWithoutDivergenceInAnyCellAndCarriesTheCellsInside)
{
  TestFlow flow(stretched_box(), closed_box, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  std::size_t given_back = 0;
  for (int n = 0; n < 30; ++n) {
    const Ball ball = swimming(flow.t + 0.02);
    flow.step(0.02, ball.motion());
    given_back += flow.solver.links().flipped().size();
    flow.solver.accept();
    EXPECT_LE(largest_divergence(flow), 2e-13);
    EXPECT_LE(flow.solver.balance().leak(), 1e-12) << "offsets around a body have no net flux";
    const auto u = views(flow.solver.state().u);
    for (const auto& [cell, body] : flow.solver.links().inside()) {
      const Vec3 x = flow.grid.centre(cell[0], cell[1], cell[2]);
      EXPECT_LE((luff::at(u, cell) - ball.velocity - ball.spin.cross(x - ball.centre)).norm(), 1e-12);
    }
  }
  EXPECT_GT(flow.solver.links().inside().size(), 50u);
  EXPECT_GT(given_back, 20u);
}

TEST(ClosedBody, FeelsTheFluidOutsideOnly)
{
  TestFlow flow(stretched_box(), closed_box, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow.step(0.02, swimming(0.02).motion());
  const immersed::SheetLoads loads = flow.solver.loads();
  Vec3 outside = Vec3::Zero();
  for (std::size_t v = 0; v < loads.plus.size(); ++v) {
    EXPECT_EQ(loads.minus[v], Vec3(Vec3::Zero()));
    outside += loads.plus[v];
  }
  EXPECT_LT(outside[0], -0.1) << "its added mass and the walls hold it back";
}

TEST(ClosedBody, InHeavyFluidAtRestIsLiftedByTheWeightOfItsVolume)
{
  // The pressure is linear, so that the forces of the links add up to the volume of the rows between them.
  const Vec3 gravity(0.3, -1.0, 0.5);
  const Ball ball{.radius = 0.6, .levels = 4, .centre = {0.03, -0.05, 0.02}};
  const immersed::SheetMotion still = ball.motion();
  const double volume = surface::solid({still.position, still.triangles}).volume;
  TestFlow flow(stretched_box(), closed_box,
                {.density = 3.0, .viscosity = 0.05, .acceleration = fluid::VectorFunction::uniform(gravity)});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow.advance(0.01, 3, still);
  // Disturbed once, by the first step (docs/numerics/verification.md): of the order of (dt)^2.
  EXPECT_LE(velocity_error(flow, [](const Vec3&) -> Vec3 { return Vec3::Zero(); }), 1e-4 * gravity.norm());
  Vec3 force = Vec3::Zero();
  for (const Vec3& f : flow.solver.loads().plus)
    force += f;
  EXPECT_LE((force + 3.0 * volume * gravity).norm(), 0.02 * 3.0 * volume * gravity.norm());
}

TEST(ClosedBody, IsTheSameFlowOnTheOtherPressureSolver)
{
  const auto force = [](const std::string& kind) {
    grid::Grid grid(MPI_COMM_WORLD, stretched_box(), {false, false, false});
    fluid::FlowSolver solver(
        grid, {.viscosity = 0.02}, closed_box,
        poisson::make_pressure_solver(grid, fluid::pressure_conditions(closed_box), {.kind = kind}));
    solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
    const immersed::SheetMotion ball = swimming(0.02).motion();
    solver.begin_step({0.0, 0.02, 0.02, 1}, ball);
    (void)solver.project(ball.velocity);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& f : solver.loads().plus)
      sum += f;
    return sum;
  };
  const Vec3 expected = force("multigrid");
  EXPECT_LE((force("petsc") - expected).norm(), 1e-7 * expected.norm());
}

/// A channel along x, closed by a gate at x = 0 that moves along x, except for an opening at its top.
immersed::SheetMotion gate(double opening, const Vec3& velocity, double x = 0.013)
{
  const surface::TriangleMesh mesh = surface::rectangle(
      {.origin = {x, -1.0, -1.0}, .a = (2.0 - opening) * Vec3::UnitY(), .b = 2.0 * Vec3::UnitZ(), .divisions = {9, 4}});
  const std::size_t n = mesh.vertices.size();
  return {mesh.vertices, std::vector<Vec3>(n, velocity), std::vector<Vec3>(n, Vec3::Zero()), mesh.triangles};
}

TEST(SealedPart, OfAChannelThatAGateClosesAndOpensAgainRunsThrough)
{
  // A flow that turns about the gate; where x < 0 there is no outlet but through it.
  TestFlow flow(stretched_box(), {{{slip, outflow}, {slip, slip}, {slip, slip}}}, {.viscosity = 0.02});
  flow.solver.start({[](const Vec3& x, double) { return Vec3(x[1], -x[0], 0.0); }, false}, 0.0);
  const auto opening = [](double t) { return std::max(0.0, 0.5 * std::cos(20.0 * t)); };
  bool was_sealed = false;
  bool opened_again = false;
  for (int n = 0; n < 32; ++n) {
    const double t = flow.t + 0.01;
    flow.step(0.01, gate(opening(t), {0.0, 0.0, 0.0}));
    flow.solver.accept();
    EXPECT_LE(largest_divergence(flow), 1e-12);
    const bool sealed = flow.solver.balance().sealed_components() > 0;
    opened_again = opened_again || (was_sealed && !sealed);
    was_sealed = was_sealed || sealed;
  }
  EXPECT_TRUE(was_sealed);
  EXPECT_TRUE(opened_again);
}

TEST(SealedPart, BehindAGateThatStillMovesLeaksAsMuchAsItIsPressed)
{
  TestFlow flow(stretched_box(), {{{slip, outflow}, {slip, slip}, {slip, slip}}}, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  for (int n = 0; n < 5; ++n) {
    flow.step(0.01, gate(0.0, {-0.3, 0.0, 0.0}));
    flow.solver.accept();
    EXPECT_LE(largest_divergence(flow), 1e-13);
  }
  // In five steps the face's velocity goes a few hundredths of the way to 0.3.
  EXPECT_GT(flow.solver.balance().leak(), 0.005);
  const auto U = views(flow.solver.state().U);
  for (const immersed::CutFace& face : flow.solver.links().faces())
    EXPECT_NEAR(U[face.axis](face.cell), 0.0, 1e-12);
}

TEST(SealedPart, ThatASideBlowsIntoIsRefusedWithItsPlace)
{
  TestFlow flow(stretched_box(), {{{inflow({1, 0, 0}), outflow}, {slip, slip}, {slip, slip}}}, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform({1, 0, 0}), 0.0);
  flow.advance(0.01, 1, gate(0.4, Vec3::Zero()));
  try {
    flow.step(0.01, gate(0.0, Vec3::Zero()));
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("step 2, t = 0.02"), std::string::npos) << text;
    EXPECT_NE(text.find("a net volume flux of 4 around (-0.9"), std::string::npos) << text;
    EXPECT_NE(text.find("seal off from every outlet"), std::string::npos) << text;
  }
}

TEST(SealedPart, BetweenTwoMovingPlatesPassesOnWhatItCannotHold)
{
  // Two gates, one of which moves: the pocket between them and the closed end behind the first share the leak.
  TestFlow flow(stretched_box(), {{{slip, outflow}, {slip, slip}, {slip, slip}}}, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  immersed::SheetMotion both = gate(0.0, {0.2, 0.0, 0.0}, -0.413);
  const immersed::SheetMotion second = gate(0.0, Vec3::Zero(), 0.213);
  const int first_vertices = static_cast<int>(both.position.size());
  both.position.insert(both.position.end(), second.position.begin(), second.position.end());
  both.velocity.insert(both.velocity.end(), second.velocity.begin(), second.velocity.end());
  both.acceleration.insert(both.acceleration.end(), second.acceleration.begin(), second.acceleration.end());
  for (const auto& [a, b, c] : second.triangles)
    both.triangles.push_back({a + first_vertices, b + first_vertices, c + first_vertices});
  flow.advance(0.01, 3, both);
  EXPECT_EQ(flow.solver.balance().sealed_components(), 2);
  EXPECT_LE(largest_divergence(flow), 1e-13);
  const auto U = views(flow.solver.state().U);
  for (const immersed::CutFace& face : flow.solver.links().faces())
    EXPECT_NEAR(U[face.axis](face.cell), 0.0, 1e-12) << "nothing moves: the first gate leaks all it is pressed";
}

}  // namespace
}  // namespace luff::test
