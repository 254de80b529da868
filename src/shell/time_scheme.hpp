// SPDX-License-Identifier: BSD-3-Clause
// Schemes that march M a + D v + f(x, t) = 0 in time: where a step is in balance and how rates follow from positions.
#pragma once

#include <Eigen/Core>

namespace luff::shell {

/// Positions, velocities, accelerations of all vertices (3n each) at time t.
struct State {
  Eigen::VectorXd x;  ///< [L]
  Eigen::VectorXd v;  ///< [L/T]
  Eigen::VectorXd a;  ///< [L/T^2]; the mean of the last step with the implicit midpoint rule
  double t = 0;
};

/// Velocity and acceleration that a scheme gives to new positions.
struct Kinematics {
  Eigen::VectorXd v;
  Eigen::VectorXd a;
};

/// One family of one-step schemes with four numbers. Rates follow from new positions by Newmark's relations,
///
///   x = x_n + dt v_n + dt^2 ((1/2 - beta) a_n + beta a),   v = v_n + dt ((1 - gamma) a_n + gamma a),
///
/// and the step is in balance with M a at (1 - alpha_m) a + alpha_m a_n, all else at the average configuration
/// (1 - alpha_f) x + alpha_f x_n and velocity, and at the time t_n + (1 - alpha_f) dt.
class TimeScheme {
 public:
  /// [newmark_1959_method] beta = (1 + damping)^2/4, gamma = 1/2 + damping; damping >= 0 acts on all frequencies and
  /// makes the scheme first order, zero is the average acceleration: second order, no numerical damping.
  static TimeScheme newmark(double damping = 0);
  /// [chung_1993_time] second order, damps frequencies that the steps don't resolve by rho_inf per step, 0 to 1.
  static TimeScheme generalised_alpha(double rho_inf);
  /// M (v - v_n)/dt + ... = 0 at the midpoint with (v + v_n)/2 = (x - x_n)/dt: second order, keeps linear and angular
  /// momentum exactly. The acceleration of the state is the mean of the step.
  static TimeScheme midpoint();

  /// Rates that follow from what the step moved, x - x_n.
  Kinematics kinematics(const State& before, const Eigen::VectorXd& moved, double dt) const;
  /// Time at which the motion has the acceleration of the new state: the end of the step, or its middle.
  double acceleration_time(double t_before, double dt) const { return t_before + acceleration_at_ * dt; }
  /// Value at the point of balance of something that is `before` at the start of the step and `after` at its end.
  template <class Value>
  Value balanced(const Value& before, const Value& after) const
  {
    return alpha_f_ == 0 ? after : Value((1 - alpha_f_) * after + alpha_f_ * before);
  }
  /// Rates at the point of balance.
  Kinematics balanced(const State& before, const Kinematics& after) const;
  /// Derivatives of what is balanced in the new positions, as multiples of the identity.
  double position_slope() const { return 1 - alpha_f_; }
  double velocity_slope(double dt) const { return (1 - alpha_f_) * gamma_ / (beta_ * dt); }
  double acceleration_slope(double dt) const { return (1 - alpha_m_) / (beta_ * dt * dt); }
  double alpha_m() const { return alpha_m_; }
  double alpha_f() const { return alpha_f_; }
  double gamma() const { return gamma_; }
  /// Balance is struck in the middle of the step, where the work of its forces is exactly theirs times the step.
  bool works_at_midpoint() const { return alpha_f_ == 0.5; }

 private:
  TimeScheme(double alpha_m, double alpha_f, double beta, double gamma, double acceleration_at = 1)
      : alpha_m_(alpha_m), alpha_f_(alpha_f), beta_(beta), gamma_(gamma), acceleration_at_(acceleration_at)
  {
  }

  double alpha_m_, alpha_f_, beta_, gamma_;
  double acceleration_at_;  ///< part of the step after which the motion has the acceleration of the new state
};

}  // namespace luff::shell
