// SPDX-License-Identifier: BSD-3-Clause
// Relaxation of a fixed point by a constant factor.
#pragma once

#include "coupling/acceleration.hpp"

namespace luff::coupling {

/// d_{k+1} = d_k + w (d~_k - d_k)
class ConstantRelaxation : public Acceleration {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {}
  void begin_step() override {}
  Eigen::VectorXd next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde) override
  {
    return d + factor_ * (d_tilde - d);
  }
  void end_step(bool /*converged*/) override {}

 private:
  double factor_;
};

}  // namespace luff::coupling
