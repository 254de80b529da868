// SPDX-License-Identifier: BSD-3-Clause
// Grids, flows and error norms for tests of the flow solver.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "fluid/flow_solver.hpp"
#include "support/faces.hpp"

namespace luff::test {

constexpr fluid::StepLimits rk3_limits = fluid::step_limits(fluid::TimeScheme::Rk3);

inline fluid::Boundaries all_sides(fluid::SideKind kind, const fluid::VectorFunction& velocity)
{
  fluid::Boundaries sides;
  for (auto& axis : sides)
    for (auto& side : axis)
      side = {kind, velocity};
  return sides;
}

/// Every axis between periodic sides, or between sides of one kind.
inline fluid::Boundaries sides_of(const std::array<bool, 3>& periodic, const fluid::SideBoundary& other)
{
  fluid::Boundaries sides;
  for (int a = 0; a < 3; ++a)
    for (auto& side : sides[a])
      side = periodic[a] ? fluid::SideBoundary{.kind = fluid::SideKind::Periodic} : other;
  return sides;
}

/// A flow solver with its grid and pressure solver.
struct TestFlow {
  TestFlow(std::array<std::vector<double>, 3> faces, const fluid::Boundaries& sides, const fluid::FlowOptions& options,
           MPI_Comm comm = MPI_COMM_WORLD)
      : grid(comm, std::move(faces), fluid::periodic_axes(sides)),
        solver(grid, options, sides, poisson::make_pressure_solver(grid, fluid::pressure_conditions(sides)))
  {
  }
  /// On a curvilinear grid.
  TestFlow(const Index3& cells, const grid::NodeSource& nodes, const fluid::Boundaries& sides,
           const fluid::FlowOptions& options, MPI_Comm comm = MPI_COMM_WORLD)
      : grid(comm, cells, nodes, fluid::periodic_axes(sides)),
        solver(grid, options, sides, poisson::make_pressure_solver(grid, fluid::pressure_conditions(sides)))
  {
  }
  /// One trial step with sheets that move as given; solver.accept() commits it.
  void step(double dt, const immersed::SheetMotion& sheets = {})
  {
    const TimeStep next{t, t + dt, dt, solver.state().steps + 1};
    solver.begin_step(next, sheets);
    largest_divergence = std::max(largest_divergence, solver.project(sheets.velocity).divergence);
    t += dt;
  }
  void advance(double dt, int steps, const immersed::SheetMotion& sheets = {})
  {
    for (int n = 0; n < steps; ++n) {
      step(dt, sheets);
      solver.accept();
    }
  }

  grid::Grid grid;
  fluid::FlowSolver solver;
  double t = 0.0;
  double largest_divergence = 0.0;
};

/// Volume-weighted root mean square of |u - exact| over the domain.
inline double velocity_error(const TestFlow& flow, const std::function<Vec3(const Vec3&)>& exact)
{
  const auto u = views(flow.solver.state().u);
  double sum = 0.0;
  double volume = 0.0;
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    const double V = flow.grid.volume(i, j, k);
    const Vec3 here(u[0](i, j, k), u[1](i, j, k), u[2](i, j, k));
    sum += V * (here - exact(flow.grid.centre(i, j, k))).squaredNorm();
    volume += V;
  });
  return std::sqrt(flow.grid.ranks().sum(sum) / flow.grid.ranks().sum(volume));
}

/// The same of p at the latest time level, extrapolated from the half levels, up to a constant.
inline double pressure_error(const TestFlow& flow, const std::function<double(const Vec3&)>& exact)
{
  const auto p = flow.solver.state().p.view();
  const auto p_before = flow.solver.state().p_before.view();
  const auto error = [&](int i, int j, int k) {
    return 1.5 * p(i, j, k) - 0.5 * p_before(i, j, k) - exact(flow.grid.centre(i, j, k));
  };
  const auto integral = [&](auto value) {
    double sum = 0.0;
    for_each_cell_in_order(flow.grid.owned(),
                           [&](int i, int j, int k) { sum += flow.grid.volume(i, j, k) * value(i, j, k); });
    return flow.grid.ranks().sum(sum);
  };
  const double volume = integral([](int, int, int) { return 1.0; });
  const double mean = integral(error) / volume;
  return std::sqrt(integral([&](int i, int j, int k) { return std::pow(error(i, j, k) - mean, 2); }) / volume);
}

/// Order observed between two resolutions.
inline double observed_order(double coarse_error, double fine_error, double ratio = 2.0)
{
  return std::log(coarse_error / fine_error) / std::log(ratio);
}

}  // namespace luff::test
