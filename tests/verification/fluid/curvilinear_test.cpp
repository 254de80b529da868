// SPDX-License-Identifier: BSD-3-Clause
// The flow on curvilinear grids: what is exact, and the order of the rest on skewed cells.
#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/flow.hpp"
#include "support/orders.hpp"

namespace luff::test {
namespace {

using fluid::SideBoundary;
using fluid::SideKind;

/// Largest deviation from a uniform stream after 100 steps.
double drift(const Index3& cells, const grid::NodeSource& nodes, const fluid::FlowOptions& options)
{
  const Vec3 stream(1.0, -0.7, 0.3);
  const auto uniform = fluid::VectorFunction::uniform(stream);
  TestFlow flow(cells, nodes, sides_of({true, false, true}, {SideKind::Velocity, uniform}), options);
  flow.solver.start(uniform, 0.0);
  flow.advance(0.02, 100);
  EXPECT_LE(flow.largest_divergence, 1e-13);
  double largest = 0.0;
  for_each_cell_in_order(flow.grid.owned(), [&, u = views(flow.solver.state().u)](int i, int j, int k) {
    largest = std::max(largest, (at(u, {i, j, k}) - stream).norm());
  });
  return largest;
}

TEST(CurvilinearFlow, UniformStaysUniformForAHundredStepsOnRandomlyPerturbedCells)
{
  const Perturbed perturbed{{12, 10, 8}};
  for (const auto scheme : {fluid::TimeScheme::Rk3, fluid::TimeScheme::NewtonKrylov}) {
    const fluid::FlowOptions options{.scheme = scheme, .viscosity = 0.01};
    EXPECT_LE(drift(perturbed.cells, mapped_nodes(perturbed.cells, perturbed), options), 1e-13);
    EXPECT_LE(drift({12, 8, 10}, mapped_nodes({12, 8, 10}, Mirrored<Perturbed>{perturbed}), options), 1e-13);
  }
}

/// Marches to `end` with 0.6 times `factor` of the longest step that the explicit scheme is stable with.
void march(TestFlow& flow, double end, double factor = 1.0)
{
  const double dt = 0.6 * factor *
                    std::min(rk3_limits.convective / flow.solver.convective_rate(),
                             rk3_limits.diffusive / flow.solver.diffusive_rate());
  const int steps = static_cast<int>(std::ceil(end / dt));
  flow.advance(end / steps, steps);
}

/// Taylor-Green's vortices in the periodic unit box.
Errors taylor_green_errors(int n, fluid::TimeScheme scheme, double steps)
{
  const TaylorGreen exact{.viscosity = 0.01, .stream = {1.0, 0.5, 0.2}};
  TestFlow flow({n, n, n / 2}, mapped_nodes({n, n, n / 2}, Waved{}), sides_of({true, true, true}, {}),
                {.scheme = scheme, .viscosity = exact.viscosity, .stage_reduction = 0.0});
  flow.solver.start(exact.function(), 0.0);
  march(flow, 0.2, steps);
  return {velocity_error(flow, [&](const Vec3& x) { return exact.velocity(x, flow.t); }),
          pressure_error(flow, [&](const Vec3& x) { return exact.pressure(x, flow.t); }), flow.largest_divergence};
}

TEST(CurvilinearOrder, OfTaylorGreensVorticesInAPeriodicBoxIsTwo)
{
  const auto errors = [](int n) { return taylor_green_errors(n, fluid::TimeScheme::Rk3, 1.0); };
  expect_orders(errors(24), errors(48), 1.9);
}

TEST(CurvilinearOrder, OfTheImplicitSchemeInLongStepsIsTwo)
{
  const auto errors = [](int n) { return taylor_green_errors(n, fluid::TimeScheme::NewtonKrylov, 6.0); };
  expect_orders(errors(24), errors(48), 1.9);
}

/// Ethier and Steinman's flow between prescribed velocities, the cube [-1, 1]^3 with waved sides.
Errors ethier_steinman_errors(int n)
{
  const EthierSteinman exact{.viscosity = 0.05};
  const auto map = [wave = Waved{}](const Vec3& s) -> Vec3 { return 2.0 * wave(s) - Vec3::Ones(); };
  TestFlow flow({n, n, n}, mapped_nodes({n, n, n}, map),
                sides_of({false, false, false}, {SideKind::Velocity, exact.function()}),
                {.viscosity = exact.viscosity, .stage_reduction = 0.0});
  flow.solver.start(exact.function(), 0.0);
  march(flow, 0.2);
  return {velocity_error(flow, [&](const Vec3& x) { return exact.velocity(x, flow.t); }),
          pressure_error(flow, [&](const Vec3& x) { return exact.pressure(x, flow.t); }), flow.largest_divergence};
}

TEST(CurvilinearOrder, OfEthierAndSteinmansFlowBetweenPrescribedVelocitiesIsTwo)
{
  // Pressure: 1.90.
  expect_orders(ethier_steinman_errors(16), ethier_steinman_errors(32), 1.9, 1.89);
}

/// Kovasznay's flow between prescribed velocities and symmetry planes, left-handed.
Errors kovasznay_errors(int n)
{
  const Kovasznay exact;
  const fluid::VectorFunction velocity{[exact](const Vec3& x, double) { return exact.velocity(x); }, false};
  fluid::Boundaries sides = sides_of({false, false, false}, {SideKind::Velocity, velocity});
  sides[1] = {SideBoundary{SideKind::Symmetry, {}}, SideBoundary{SideKind::Symmetry, {}}};
  const auto map = [](const Vec3& s) -> Vec3 {
    using std::numbers::pi;
    const double wave = 0.05 * std::sin(2.0 * pi * s[0]) * std::sin(2.0 * pi * s[2]);
    // Narrow cells at the ends: errors that reach the outlet turn into a layer of thickness nu/U = 1/40 there.
    const double x = s[0] - 0.3 * std::sin(2.0 * pi * s[0]) / (2.0 * pi);
    return {-0.5 + 1.5 * (x + wave), 0.1 * s[1], -0.5 + s[2] + wave};
  };
  const auto turned = [map](const Vec3& s) -> Vec3 {
    const Vec3 x = map(s);
    return {x[0], x[2], x[1]};
  };
  TestFlow flow({n, 1, n}, mapped_nodes({n, 1, n}, turned), sides, {.viscosity = 1.0 / exact.reynolds});
  flow.solver.start(velocity, 0.0);
  march(flow, 2.9);  // steady to four digits of the error
  return {velocity_error(flow, [&](const Vec3& x) { return exact.velocity(x); }),
          pressure_error(flow, [&](const Vec3& x) { return exact.pressure(x); }), flow.largest_divergence};
}

TEST(CurvilinearOrder, OfKovasznaysFlowOnALeftHandedGridIsTwo)
{
  expect_orders(kovasznay_errors(24), kovasznay_errors(48), 1.9);
}

}  // namespace
}  // namespace luff::test
