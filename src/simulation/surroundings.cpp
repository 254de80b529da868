// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/surroundings.hpp"

#include <limits>

#include "core/error.hpp"

namespace luff::simulation {

namespace {

/// The box around the nodes of all ranks.  Collective.
Reach reach_of(const grid::Grid& grid)
{
  Reach reach{Vec3::Constant(std::numeric_limits<double>::max()),
              Vec3::Constant(std::numeric_limits<double>::lowest())};
  for_each_cell_in_order(grid.owned().faces(0).faces(1).faces(2), [&](int i, int j, int k) {
    reach.low = reach.low.cwiseMin(grid.node(i, j, k));
    reach.high = reach.high.cwiseMax(grid.node(i, j, k));
  });
  for (int a = 0; a < 3; ++a) {
    reach.low[a] = -grid.ranks().max(-reach.low[a]);
    reach.high[a] = grid.ranks().max(reach.high[a]);
  }
  // Sheets may end on symmetry planes; a thousandth of a cell is their rounding.
  const Vec3 slack = Vec3::Constant(1e-3 * grid.smallest_width());
  return {reach.low - slack, reach.high + slack};
}

void require_inside(const Reach& reach, const immersed::SheetMotion& sheets, const TimeStep& step)
{
  for (std::size_t v = 0; v < sheets.position.size(); ++v)
    for (int a = 0; a < 3; ++a) {
      const double x = sheets.position[v][a];
      if (x >= reach.low[a] && x <= reach.high[a])
        continue;
      fail_run(
          "step {}, t = {:.6g}: vertex {} of a sheet is at ({:.4g}, {:.4g}, {:.4g}), outside the grid along {}: the "
          "grid must reach further, or the run has diverged (a smaller time.step may help)",
          step.index, step.t_new, v, sheets.position[v][0], sheets.position[v][1], sheets.position[v][2], "xyz"[a]);
    }
}

}  // namespace

Flow::Flow(std::unique_ptr<grid::Grid> grid, std::unique_ptr<fluid::FlowSolver> solver, immersed::VertexPatches patches)
    : grid_(std::move(grid)), solver_(std::move(solver)), reach_(reach_of(*grid_)), patches_(std::move(patches))
{
}

void Flow::begin_step(const TimeStep& step, const immersed::SheetMotion& predicted)
{
  require_inside(reach_, predicted, step);
  report_ = {};
  patches_.update(*grid_, predicted.position);
  immersed::SheetMotion seen = predicted;
  seen.velocity = patches_.seen(predicted.velocity);
  seen.acceleration = patches_.seen(predicted.acceleration);
  solver_->begin_step(step, seen);
  report_.momentum_iterations = solver_->newton().krylov_iterations;
}

immersed::SheetLoads Flow::loads(std::span<const Vec3> sheet_velocity)
{
  const poisson::Report projection = solver_->project(patches_.seen(sheet_velocity));
  report_.pressure_iterations += projection.iterations;
  report_.divergence = projection.divergence;
  return patches_.spread(solver_->loads());
}

fluid::PressureLoads Flow::pressure_loads() const
{
  const fluid::PressureLoads loads = solver_->pressure_loads();
  return {.at_end = patches_.spread(loads.at_end), .in_middle = patches_.spread(loads.in_middle)};
}

}  // namespace luff::simulation
