// SPDX-License-Identifier: BSD-3-Clause
// What the flow solver must keep exactly with the scheme "curvib".
#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/balls.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

using fluid::ImmersedScheme;
using fluid::SideBoundary;
using fluid::SideKind;

const SideBoundary slip{.kind = SideKind::Slip};
const SideBoundary wall{.kind = SideKind::Wall};
const SideBoundary symmetry{.kind = SideKind::Symmetry};
const SideBoundary outflow{.kind = SideKind::Outflow};
const SideBoundary periodic{.kind = SideKind::Periodic};

immersed::SheetMotion moving(const surface::Rectangle& shape, const Vec3& velocity)
{
  const surface::TriangleMesh mesh = surface::rectangle(shape);
  const std::size_t n = mesh.vertices.size();
  return {mesh.vertices, std::vector<Vec3>(n, velocity), std::vector<Vec3>(n, Vec3::Zero()), mesh.triangles};
}

class CurvibInTime : public ::testing::TestWithParam<fluid::TimeScheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, CurvibInTime,
                         ::testing::Values(fluid::TimeScheme::Rk3, fluid::TimeScheme::NewtonKrylov));

TEST_P(CurvibInTime, KeepsFlowBetweenASlidingSheetAndWallsLinear)
{
  constexpr double y_sheet = 0.37;
  constexpr double viscosity = 0.1;
  const auto exact = [](const Vec3& x) -> Vec3 {
    return (x[1] < y_sheet ? x[1] / y_sheet : (1.0 - x[1]) / (1.0 - y_sheet)) * Vec3::UnitX();
  };
  TestFlow flow({stretched_faces(0, 1, 6, 0.2), stretched_faces(0, 1, 14, 0.0), std::vector{0.0, 0.2}},
                {{{periodic, periodic}, {wall, wall}, {symmetry, symmetry}}},
                {.scheme = GetParam(), .immersed = ImmersedScheme::Curvib, .density = 2.0, .viscosity = viscosity});
  flow.solver.start({[&](const Vec3& x, double) { return exact(x); }, false}, 0.0);
  const immersed::SheetMotion sheet =
      moving({.origin = {0.0, y_sheet, 0.0}, .a = Vec3::UnitX(), .b = 0.2 * Vec3::UnitZ(), .divisions = {5, 1}},
             Vec3::UnitX());
  flow.advance(0.01, 40, sheet);
  EXPECT_LE(velocity_error(flow, exact), 1e-13);
  flow.step(0.01, sheet);
  const immersed::SheetLoads loads = flow.solver.loads();
  Vec3 above = Vec3::Zero();
  Vec3 below = Vec3::Zero();
  for (std::size_t v = 0; v < sheet.position.size(); ++v) {
    above += loads.minus[v];  // the normal a x b points down
    below += loads.plus[v];
  }
  EXPECT_NEAR(below[0], -2.0 * viscosity / y_sheet * 0.2, 1e-12);
  EXPECT_NEAR(above[0], -2.0 * viscosity / (1.0 - y_sheet) * 0.2, 1e-12);
}

TEST(Curvib, ASheetThatMovesWithTheFluidDoesNotDisturbIt)
{
  const Vec3 stream(1.0, 0.0, 0.0);
  TestFlow flow({stretched_faces(0, 3, 20, 0.4), stretched_faces(0, 1, 12, -0.3), stretched_faces(0, 1, 10, 0.2)},
                {{{SideBoundary{SideKind::Velocity, fluid::VectorFunction::uniform(stream)}, outflow},
                  {slip, slip},
                  {symmetry, symmetry}}},
                {.immersed = ImmersedScheme::Curvib, .viscosity = 0.01});
  flow.solver.start(fluid::VectorFunction::uniform(stream), 0.0);
  for (int n = 0; n < 50; ++n) {
    const double x = 0.7 + flow.t + 0.02;
    flow.step(0.02, moving({.origin = {x, 0.3, 0.2}, .a = {0.4, 0.3, 0.0}, .b = {0.0, 0.1, 0.5}, .divisions = {4, 4}},
                           stream));
    flow.solver.accept();
  }
  EXPECT_LE(velocity_error(flow, [&](const Vec3&) { return stream; }), 1e-13);
  EXPECT_LE(flow.largest_divergence, 1e-13);
}

Ball swimming(double t)
{
  return {.radius = 0.41,
          .centre = {-0.2 + 0.5 * t, 0.05 - 0.2 * t, 0.1 * t},
          .velocity = {0.5, -0.2, 0.1},
          .spin = {0.3, -1.0, 2.0}};
}

TEST(Curvib, ABodyThatSwimsAndTurnsLeavesEveryCellWithoutDivergenceAndFeelsTheOutsideOnly)
{
  TestFlow flow({stretched_faces(-1, 1, 20, 0.2), stretched_faces(-1, 1, 18, -0.3), stretched_faces(-1, 1, 16, 0.1)},
                {{{wall, wall}, {wall, wall}, {slip, slip}}}, {.immersed = ImmersedScheme::Curvib, .viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  std::size_t given_back = 0;
  for (int n = 0; n < 30; ++n) {
    flow.step(0.02, swimming(flow.t + 0.02).motion());
    given_back += flow.solver.links().flipped().size();
    const immersed::SheetLoads loads = flow.solver.loads();
    Vec3 outside = Vec3::Zero();
    for (std::size_t v = 0; v < loads.plus.size(); ++v) {
      EXPECT_EQ(loads.minus[v], Vec3(Vec3::Zero()));
      outside += loads.plus[v];
    }
    EXPECT_LT(outside[0], 0.0) << "the fluid and the walls hold it back";
    flow.solver.accept();
    EXPECT_LE(flow.solver.balance().leak(), 1e-12);
  }
  EXPECT_LE(flow.largest_divergence, 1e-13);
  EXPECT_GT(given_back, 20u);
}

TEST(Curvib, GoesOnFromItsStateAndOffsetsWithTheSameBits)
{
  const auto whole = make_stretched_flow(MPI_COMM_SELF, {}, {.immersed = ImmersedScheme::Curvib});
  const auto resumed = make_stretched_flow(MPI_COMM_SELF, {}, {.immersed = ImmersedScheme::Curvib});
  const auto advance = [](TestFlow& flow, int steps) {
    for (int n = 0; n < steps; ++n) {
      flow.step(0.01, heaving_sheet(flow.t + 0.01));
      flow.solver.accept();
    }
  };
  advance(*whole, 8);
  resumed->solver.restore(whole->solver.state(), whole->solver.links().accepted_offsets(),
                          whole->solver.wall_nodes()->accepted_offsets(), whole->t);
  resumed->t = whole->t;
  advance(*whole, 3);
  advance(*resumed, 3);
  const auto expected = views(whole->solver.state().u);
  const auto u = views(resumed->solver.state().u);
  for_each_cell_in_order(whole->grid.owned(), [&](int i, int j, int k) {
    ASSERT_EQ(luff::at(u, Index3{i, j, k}), luff::at(expected, Index3{i, j, k}));
  });
}

}  // namespace
}  // namespace luff::test
