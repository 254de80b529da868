// SPDX-License-Identifier: BSD-3-Clause
// Linear systems whose matrix is a factorised symmetric one less a skew one.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "shell/linear_solver.hpp"

namespace luff::shell {

/// v -> S v with a skew S; zero where held.
using SkewProduct = std::function<Eigen::VectorXd(const Eigen::VectorXd& v)>;

/// x of (K - S) x = r, to 1e-10 or what 50 iterations reach, by GMRES [saad_1986_gmres] on (I - K^-1 S) x = K^-1 r.
/// `solver` has K. Where K is positive definite, r.x = x.K.x > 0, whatever S is.
Eigen::VectorXd solve_with_skew(LinearSolver& solver, const SkewProduct& skew, const Eigen::VectorXd& r);

}  // namespace luff::shell
