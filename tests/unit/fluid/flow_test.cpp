// SPDX-License-Identifier: BSD-3-Clause
// What the flow solver must keep exactly.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "parallel/vector_field.hpp"
#include "support/exact_flows.hpp"
#include "support/flow.hpp"
#include "surface/generators.hpp"

namespace luff::test {
namespace {

using fluid::SideBoundary;
using fluid::SideKind;

const SideBoundary slip{.kind = SideKind::Slip};
const SideBoundary wall{.kind = SideKind::Wall};
const SideBoundary symmetry{.kind = SideKind::Symmetry};
const SideBoundary outflow{.kind = SideKind::Outflow};
const SideBoundary periodic{.kind = SideKind::Periodic};

SideBoundary inflow(const Vec3& velocity)
{
  return {SideKind::Velocity, fluid::VectorFunction::uniform(velocity)};
}

std::array<std::vector<double>, 3> stretched_box()
{
  return {stretched_faces(0, 3, 20, 0.4), stretched_faces(0, 1, 12, -0.3), stretched_faces(0, 1, 10, 0.2)};
}

immersed::SheetMotion at_rest(const surface::Rectangle& shape, const Vec3& velocity = Vec3::Zero())
{
  const surface::TriangleMesh mesh = surface::rectangle(shape);
  const std::size_t n = mesh.vertices.size();
  return {mesh.vertices, std::vector<Vec3>(n, velocity), std::vector<Vec3>(n, Vec3::Zero()), mesh.triangles};
}

void expect_free_stream_kept(const fluid::Boundaries& sides, const Vec3& stream)
{
  TestFlow flow(stretched_box(), sides, {.viscosity = 0.01});
  flow.solver.start(fluid::VectorFunction::uniform(stream), 0.0);
  flow.advance(0.02, 100);
  EXPECT_LE(velocity_error(flow, [&](const Vec3&) { return stream; }), 1e-13);
  EXPECT_LE(flow.largest_divergence, 1e-13);
}

TEST(FreeStream, StaysUniformThroughAStretchedBoxForAHundredSteps)
{
  const Vec3 stream(1.0, 0.0, 0.0);
  expect_free_stream_kept({{{inflow(stream), outflow}, {slip, slip}, {symmetry, symmetry}}}, stream);
}

TEST(FreeStream, StaysUniformAcrossPeriodicSidesForAHundredSteps)
{
  const Vec3 stream(1.0, 0.6, -0.4);
  expect_free_stream_kept({{{inflow(stream), outflow}, {periodic, periodic}, {periodic, periodic}}}, stream);
  expect_free_stream_kept({{{periodic, periodic}, {periodic, periodic}, {periodic, periodic}}}, stream);
}

TEST(Sheet, CarriedByAUniformStreamLeavesItUniform)
{
  const Vec3 stream(1.0, 0.3, 0.0);
  TestFlow flow(stretched_box(), {{{inflow(stream), outflow}, {periodic, periodic}, {symmetry, symmetry}}},
                {.viscosity = 0.01});
  flow.solver.start(fluid::VectorFunction::uniform(stream), 0.0);
  for (int n = 0; n < 50; ++n) {
    immersed::SheetMotion sheet = at_rest({.origin = Vec3(0.4, 0.2, 0.2) + (flow.t + 0.02) * stream,
                                           .a = {0.3, 0.3, 0.1},
                                           .b = {0.0, 0.1, 0.5},
                                           .divisions = {4, 4}},
                                          stream);
    flow.step(0.02, sheet);
    for (std::size_t v = 0; v < sheet.position.size(); ++v)
      EXPECT_LE(flow.solver.loads().force(v).norm(), 1e-12);
    flow.solver.accept();
  }
  EXPECT_LE(velocity_error(flow, [&](const Vec3&) { return stream; }), 1e-13);
}

TEST(Divergence, IsRoundOffInEveryCellAroundAMovingSheet)
{
  TestFlow flow(stretched_box(), {{{inflow({1, 0, 0}), outflow}, {slip, slip}, {wall, wall}}}, {.viscosity = 0.01});
  flow.solver.start(fluid::VectorFunction::uniform({1, 0, 0}), 0.0);
  for (int n = 0; n < 20; ++n) {
    flow.step(0.02, at_rest({.origin = {1.0 - 0.5 * (flow.t + 0.02), 0.3, 0.3},
                             .a = {0.2, 0.4, 0.0},
                             .b = {0.0, 0.0, 0.4},
                             .divisions = {4, 4}},
                            {-0.5, 0.0, 0.0}));
    flow.solver.accept();
  }
  const auto U = views(flow.solver.state().U);
  double largest = 0.0;
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    const double net =
        U[0](i + 1, j, k) - U[0](i, j, k) + U[1](i, j + 1, k) - U[1](i, j, k) + U[2](i, j, k + 1) - U[2](i, j, k);
    const double h = std::min({flow.grid.width(0, i), flow.grid.width(1, j), flow.grid.width(2, k)});
    largest = std::max(largest, std::abs(net) * h / flow.grid.volume(i, j, k));
  });
  EXPECT_LE(largest, 1e-13);
  EXPECT_GT(flow.solver.links().faces().size(), 0u);
}

TEST(Couette, FlowBetweenASlidingSheetAndWallsIsExactlyLinear)
{
  constexpr double y_sheet = 0.37;
  constexpr double viscosity = 0.1;
  const auto exact = [](const Vec3& x) -> Vec3 {
    return (x[1] < y_sheet ? x[1] / y_sheet : (1.0 - x[1]) / (1.0 - y_sheet)) * Vec3::UnitX();
  };
  TestFlow flow({stretched_faces(0, 1, 6, 0.2), stretched_faces(0, 1, 14, 0.0), std::vector{0.0, 0.2}},
                {{{periodic, periodic}, {wall, wall}, {symmetry, symmetry}}}, {.density = 2.0, .viscosity = viscosity});
  flow.solver.start({[&](const Vec3& x, double) { return exact(x); }, false}, 0.0);
  const immersed::SheetMotion sheet =
      at_rest({.origin = {0.0, y_sheet, 0.0}, .a = Vec3::UnitX(), .b = 0.2 * Vec3::UnitZ(), .divisions = {5, 1}},
              Vec3::UnitX());
  flow.advance(0.01, 40, sheet);
  EXPECT_LE(velocity_error(flow, exact), 1e-13);
  flow.step(0.01, sheet);
  const immersed::SheetLoads loads = flow.solver.loads();
  Vec3 force = Vec3::Zero();
  for (std::size_t v = 0; v < sheet.position.size(); ++v)
    force += loads.force(v);
  const double shear = 2.0 * viscosity * (1.0 / y_sheet + 1.0 / (1.0 - y_sheet));
  EXPECT_NEAR(force[0], -shear * 0.2, 1e-12);
  EXPECT_NEAR(force[1], 0.0, 1e-12);
}

TEST(Hydrostatics, AWeightyFluidAtRestStaysAtRestAroundASheetWithEqualPressureOnBothSides)
{
  const Vec3 gravity(0.3, -1.0, 0.0);
  TestFlow flow(stretched_box(), {{{wall, slip}, {wall, slip}, {symmetry, symmetry}}},
                {.density = 3.0, .viscosity = 0.01, .acceleration = fluid::VectorFunction::uniform(gravity)});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  const immersed::SheetMotion sheet =
      at_rest({.origin = {1.0, 0.3, 0.2}, .a = {0.6, 0.3, 0.0}, .b = {0.0, 0.1, 0.5}, .divisions = {4, 4}});
  flow.advance(1e-8, 3);  // the pressure starts from nothing; short steps find it before anything moves
  flow.advance(0.02, 20, sheet);
  flow.step(0.02, sheet);
  const immersed::SheetLoads loads = flow.solver.loads();
  double one_side = 0.0;
  double both = 0.0;
  for (std::size_t v = 0; v < sheet.position.size(); ++v) {
    one_side += loads.plus[v].norm();
    both += loads.force(v).norm();
  }
  flow.solver.accept();
  EXPECT_LE(velocity_error(flow, [](const Vec3&) { return Vec3::Zero(); }), 1e-12);
  EXPECT_LE(pressure_error(flow, [&](const Vec3& x) { return gravity.dot(x); }), 1e-11);
  EXPECT_GT(one_side, 0.01);
  EXPECT_LE(both, 1e-10 * one_side);
}

/// Vortices that a stream carries past: the pressure at a place changes all the time.  From the pressure of the stage
/// before, two iterations lead to the divergence asked for here.
TEST(Pressure, StartsWhereTheTwoPressuresBeforePointTo)
{
  const TaylorGreen exact{.viscosity = 0.01, .stream = {1.0, 0.0, 0.0}};
  const auto faces = stretched_faces(0, 1, 24, 0.0);
  TestFlow flow({faces, faces, stretched_faces(0, 1, 8, 0.0)}, sides_of({true, true, true}, {}),
                {.viscosity = exact.viscosity, .divergence = 1e-5});
  flow.solver.start(exact.function(), 0.0);
  constexpr double dt = 0.005;
  flow.advance(dt, 4);
  flow.solver.begin_step({flow.t, flow.t + dt, dt, 5}, {});
  EXPECT_LE(flow.solver.project({}).iterations, 1);
}

TEST(Boundaries, RefuseInflowWithoutAnOutlet)
{
  TestFlow flow(stretched_box(), {{{inflow({1, 0, 0}), wall}, {slip, slip}, {slip, slip}}}, {.viscosity = 0.01});
  EXPECT_THROW(flow.solver.start(fluid::VectorFunction::uniform({1, 0, 0}), 0.0), InputError);
}

/// The flow around a moving sheet with its axes turned `turns` times: x -> y -> z -> x.
std::unique_ptr<TestFlow> turned_flow(int turns)
{
  const auto turn = [turns](auto values) {
    for (int n = 0; n < turns; ++n)
      values = {values[2], values[0], values[1]};
    return values;
  };
  const auto turned = [turns](Vec3 x) {
    for (int n = 0; n < turns; ++n)
      x = Vec3(x[2], x[0], x[1]);
    return x;
  };
  const Vec3 stream = turned(Vec3::UnitX());
  fluid::Boundaries sides{{{inflow(stream), outflow}, {slip, wall}, {periodic, periodic}}};
  auto flow = std::make_unique<TestFlow>(turn(stretched_box()), turn(sides), fluid::FlowOptions{.viscosity = 0.01});
  flow->solver.start(fluid::VectorFunction::uniform(stream), 0.0);
  for (int n = 0; n < 10; ++n) {
    immersed::SheetMotion sheet = at_rest({.origin = {1.0, 0.31 + 0.2 * (flow->t + 0.02), 0.27},
                                           .a = {0.4, 0.23, 0.0},
                                           .b = {0.03, 0.1, 0.5},
                                           .divisions = {4, 4}},
                                          turned({0.0, 0.2, 0.0}));
    for (Vec3& x : sheet.position)
      x = turned(x);
    flow->step(0.02, sheet);
    flow->solver.accept();
  }
  return flow;
}

TEST(Axes, TurnedWithTheSheetTurnTheFlow)
{
  const auto plain = turned_flow(0);
  const auto u = views(plain->solver.state().u);
  for (const int turns : {1, 2}) {
    const auto other = turned_flow(turns);
    const auto v = views(other->solver.state().u);
    double largest = 0.0;
    for_each_cell_in_order(plain->grid.owned(), [&](int i, int j, int k) {
      const Index3 c = turns == 1 ? Index3{k, i, j} : Index3{j, k, i};
      for (int d = 0; d < 3; ++d)
        largest = std::max(largest, std::abs(u[d](i, j, k) - v[(d + turns) % 3](c)));
    });
    EXPECT_LE(largest, 1e-11);
  }
}

}  // namespace
}  // namespace luff::test
