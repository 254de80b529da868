// SPDX-License-Identifier: BSD-3-Clause
// A shell under loads that grow together by one factor.
#include "shell/proportional_load.hpp"

namespace luff::shell {

ProportionalLoad::ProportionalLoad(const Shell& shell, const std::vector<Load>& loads, double time)
    : shell_(shell), time_(time), loads_(Loads(shell, loads).at(time))
{
}

Eigen::VectorXd ProportionalLoad::load(const Eigen::VectorXd& x) const
{
  Eigen::VectorXd f = loads_.force(x);
  shell_.clear_held(f);
  return f;
}

Eigen::VectorXd ProportionalLoad::residual(const Eigen::VectorXd& x, double factor) const
{
  Eigen::VectorXd r = factor * loads_.force(x) - internal_force(x, factor);
  shell_.clear_held(r);
  return r;
}

double ProportionalLoad::elastic_energy(const Eigen::VectorXd& x, double factor) const
{
  return shell_.elastic_energy(x, shell_.images_at(x, time_, factor));
}

Eigen::VectorXd ProportionalLoad::internal_force(const Eigen::VectorXd& x, double factor) const
{
  return shell_.internal_force(x, shell_.images_at(x, time_, factor));
}

void ProportionalLoad::place_supports(double factor, Eigen::VectorXd& x) const
{
  shell_.supports().place(shell_.reference_positions(), time_, factor, x);
}

void ProportionalLoad::add_tangent(const Eigen::VectorXd& x, double factor, BlockMatrix& K) const
{
  shell_.add_tangent(x, shell_.images_at(x, time_, factor), K);
  loads_.subtract_stiffness(x, factor, K);
}

SkewProduct ProportionalLoad::skew_stiffness(const Eigen::VectorXd& x, double factor) const
{
  return [this, x, factor](const Eigen::VectorXd& v) {
    Eigen::VectorXd product = factor * loads_.skew_stiffness_times(x, v);
    shell_.clear_held(product);
    return product;
  };
}

/// The work along a straight line by Simpson's rule, exact for dead loads and for pressure, which is quadratic in x.
double ProportionalLoad::released_energy(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double factor) const
{
  const Eigen::VectorXd mean_force = (loads_.force(x) + 4 * loads_.force(0.5 * (x + y)) + loads_.force(y)) / 6;
  return factor * mean_force.dot(y - x) - (elastic_energy(y, factor) - elastic_energy(x, factor));
}

Equilibrium ProportionalLoad::equilibrium(const double& factor) const
{
  return {.residual = [this, &factor](const Eigen::VectorXd& x) { return residual(x, factor); },
          .tangent = [this, &factor](const Eigen::VectorXd& x, BlockMatrix& K) { add_tangent(x, factor, K); }};
}

}  // namespace luff::shell
