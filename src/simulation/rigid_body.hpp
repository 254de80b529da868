// SPDX-License-Identifier: BSD-3-Clause
// A rigid body that the flow moves.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "core/vec3.hpp"

namespace luff::simulation {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// What moves and what holds a body.  Springs and dampers act along and about the axes of space; they are at rest in
/// the first position.
struct RigidBodyProperties {
  double mass = 1.0;                                             ///< [M]
  Vec3 centre = Vec3::Zero();                                    ///< of mass, at first [L]
  Mat3 inertia = Mat3::Identity();                               ///< about the centre, at first [M L^2]
  std::array<bool, 6> free{true, true, true, true, true, true};  ///< displacements, then turns
  Vec3 stiffness = Vec3::Zero();                                 ///< [M/T^2]
  Vec3 damping = Vec3::Zero();                                   ///< [M/T]
  Vec3 turning_stiffness = Vec3::Zero();                         ///< [M L^2/T^2]
  Vec3 turning_damping = Vec3::Zero();                           ///< [M L^2/T]
  Vec3 gravity = Vec3::Zero();                                   ///< [L/T^2]
  Vec3 velocity = Vec3::Zero();                                  ///< at first [L/T]
  Vec3 spin = Vec3::Zero();                                      ///< at first [1/T]
  double length = 1.0;                                           ///< that makes turns comparable to displacements [L]
};

/// Where a body is and how it moves.
struct RigidState {
  Vec3 centre = Vec3::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< from the first position
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();

  /// Of a point whose place relative to the centre was `arm` at first.
  [[nodiscard]] Vec3 position(const Vec3& arm) const { return centre + turn * arm; }
  [[nodiscard]] Vec3 velocity_of(const Vec3& arm) const { return velocity + spin.cross(turn * arm); }
};

/// Force and moment about the centre.
struct Wrench {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

/// Trapezoidal rule in all six freedoms,
///
///   x = x_n + dt/2 (v + v_n),        m v = m v_n + dt/2 (F + F_n),
///   q = exp(dt/2 (w + w_n)) q_n,     J w = J_n w_n + dt/2 (M + M_n),   J = R J_0 R^T,
///
/// second order; without forces momentum and angular momentum stay the same to round-off.  F and M hold what the flow,
/// gravity, springs -k (x - x_0) and -k theta, and dampers do; theta is the rotation vector of q.
///
/// The body's part of the interface vector: displacement of the centre and turn in the step, the latter as a rotation
/// vector times `length`.
class RigidBody {
 public:
  explicit RigidBody(const RigidBodyProperties& properties);

  /// Where the accelerations at t_n would take it.
  [[nodiscard]] Vec6 predict(double dt) const;
  /// The state at the end of a step that ends at d.
  [[nodiscard]] RigidState state(const Vec6& d, double dt) const;
  /// Where it comes to rest in the step under the flow's force and moment at t_{n+1}.  Throws RunError when the turn
  /// does not converge: the body turns too far in the step.
  [[nodiscard]] Vec6 solve(const Wrench& flow, double dt) const;
  /// Commits d.
  void accept(const Vec6& d, const Wrench& flow, double dt);

  [[nodiscard]] const RigidState& accepted() const { return accepted_; }
  /// All that the next step starts from, as numbers.
  using Checkpoint = std::array<double, 20>;
  [[nodiscard]] Checkpoint checkpoint() const;
  void restore(const Checkpoint& saved);
  [[nodiscard]] const RigidBodyProperties& properties() const { return properties_; }

 private:
  [[nodiscard]] Mat3 inertia(const Eigen::Quaterniond& turn) const;
  [[nodiscard]] Vec3 masked(const Vec3& v, int first) const;
  [[nodiscard]] Vec3 displacement(const Wrench& flow, double dt) const;
  [[nodiscard]] Vec3 turn(const Wrench& flow, double dt) const;
  [[nodiscard]] Wrench total(const RigidState& state, const Wrench& flow) const;
  [[nodiscard]] const Wrench& wrench_before(const Wrench& flow) const { return started_ ? accepted_flow_ : flow; }

  RigidBodyProperties properties_;
  RigidState accepted_;
  Wrench accepted_flow_;  ///< the flow's
  bool started_ = false;  ///< the flow's force at t_n is known
};

}  // namespace luff::simulation
