// SPDX-License-Identifier: BSD-3-Clause
// What follows from the mass of the fluid that moves with a shell.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/added_mass.hpp"

namespace luff::simulation {
namespace {

/// The largest acceleration of a free mass of 1 in a fluid of mass mu after some steps of loose coupling, told to the
/// flow and the scheme as a run does it: the flow sees the predictor's velocity and answers with the pressure
/// extrapolated to the end of the step.
double acceleration_after(const shell::TimeScheme& scheme, double mu, int steps)
{
  constexpr double dt = 0.1;
  shell::State state{.x = Eigen::VectorXd::Zero(1), .v = Eigen::VectorXd::Zero(1), .a = Eigen::VectorXd::Ones(1)};
  double velocity_seen = 0.0;
  double fluid_acceleration = 0.0;
  double force = 0.0;
  double largest = 0.0;
  for (int n = 0; n < steps; ++n) {
    const Eigen::VectorXd predicted = state.x + dt * state.v + 0.5 * dt * dt * state.a;
    const double velocity = scheme.kinematics(state, predicted - state.x, dt).v[0];
    const double acceleration = (velocity - velocity_seen) / dt;
    const double force_new = -mu * (1.5 * acceleration - 0.5 * fluid_acceleration);
    // The balance is linear in the new position.
    const auto out_of_balance = [&](const Eigen::VectorXd& x) {
      return scheme.balanced(state, scheme.kinematics(state, x - state.x, dt)).a[0] - scheme.balanced(force, force_new);
    };
    const double r = out_of_balance(predicted);
    const Eigen::VectorXd x = predicted.array() - r / scheme.acceleration_slope(dt);
    const shell::Kinematics k = scheme.kinematics(state, x - state.x, dt);
    state = {x, k.v, k.a, state.t + dt};
    velocity_seen = velocity;
    fluid_acceleration = acceleration;
    force = force_new;
    if (n > steps / 2)
      largest = std::max(largest, std::abs(state.a[0]));
  }
  return largest;
}

TEST(LooseCoupling, IsStableUpToItsLimitOnly)
{
  for (const shell::TimeScheme& scheme : {shell::TimeScheme::newmark(), shell::TimeScheme::generalised_alpha(0.8),
                                          shell::TimeScheme::generalised_alpha(0.0)}) {
    const double limit = loose_limit(scheme);
    EXPECT_LT(acceleration_after(scheme, 0.97 * limit, 2000), 1e-3) << limit;
    EXPECT_GT(acceleration_after(scheme, 1.03 * limit, 2000), 1e3) << limit;
  }
  EXPECT_NEAR(loose_limit(shell::TimeScheme::newmark()), 0.25, 1e-8);
  EXPECT_NEAR(loose_limit(shell::TimeScheme::generalised_alpha(0.0)), 0.375, 1e-8);
}

TEST(BorrowedMass, MakesShellsATenthAsHeavyAsTheFluidAndNoHeavierOnesHeavier)
{
  EXPECT_EQ(borrowed_mass(3.0), 0.0);
  EXPECT_EQ(borrowed_mass(10.0), 0.0);
  EXPECT_DOUBLE_EQ(borrowed_mass(960.0), 95.0);
}

}  // namespace
}  // namespace luff::simulation
