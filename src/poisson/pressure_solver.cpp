// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/pressure_solver.hpp"

#include "core/error.hpp"
#include "poisson/multigrid_solver.hpp"
#include "poisson/petsc_solver.hpp"

namespace luff::poisson {

std::unique_ptr<PressureSolver> make_pressure_solver(const grid::Grid& grid, const SideConditions& sides,
                                                     const SolverOptions& options)
{
  if (options.kind == "multigrid")
    return std::make_unique<MultigridSolver>(grid, sides);
  if (options.kind == "petsc") {
    if (grid.kind() == grid::Kind::Curvilinear)
      fail_input("pressure.solver = \"petsc\" does not know curvilinear grids: choose \"multigrid\"");
    return make_petsc_solver(grid, sides);
  }
  fail_input("pressure.solver = \"{}\" is not known: choose \"multigrid\" or \"petsc\"", options.kind);
}

}  // namespace luff::poisson
