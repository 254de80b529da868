// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of a shell under slowly growing loads.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "shell/folds.hpp"
#include "shell/loads.hpp"
#include "shell/newton.hpp"

namespace luff::shell {

struct StaticOptions {
  int steps = 20;          ///< equal load steps, at least 1
  int max_halvings = 6;    ///< of a step that finds no equilibrium
  double time = 0;         ///< at which loads that depend on time are evaluated
  double fold_limit = 75;  ///< a step that folds the shell by more over an edge is refused [degrees]
  NewtonPolicy newton{.tolerance = 1e-11, .slow = 0, .max_iterations = 30};
  LinearSolverKind linear_solver = LinearSolverKind::Direct;
};

/// Equilibrium at one load factor.
struct StaticStep {
  int step = 0;
  double load_factor = 0;  ///< step/steps, multiplies every load and gravity
  Eigen::VectorXd positions;
  NewtonReport report;
  Folds folds;
};

/// \throws InputError when a rigid motion of the shell meets no support.
void check_supported(const Shell& shell);

/// Load stepping with full Newton steps, halved where they fail; returns the last equilibrium, reports each.
/// \throws InputError when a rigid motion of the shell meets no support.
/// \throws RunError naming the step, load factor and place when there is no equilibrium or the shell folds.
StaticStep solve_static(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options = {},
                        const std::function<void(const StaticStep&)>& on_step = {});

}  // namespace luff::shell
