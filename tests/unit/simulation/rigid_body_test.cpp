// SPDX-License-Identifier: BSD-3-Clause
// Six degrees of freedom by the trapezoidal rule.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "simulation/rigid_body.hpp"

namespace luff::simulation {
namespace {

/// Without a flow.
void advance(RigidBody& body, double dt, int steps, const Wrench& wrench = {})
{
  for (int n = 0; n < steps; ++n)
    body.accept(body.solve(wrench, dt), wrench, dt);
}

RigidBodyProperties top()
{
  RigidBodyProperties body{.mass = 2.0, .centre = {1, 2, 3}, .velocity = {0.3, -0.2, 0.1}, .spin = {1.0, 0.4, -0.7}};
  body.inertia = Vec3(1.0, 2.5, 0.6).asDiagonal();
  return body;
}

Vec3 angular_momentum(const RigidBody& body)
{
  const Mat3 R = body.accepted().turn.toRotationMatrix();
  return R * body.properties().inertia * R.transpose() * body.accepted().spin;
}

TEST(RigidBody, KeepsMomentumAndAngularMomentumInFreeFlight)
{
  RigidBody body(top());
  const Vec3 before = angular_momentum(body);
  advance(body, 0.05, 1000);
  EXPECT_LE((angular_momentum(body) - before).norm(), 1e-12);
  EXPECT_LE((body.accepted().centre - Vec3(1 + 15, 2 - 10, 3 + 5)).norm(), 1e-11);
  EXPECT_LE((body.accepted().velocity - top().velocity).norm(), 1e-12);
}

TEST(RigidBody, IsSecondOrderForATumblingTopOnTurningSprings)
{
  RigidBodyProperties properties = top();
  properties.turning_stiffness = {0.5, 1.0, 2.0};
  properties.turning_damping = {0.1, 0.0, 0.05};
  const auto end = [&](int steps) {
    RigidBody body(properties);
    advance(body, 2.0 / steps, steps);
    return body.accepted().turn;
  };
  const Eigen::Quaterniond exact = end(3200);
  const double coarse = end(50).angularDistance(exact);
  const double fine = end(100).angularDistance(exact);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
  EXPECT_GT(coarse, 1e-5);
}

TEST(RigidBody, SwingsOnASpringWithItsFrequencyAndDamping)
{
  const double k = 4.0;
  const double m = 2.0;
  const double c = 0.4;
  RigidBodyProperties properties{.mass = m, .stiffness = {0, k, 0}, .damping = {0, c, 0}, .velocity = {0, 1, 0}};
  const double decay = c / (2 * m);
  const double frequency = std::sqrt(k / m - decay * decay);
  const auto error = [&](int steps) {
    RigidBody body(properties);
    advance(body, 5.0 / steps, steps);
    return std::abs(body.accepted().centre[1] - std::exp(-5.0 * decay) * std::sin(5.0 * frequency) / frequency);
  };
  EXPECT_NEAR(std::log2(error(100) / error(200)), 2.0, 0.02);
  EXPECT_LE(error(200), 1e-3);
}

TEST(RigidBody, TurnsAboutTheOnlyAxisLeftFreeAndHangsWhereTheSpringBalancesTheMoment)
{
  RigidBodyProperties properties{.turning_stiffness = Vec3::Constant(3.0), .turning_damping = Vec3::Constant(4.0)};
  properties.free = {false, false, false, false, false, true};
  properties.inertia << 1.0, 0.2, 0.1, 0.2, 1.5, 0.3, 0.1, 0.3, 2.0;
  RigidBody body(properties);
  advance(body, 0.05, 2000, {.force = {5, 5, 5}, .moment = {7, -4, 1.5}});
  const Eigen::AngleAxisd turn(body.accepted().turn);
  EXPECT_LE((turn.angle() * turn.axis() - Vec3(0, 0, 0.5)).norm(), 1e-10);
  EXPECT_EQ(body.accepted().centre, Vec3(Vec3::Zero()));
}

TEST(RigidBody, FallsUnderGravityAsTheParabola)
{
  RigidBody body({.mass = 3.0, .gravity = {0, 0, -2.0}});
  advance(body, 0.1, 30);
  EXPECT_NEAR(body.accepted().centre[2], -9.0, 1e-12);
  EXPECT_NEAR(body.accepted().velocity[2], -6.0, 1e-12);
}

TEST(RigidBody, SaysThatItTurnsTooFarInAStep)
{
  RigidBodyProperties properties;
  properties.inertia = Vec3(1.0, 5.0, 20.0).asDiagonal();
  properties.spin = {30.0, 40.0, 5.0};
  RigidBody body(properties);
  EXPECT_THROW(advance(body, 1.0, 5), NonConvergence);
}

}  // namespace
}  // namespace luff::simulation
