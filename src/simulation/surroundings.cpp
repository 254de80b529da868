// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/surroundings.hpp"

#include "core/error.hpp"

namespace luff::simulation {

namespace {

void require_inside(const grid::Grid& grid, const immersed::SheetMotion& sheets, const TimeStep& step)
{
  for (std::size_t v = 0; v < sheets.position.size(); ++v)
    for (int a = 0; a < 3; ++a) {
      const double x = sheets.position[v][a];
      // Sheets may end on symmetry planes; a thousandth of a cell is their rounding.
      const double slack = 1e-3 * grid.width(a, 0);
      if (x >= grid.face(a, 0) - slack && x <= grid.face(a, grid.cells()[a]) + slack)
        continue;
      fail_run(
          "step {}, t = {:.6g}: vertex {} of a sheet is at ({:.4g}, {:.4g}, {:.4g}), outside the grid along {}: the "
          "grid must reach further, or the run has diverged (a smaller time.step may help)",
          step.index, step.t_new, v, sheets.position[v][0], sheets.position[v][1], sheets.position[v][2], "xyz"[a]);
    }
}

}  // namespace

void Flow::begin_step(const TimeStep& step, const immersed::SheetMotion& predicted)
{
  require_inside(*grid_, predicted, step);
  report_ = {};
  solver_->begin_step(step, predicted);
  report_.momentum_iterations = solver_->newton().krylov_iterations;
}

immersed::SheetLoads Flow::loads(std::span<const Vec3> sheet_velocity)
{
  const poisson::Report projection = solver_->project(sheet_velocity);
  report_.pressure_iterations += projection.iterations;
  report_.divergence = projection.divergence;
  return solver_->loads();
}

}  // namespace luff::simulation
