// SPDX-License-Identifier: BSD-3-Clause
// The time schemes on one oscillator, x'' + omega^2 x = 0.
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/time_scheme.hpp"
#include "support/linear_shell.hpp"

namespace luff::shell {
namespace {

State one(double x, double v, double a)
{
  return {Eigen::VectorXd::Constant(1, x), Eigen::VectorXd::Constant(1, v), Eigen::VectorXd::Constant(1, a), 0};
}

/// One step: the balance is linear in the new position, so that one Newton step solves it.
State step(const TimeScheme& scheme, const State& before, double omega, double dt)
{
  const auto out_of_balance = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return scheme.balanced(before, scheme.kinematics(before, x - before.x, dt)).a +
           omega * omega * scheme.balanced(before.x, x);
  };
  const double slope = scheme.acceleration_slope(dt) + omega * omega * scheme.position_slope();
  const Eigen::VectorXd x = before.x - out_of_balance(before.x) / slope;
  const Kinematics k = scheme.kinematics(before, x - before.x, dt);
  return {x, k.v, k.a, before.t + dt};
}

State after(const TimeScheme& scheme, double omega, double t, int steps)
{
  State state = one(1, 0.5, -omega * omega);
  for (int n = 0; n < steps; ++n)
    state = step(scheme, state, omega, t / steps);
  return state;
}

double energy(const State& state, double omega)
{
  return 0.5 * (state.v.squaredNorm() + omega * omega * state.x.squaredNorm());
}

TEST(TimeScheme, AllAreSecondOrderButDampedNewmark)
{
  const double omega = 3, t = 2;
  const auto error = [&](const TimeScheme& scheme, int steps) {
    const State state = after(scheme, omega, t, steps);
    return std::hypot(state.x[0] - std::cos(omega * t) - 0.5 / omega * std::sin(omega * t),
                      (state.v[0] + omega * std::sin(omega * t) - 0.5 * std::cos(omega * t)) / omega);
  };
  const auto order = [&](const TimeScheme& scheme) {
    return test::observed_order(error(scheme, 400), error(scheme, 800));
  };
  EXPECT_NEAR(order(TimeScheme::newmark()), 2, 0.01);
  EXPECT_NEAR(order(TimeScheme::newmark(0.1)), 1, 0.05);
  EXPECT_NEAR(order(TimeScheme::generalised_alpha(0)), 2, 0.02);
  EXPECT_NEAR(order(TimeScheme::generalised_alpha(0.5)), 2, 0.02);
  EXPECT_NEAR(order(TimeScheme::midpoint()), 2, 0.01);
}

TEST(TimeScheme, NewmarkAndMidpointKeepTheEnergyOfAnOscillator)
{
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::midpoint()}) {
    const double before = energy(one(1, 0.5, 0), 3);
    EXPECT_NEAR(energy(after(scheme, 3, 1000, 10000), 3) / before, 1, 1e-11);
  }
  EXPECT_LT(energy(after(TimeScheme::newmark(0.1), 3, 1000, 10000), 3), 1e-3);
}

TEST(TimeScheme, GeneralisedAlphaDampsWhatStepsDontResolveByRhoInf)
{
  for (const double rho : {0.0, 0.3, 0.8, 1.0}) {
    const TimeScheme scheme = TimeScheme::generalised_alpha(rho);
    const double omega = 1e6;
    State state = one(1, 0, -omega * omega);
    const int steps = 40;
    for (int n = 0; n < steps; ++n)
      state = step(scheme, state, omega, 1);
    const double before = std::abs(state.x[0]);
    for (int n = 0; n < steps; ++n)
      state = step(scheme, state, omega, 1);
    // Its three roots coincide at -rho: powers n^2 rho^n, whose ratio over n steps goes to rho^n slowly.
    if (rho > 0)
      EXPECT_NEAR(std::pow(std::abs(state.x[0]) / before, 1.0 / steps), rho, 0.05 * rho) << rho;
    else
      EXPECT_LT(std::abs(state.x[0]), 1e-10);
  }
}

TEST(TimeScheme, GeneralisedAlphaWithoutDampingIsTheMidpointRule)
{
  const State a = after(TimeScheme::generalised_alpha(1), 3, 2, 50), b = after(TimeScheme::midpoint(), 3, 2, 50);
  EXPECT_NEAR(a.x[0], b.x[0], 1e-13);
  EXPECT_NEAR(a.v[0], b.v[0], 1e-13);
}

TEST(TimeScheme, NumbersOutOfRangeAreRefused)
{
  EXPECT_THROW(TimeScheme::newmark(-0.1), InputError);
  EXPECT_THROW(TimeScheme::generalised_alpha(1.1), InputError);
  EXPECT_THROW(TimeScheme::generalised_alpha(std::nan("")), InputError);
}

}  // namespace
}  // namespace luff::shell
