// SPDX-License-Identifier: BSD-3-Clause
// Damped continuation: a shell out of balance moves as through syrup until it rests.
#pragma once

#include <string>

#include <Eigen/Core>

#include "shell/newton.hpp"
#include "shell/proportional_load.hpp"

namespace luff::shell {

struct SettlingOptions {
  int max_iterations = 3000;
  NewtonPolicy newton{.tolerance = 1e-11, .slow = 0, .max_iterations = 30};  ///< of the undamped end
};

struct SettlingReport {
  int iterations = 0;   ///< damped ones
  NewtonReport newton;  ///< undamped ones, the last, which find the equilibrium
};

/// Move x to a stable equilibrium at this load factor: down the potential energy from wherever x is, through snaps. The
/// end is a true equilibrium: damping has no part in it. Needs the direct solver.
///
/// Each iteration is an implicit Euler step of the viscous motion c A dx/ds = r,
///
///   (K + c A) dx = r,
///
/// with the area A_v of each vertex, so that the path hardly depends on the mesh. The damping c is raised until K + c A
/// is positive definite and the step releases energy about as a quadratic potential would, and lowered while it does
/// (Levenberg-Marquardt [more_1978_levenberg], pseudo-transient continuation [kelley_1998_convergence]).
/// \throws RunError that starts with `when` where the shell doesn't come to rest.
SettlingReport settle(const ProportionalLoad& problem, double factor, const SettlingOptions& options,
                      KeptTangent& tangent, Eigen::VectorXd& x, const std::string& when);

}  // namespace luff::shell
