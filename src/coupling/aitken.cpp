// SPDX-License-Identifier: BSD-3-Clause
// Aitken's factor for vectors.
#include "coupling/aitken.hpp"

#include <algorithm>
#include <cmath>

namespace luff::coupling {

namespace {

// A factor of zero would repeat the same guess for ever.
constexpr double smallest_factor = 1e-4;

}  // namespace

Aitken::Aitken(double initial_factor, double largest_factor)
    : initial_factor_(std::min(initial_factor, largest_factor)),
      largest_factor_(largest_factor),
      factor_(initial_factor_)
{
}

void Aitken::begin_step()
{
  last_residual_.resize(0);
  factor_ = std::min(std::abs(factor_), initial_factor_);
}

Eigen::VectorXd Aitken::next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde)
{
  const Eigen::VectorXd residual = d_tilde - d;
  if (last_residual_.size() > 0)
    factor_ = secant_factor(residual);
  last_residual_ = residual;
  return d + factor_ * residual;
}

void Aitken::end_step(bool converged)
{
  if (!converged)
    factor_ = initial_factor_;
}

History Aitken::history() const
{
  History history;
  history.factor = factor_;
  return history;
}

void Aitken::restore(const History& history)
{
  if (history.factor != 0)
    factor_ = history.factor;
}

double Aitken::secant_factor(const Eigen::VectorXd& residual) const
{
  const Eigen::VectorXd change = residual - last_residual_;
  const double change_squared = change.squaredNorm();
  if (change_squared == 0)
    return factor_;
  const double w = -factor_ * last_residual_.dot(change) / change_squared;
  return std::copysign(std::clamp(std::abs(w), smallest_factor, largest_factor_), w);
}

}  // namespace luff::coupling
