// SPDX-License-Identifier: BSD-3-Clause
// Means over time of vortices that a stream carries past.
#include <iostream>

#include <gtest/gtest.h>

#include "simulation/flow_moments.hpp"
#include "support/exact_flows.hpp"
#include "support/flow.hpp"

namespace luff::simulation {
namespace {

using test::TaylorGreen;

/// Largest differences of means and fluctuations from the exact ones over one period of passage.
struct Errors {
  double mean = 0.0;
  double rms = 0.0;
  double pressure = 0.0;
  double pressure_rms = 0.0;
};

/// Means along x of Taylor-Green's vortices: u = U - cos(kX) sin(ky), v = sin(kX) cos(ky), p = -(cos 2kX + cos 2ky)/4,
/// X = x - Ut.
Errors errors(int n)
{
  const TaylorGreen exact{.viscosity = 0.0, .stream = {1.0, 0.0, 0.0}};
  test::TestFlow flow({test::stretched_faces(0.0, 1.0, n, 0.15), test::stretched_faces(0.0, 1.0, n, -0.15),
                       test::stretched_faces(0.0, 0.1, 1, 0.0)},
                      test::all_sides(fluid::SideKind::Periodic, exact.function()), {.viscosity = 0.0});
  flow.solver.start(exact.function(), 0.0);
  FlowMoments moments(flow.grid.owned());
  const int steps = 4 * n;
  for (int step = 0; step < steps; ++step) {
    flow.advance(1.0 / steps, 1);
    moments.add(flow.solver, 1.0 / steps);
  }
  Errors worst;
  const auto larger = [](double& of, double error) { of = std::max(of, std::abs(error)); };
  double mean_p = 0.0;
  for_each_cell_in_order(flow.grid.owned(),
                         [&](int i, int j, int k) { mean_p += flow.grid.volume(i, j, k) * moments.p(i, j, k) / 0.1; });
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    const double y = exact.k * flow.grid.centre(1, j);
    larger(worst.mean, moments.u[0](i, j, k) - 1.0);
    larger(worst.mean, moments.u[1](i, j, k));
    larger(worst.rms, std::sqrt(moments.uu[0](i, j, k)) - std::abs(std::sin(y)) / std::sqrt(2.0));
    larger(worst.rms, std::sqrt(moments.uu[1](i, j, k)) - std::abs(std::cos(y)) / std::sqrt(2.0));
    larger(worst.rms, moments.uu[3](i, j, k));
    larger(worst.pressure, moments.p(i, j, k) - mean_p + 0.25 * std::cos(2.0 * y));
    larger(worst.pressure_rms, std::sqrt(moments.pp(i, j, k)) - 0.25 / std::sqrt(2.0));
  });
  return worst;
}

TEST(FlowMoments, OfVorticesThatPassAreExactToSecondOrder)
{
  const Errors coarse = errors(16);
  const Errors fine = errors(32);
  for (const auto& [name, of_coarse, of_fine] :
       {std::tuple("mean", coarse.mean, fine.mean), std::tuple("rms", coarse.rms, fine.rms),
        std::tuple("mean pressure", coarse.pressure, fine.pressure),
        std::tuple("rms of the pressure", coarse.pressure_rms, fine.pressure_rms)}) {
    std::cout << "  " << name << ": " << of_coarse << ", " << of_fine << ", order "
              << test::observed_order(of_coarse, of_fine) << '\n';
    EXPECT_GE(test::observed_order(of_coarse, of_fine), 1.8) << name;
    EXPECT_LE(of_fine, 0.02) << name;
  }
}

TEST(FlowMoments, OfAFlowThatDoesNotChangeFluctuateByNothing)
{
  const auto velocity = fluid::VectorFunction::uniform({1e4, -2.0, 0.5});
  test::TestFlow flow(
      {test::stretched_faces(0, 1, 4, 0.2), test::stretched_faces(0, 1, 3, 0.2), test::stretched_faces(0, 1, 2, 0.2)},
      test::all_sides(fluid::SideKind::Periodic, velocity), {.viscosity = 0.1});
  flow.solver.start(velocity, 0.0);
  FlowMoments moments(flow.grid.owned());
  flow.advance(1e-7, 1);
  for (const double dt : {0.1, 0.3, 0.02, 1.0})  // weights, whatever the step was
    moments.add(flow.solver, dt);
  EXPECT_DOUBLE_EQ(moments.time, 1.42);
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    EXPECT_NEAR(moments.u[0](i, j, k), 1e4, 1e-8);
    EXPECT_LE(std::sqrt(moments.uu[0](i, j, k)), 1e-10);  // <u^2> - <u>^2 would have lost 1e-4
  });
}

}  // namespace
}  // namespace luff::simulation
