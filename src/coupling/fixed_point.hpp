// SPDX-License-Identifier: BSD-3-Clause
// The fixed point d = S(F(d)) of one coupled time step: the flow F answers a displacement with loads, the shell S loads
// with a displacement.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "coupling/acceleration.hpp"

namespace luff::coupling {

/// d -> S(F(d)), from the accepted state at t^n, which it leaves as it is; both vectors have one length.
using InterfaceMap = std::function<Eigen::VectorXd(const Eigen::VectorXd& d)>;

/// The size of a residual S(F(d)) - d in units of the problem's scales; not finite where the residual is not.
using ResidualNorm = std::function<double(const Eigen::VectorXd& residual)>;

/// max|r| / length; length > 0.
ResidualNorm displacement_norm(double length);

/// The larger of the displacement's and the velocity's residual: max|r| max(1 / length, rate / velocity).
/// The velocity follows from the displacement through Newmark, so that its residual is rate * r, rate = gamma / (beta
/// dt).
ResidualNorm displacement_and_velocity_norm(double length, double velocity, double rate);

struct ConvergenceCriterion {
  double tolerance = 1e-8;  ///< of the residual norm
  int max_iterations = 30;  ///< evaluations of the map; 1 is loose coupling
};

enum class FixedPointOutcome { Converged, MaxIterations, NotFinite };

struct FixedPointReport {
  FixedPointOutcome outcome = FixedPointOutcome::MaxIterations;
  int iterations = 0;           ///< evaluations of the map
  double residual = 0;          ///< norm of the last one's residual, not relaxed
  std::vector<double> history;  ///< the same of every iteration
  bool converged() const { return outcome == FixedPointOutcome::Converged; }
};

/// Iterates from the guess d until the residual *before relaxation* is within the tolerance, so that a small
/// relaxation factor cannot fake convergence; one call is one step of the acceleration.
///
/// On return d is the last image S(F(d)), which is what the two sides hold; where that is not finite, d is the
/// iterate that produced it. Nothing is thrown but what the map throws.
FixedPointReport solve_fixed_point(const InterfaceMap& map, Eigen::VectorXd& d, Acceleration& acceleration,
                                   const ConvergenceCriterion& criterion, const ResidualNorm& norm);

}  // namespace luff::coupling
