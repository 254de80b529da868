// SPDX-License-Identifier: BSD-3-Clause
// Order of accuracy in space and time.
#include <iostream>

#include <gtest/gtest.h>

#include "support/exact_flows.hpp"
#include "support/flow.hpp"
#include "support/orders.hpp"

namespace luff::test {
namespace {

using std::numbers::pi;

/// Taylor-Green's vortices on a stretched periodic grid; the step shrinks with the cells.
Errors taylor_green_errors(int n)
{
  const TaylorGreen exact{.viscosity = 0.01, .stream = {1.0, 0.5, 0.0}};
  TestFlow flow({stretched_faces(0, 1, n, 0.3), stretched_faces(0, 1, n, -0.3), {0.0, 0.1}},
                all_sides(fluid::SideKind::Periodic, exact.function()),
                {.viscosity = exact.viscosity, .stage_reduction = 0.0});
  flow.solver.start(exact.function(), 0.0);
  flow.advance(0.2 / n, 2 * n);
  return {velocity_error(flow, [&](const Vec3& x) { return exact.velocity(x, flow.t); }),
          pressure_error(flow, [&](const Vec3& x) { return exact.pressure(x, flow.t); }), flow.largest_divergence};
}

TEST(Order, TaylorGreenOnAStretchedPeriodicGridIsSecondOrderInSpace)
{
  const Errors coarse = taylor_green_errors(32);
  const Errors fine = taylor_green_errors(64);
  expect_orders(coarse, fine, 1.9);
}

Errors kovasznay_errors(int n)
{
  const Kovasznay exact;
  const fluid::VectorFunction velocity{[exact](const Vec3& x, double) { return exact.velocity(x); }, false};
  fluid::Boundaries sides = all_sides(fluid::SideKind::Velocity, velocity);
  sides[1] = {fluid::SideBoundary{fluid::SideKind::Periodic, {}}, fluid::SideBoundary{fluid::SideKind::Periodic, {}}};
  sides[2] = {fluid::SideBoundary{fluid::SideKind::Symmetry, {}}, fluid::SideBoundary{fluid::SideKind::Symmetry, {}}};
  // Narrow cells at the ends: errors that reach the outlet turn into a layer of thickness nu/U = 1/40 there.
  TestFlow flow({stretched_faces(-0.5, 1.0, n, -0.3), stretched_faces(-0.5, 0.5, n, -0.2), {0.0, 0.1}}, sides,
                {.viscosity = 1.0 / exact.reynolds});
  flow.solver.start(velocity, 0.0);
  flow.advance(0.16 / n, 18 * n);  // steady to four digits of the error
  return {velocity_error(flow, [&](const Vec3& x) { return exact.velocity(x); }),
          pressure_error(flow, [&](const Vec3& x) { return exact.pressure(x); }), flow.largest_divergence};
}

TEST(Order, KovasznayFlowBetweenPrescribedVelocitiesOnAStretchedGridIsSecondOrderInSpace)
{
  const Errors coarse = kovasznay_errors(24);
  const Errors fine = kovasznay_errors(48);
  expect_orders(coarse, fine, 1.9);
}

/// The same grid with different steps, against very small steps: the error in time alone.
class TimeError {
 public:
  explicit TimeError(fluid::TimeScheme scheme) : scheme_(scheme), reference_(march(scheme, 320)) {}
  [[nodiscard]] Errors operator()(int steps) const
  {
    const auto flow = march(scheme_, steps);
    const auto& a = flow->solver.state();
    const auto& b = reference_->solver.state();
    const auto square = [&](auto value) {
      return std::sqrt(sum_cells(flow->grid.owned(),
                                 [value](int i, int j, int k) {
                                   const double v = value(i, j, k);
                                   return v * v;
                                 }) /
                       flow->grid.owned().volume());
    };
    return {square([u = a.u[0].view(), v = b.u[0].view()](int i, int j, int k) { return u(i, j, k) - v(i, j, k); }),
            square([p = a.p.view(), q = a.p_before.view(), r = b.p.view(), s = b.p_before.view()](int i, int j, int k) {
              return 1.5 * p(i, j, k) - 0.5 * q(i, j, k) - 1.5 * r(i, j, k) + 0.5 * s(i, j, k);
            }),
            flow->largest_divergence};
  }

 private:
  static std::unique_ptr<TestFlow> march(fluid::TimeScheme scheme, int steps)
  {
    const TaylorGreen vortices{.viscosity = 0.05, .stream = {1.0, 0.5, 0.0}, .k = 1.0};
    auto flow = std::make_unique<TestFlow>(
        std::array{stretched_faces(0, 2 * pi, 32, 0.3), stretched_faces(0, 2 * pi, 32, 0.2), std::vector{0.0, 0.2}},
        all_sides(fluid::SideKind::Periodic, vortices.function()),
        fluid::FlowOptions{.scheme = scheme, .viscosity = vortices.viscosity, .stage_reduction = 0.0});
    flow->solver.start(vortices.function(), 0.0);
    flow->advance(1.6 / steps, steps);
    return flow;
  }
  fluid::TimeScheme scheme_;
  std::unique_ptr<TestFlow> reference_;
};

TEST(Order, VelocityIsThirdOrderAndPressureSecondOrderInTime)
{
  const TimeError error(fluid::TimeScheme::Rk3);
  const Errors coarse = error(20);
  const Errors fine = error(40);
  expect_orders(coarse, fine, 2.8);
}

TEST(Order, OfTheImplicitSchemeInTimeIsTwo)
{
  const TimeError error(fluid::TimeScheme::NewtonKrylov);
  const Errors coarse = error(20);
  const Errors fine = error(40);
  expect_orders(coarse, fine, 1.9);
}

}  // namespace
}  // namespace luff::test
