// SPDX-License-Identifier: BSD-3-Clause
// The projection with PETSc's assembled matrices and solvers: an alternative, and the oracle of tests.
#pragma once

#include <vector>

#include "poisson/flux_correction.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Conjugate gradients with PETSc's algebraic multigrid on the assembled matrix, inside refinement of the fluxes.  The
/// matrix and its hierarchy are rebuilt whenever the blocked faces change.
///
/// PETSc is initialised by the first of these solvers, without the program's arguments and without signal handlers.
[[nodiscard]] std::unique_ptr<PressureSolver> make_petsc_solver(const grid::Grid& grid, const SideConditions& sides);

}  // namespace luff::poisson
