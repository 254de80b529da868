// SPDX-License-Identifier: BSD-3-Clause
// Schemes that march M a + D v + f(x, t) = 0 in time: where a step is in balance and how rates follow from positions.
#include "shell/time_scheme.hpp"

#include "core/error.hpp"

namespace luff::shell {

TimeScheme TimeScheme::newmark(double damping)
{
  if (!(damping >= 0 && damping <= 1))
    fail_input("Newmark's scheme with damping = {} must have it in 0 to 1", damping);
  return {0, 0, 0.25 * (1 + damping) * (1 + damping), 0.5 + damping};
}

TimeScheme TimeScheme::generalised_alpha(double rho_inf)
{
  if (!(rho_inf >= 0 && rho_inf <= 1))
    fail_input("the generalised-alpha scheme with rho_inf = {} must have it in 0 to 1", rho_inf);
  const double alpha_m = (2 * rho_inf - 1) / (rho_inf + 1), alpha_f = rho_inf / (rho_inf + 1);
  const double beta = 0.25 * (1 - alpha_m + alpha_f) * (1 - alpha_m + alpha_f);
  return {alpha_m, alpha_f, beta, 0.5 - alpha_m + alpha_f};
}

TimeScheme TimeScheme::midpoint()
{
  return {0, 0.5, 0.5, 1, 0.5};
}

Kinematics TimeScheme::kinematics(const State& before, const Eigen::VectorXd& moved, double dt) const
{
  Kinematics k;
  k.a = 1 / (beta_ * dt * dt) * (moved - dt * before.v) - (0.5 / beta_ - 1) * before.a;
  k.v = before.v + dt * ((1 - gamma_) * before.a + gamma_ * k.a);
  return k;
}

Kinematics TimeScheme::balanced(const State& before, const Kinematics& after) const
{
  return {balanced(before.v, after.v),
          alpha_m_ == 0 ? after.a : Eigen::VectorXd((1 - alpha_m_) * after.a + alpha_m_ * before.a)};
}

}  // namespace luff::shell
