// SPDX-License-Identifier: BSD-3-Clause
// Relaxation of a fixed point by Aitken's factor for vectors (kuettler_2008_fixed).
#pragma once

#include "coupling/acceleration.hpp"

namespace luff::coupling {

/// d_{k+1} = d_k + w_k r_k,  r = d~ - d,  w_k = -w_{k-1} r_{k-1}.(r_k - r_{k-1}) / |r_k - r_{k-1}|^2,  |w| bounded.
/// A step starts with the last factor of the one before, no larger than the initial one.
class Aitken : public Acceleration {
 public:
  Aitken(double initial_factor, double largest_factor);
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde) override;
  void end_step(bool converged) override;
  [[nodiscard]] History history() const override;
  void restore(const History& history) override;

  double factor() const { return factor_; }

 private:
  double secant_factor(const Eigen::VectorXd& residual) const;

  double initial_factor_;
  double largest_factor_;
  double factor_;
  Eigen::VectorXd last_residual_;  // empty before the first iteration of a step
};

}  // namespace luff::coupling
