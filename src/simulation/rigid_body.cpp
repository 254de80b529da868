// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/rigid_body.hpp"

#include <limits>

#include <Eigen/Dense>

#include "core/error.hpp"

namespace luff::simulation {

namespace {

Eigen::Quaterniond turned(const Vec3& rotation, const Eigen::Quaterniond& from)
{
  const double angle = rotation.norm();
  if (angle == 0.0)
    return from;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) * from).normalized();
}

/// theta, of length between 0 and pi.
Vec3 rotation_vector(const Eigen::Quaterniond& q)
{
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

}  // namespace

RigidBody::RigidBody(const RigidBodyProperties& properties) : properties_(properties)
{
  accepted_.centre = properties.centre;
  accepted_.velocity = masked(properties.velocity, 0);
  accepted_.spin = masked(properties.spin, 3);
}

/// Zero in the freedoms that the body does not have; first = 0: displacements, 3: turns.
Vec3 RigidBody::masked(const Vec3& v, int first) const
{
  Vec3 result = v;
  for (int c = 0; c < 3; ++c)
    if (!properties_.free[first + c])
      result[c] = 0.0;
  return result;
}

Mat3 RigidBody::inertia(const Eigen::Quaterniond& turn) const
{
  const Mat3 R = turn.toRotationMatrix();
  return R * properties_.inertia * R.transpose();
}

/// Of the flow, gravity, springs and dampers together.
Wrench RigidBody::total(const RigidState& state, const Wrench& flow) const
{
  const RigidBodyProperties& b = properties_;
  return {flow.force + b.mass * b.gravity - b.stiffness.cwiseProduct(state.centre - b.centre) -
              b.damping.cwiseProduct(state.velocity),
          flow.moment - b.turning_stiffness.cwiseProduct(rotation_vector(state.turn)) -
              b.turning_damping.cwiseProduct(state.spin)};
}

Vec6 RigidBody::predict(double dt) const
{
  Vec6 d;
  Vec3 acceleration = Vec3::Zero();
  Vec3 spin_rate = Vec3::Zero();
  if (started_) {
    const Wrench now = total(accepted_, accepted_flow_);
    const Mat3 J = inertia(accepted_.turn);
    acceleration = now.force / properties_.mass;
    spin_rate = J.ldlt().solve(now.moment - accepted_.spin.cross(J * accepted_.spin));
  }
  d.head<3>() = masked(dt * accepted_.velocity + 0.5 * dt * dt * acceleration, 0);
  d.tail<3>() = properties_.length * masked(dt * accepted_.spin + 0.5 * dt * dt * spin_rate, 3);
  return d;
}

RigidState RigidBody::state(const Vec6& d, double dt) const
{
  const Vec3 rotation = d.tail<3>() / properties_.length;
  return {.centre = accepted_.centre + d.head<3>(),
          .turn = turned(rotation, accepted_.turn),
          .velocity = 2.0 / dt * d.head<3>() - accepted_.velocity,
          .spin = 2.0 / dt * rotation - accepted_.spin};
}

Vec6 RigidBody::solve(const Wrench& flow, double dt) const
{
  Vec6 d;
  d.head<3>() = displacement(flow, dt);
  d.tail<3>() = properties_.length * turn(flow, dt);
  return d;
}

/// (2 m/dt^2 + c/dt + k/2) y = 2 m v_n/dt + (F_n + F(x_n, -v_n))/2 in each freedom, y = x - x_n: linear.
Vec3 RigidBody::displacement(const Wrench& flow, double dt) const
{
  const RigidBodyProperties& b = properties_;
  RigidState unmoved = accepted_;
  unmoved.velocity = -accepted_.velocity;
  const Vec3 force = total(accepted_, wrench_before(flow)).force + total(unmoved, flow).force;
  const Vec3 right = 2.0 * b.mass / dt * accepted_.velocity + 0.5 * force;
  const Vec3 left = Vec3::Constant(2.0 * b.mass / (dt * dt)) + b.damping / dt + 0.5 * b.stiffness;
  return masked(right.cwiseQuotient(left), 0);
}

/// Newton's method for the rotation vector of the step, without the change of J, which is smaller by the angle.
Vec3 RigidBody::turn(const Wrench& flow, double dt) const
{
  constexpr int most_iterations = 100;
  const Vec3 at_start =
      inertia(accepted_.turn) * accepted_.spin + 0.5 * dt * total(accepted_, wrench_before(flow)).moment;
  Vec3 rotation = masked(dt * accepted_.spin, 3);
  double last = std::numeric_limits<double>::infinity();
  for (int n = 0; n < most_iterations; ++n) {
    Vec6 d = Vec6::Zero();
    d.tail<3>() = properties_.length * rotation;
    const RigidState after = state(d, dt);
    const Mat3 J = inertia(after.turn);
    const Vec3 residual = J * after.spin - 0.5 * dt * total(after, flow).moment - at_start;
    Mat3 slope = 2.0 / dt * J;
    slope.diagonal() += 0.5 * dt * properties_.turning_stiffness + properties_.turning_damping;
    for (int c = 0; c < 3; ++c)
      if (!properties_.free[3 + c]) {
        slope.row(c).setZero();
        slope.col(c).setZero();
        slope(c, c) = 1.0;
      }
    const Vec3 correction = slope.ldlt().solve(masked(residual, 3));
    rotation -= correction;
    const double size = correction.norm();
    // Round-off is reached when corrections are tiny and do not shrink any more.
    if (size == 0.0 || (size < 1e-12 && size >= 0.5 * last))
      return rotation;
    last = size;
  }
  fail_to_converge("a free body turns by {:.3g} rad in a step of {:.3g}: too far; a smaller time.step may help",
                   rotation.norm(), dt);
}

void RigidBody::accept(const Vec6& d, const Wrench& flow, double dt)
{
  accepted_ = state(d, dt);
  accepted_flow_ = flow;
  started_ = true;
}

RigidBody::Checkpoint RigidBody::checkpoint() const
{
  Checkpoint saved{};
  Eigen::Map<Eigen::Matrix<double, 20, 1>>(saved.data()) << accepted_.centre, accepted_.turn.coeffs(),
      accepted_.velocity, accepted_.spin, accepted_flow_.force, accepted_flow_.moment, started_ ? 1.0 : 0.0;
  return saved;
}

void RigidBody::restore(const Checkpoint& saved)
{
  const Eigen::Map<const Eigen::Matrix<double, 20, 1>> numbers(saved.data());
  accepted_.centre = numbers.segment<3>(0);
  accepted_.turn.coeffs() = numbers.segment<4>(3);
  accepted_.velocity = numbers.segment<3>(7);
  accepted_.spin = numbers.segment<3>(10);
  accepted_flow_ = {numbers.segment<3>(13), numbers.segment<3>(16)};
  started_ = numbers[19] != 0.0;
}

}  // namespace luff::simulation
