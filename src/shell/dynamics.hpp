// SPDX-License-Identifier: BSD-3-Clause
// Motion of a shell in time: Newmark's average acceleration (beta = 1/4, gamma = 1/2).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "shell/folds.hpp"
#include "shell/loads.hpp"
#include "shell/newton.hpp"
#include "shell/shell.hpp"

namespace luff::shell {

/// Positions, velocities, accelerations of all vertices (3n each) at time t.
struct State {
  Eigen::VectorXd x;  ///< [L]
  Eigen::VectorXd v;  ///< [L/T]
  Eigen::VectorXd a;  ///< [L/T^2]
  double t = 0;
};

/// Velocity and acceleration that Newmark's rule gives to new positions.
struct Kinematics {
  Eigen::VectorXd v;
  Eigen::VectorXd a;
};

/// Where the energy is and what went in and out since the start [M L^2/T^2];
/// kinetic + elastic + damping_work - external_work stays constant but for the time integration's error.
struct EnergyLedger {
  double kinetic = 0;
  double elastic = 0;
  double damping_work = 0;
  double external_work = 0;
};

struct DynamicsOptions {
  NewtonPolicy newton;
  double fold_limit = 75;  ///< a step that folds the shell by more over an edge is refused [degrees]
  LinearSolverKind linear_solver = LinearSolverKind::Direct;
};

/// Where the tangent in use was taken, so that a restart can take it again.
struct Linearisation {
  Eigen::VectorXd x;         ///< of the stiffness; empty: none, the next solve() takes a new one
  Eigen::VectorXd x_frozen;  ///< of the damping
  double t = 0;
  double dt = 0;
};

/// All that the next step depends on; restoring it gives the same bits as going on.
struct Checkpoint {
  State state;
  EnergyLedger ledger;
  Eigen::VectorXd fluid_forces;
  Linearisation linearisation;
  int step = 0;
};

/// Solves M a + D v + f_int(x) = f_ext(x, t) + f_fluid step by step, with Rayleigh damping D = f_m M + f_k K_mat(x_n)
/// frozen in the step. Newmark [newmark_1959_method]:
///
///   a = 4/dt^2 (x - x_n - dt v_n) - a_n,   v = v_n + dt/2 (a_n + a).
///
/// solve() only computes; the accepted state changes in accept() alone, so a step can be repeated with other fluid
/// forces. The factorised tangent is kept, across steps too, for as long as it converges fast: a repeated solve() costs
/// a few evaluations of the force. What it converges to doesn't depend on the tangent but for the last digits.
class Dynamics {
 public:
  struct Trial {
    Eigen::VectorXd positions;
    NewtonReport report;
  };

  /// Start at rest in the reference configuration, or with velocity v0; the acceleration follows from equilibrium.
  /// Keeps a reference to the shell. \throws InputError when the density is zero.
  Dynamics(const Shell& shell, const std::vector<Load>& loads, DynamicsOptions options = {}, double t0 = 0,
           const Eigen::VectorXd& v0 = {});

  const Shell& shell() const { return shell_; }
  const State& accepted() const { return state_; }
  const EnergyLedger& ledger() const { return ledger_; }
  int step() const { return step_; }

  Checkpoint checkpoint() const;
  /// Go on from a checkpoint of the same shell, loads and options.
  void restore(const Checkpoint& checkpoint);

  /// Second-order extrapolation x + dt v + dt^2/2 a, held displacements kept.
  Eigen::VectorXd predicted_positions(double dt) const;
  Kinematics kinematics(const Eigen::VectorXd& positions, double dt) const;

  /// Positions at t_new = t + dt in equilibrium with the fluid's nodal forces (3n), starting Newton from `guess`.
  /// \throws RunError naming the step, time and place when there is no equilibrium.
  Trial solve(double t_new, double dt, const Eigen::VectorXd& fluid_forces, const Eigen::VectorXd& guess);

  /// Make positions, with Newmark's velocity and acceleration, the accepted state.
  /// \throws RunError naming the place when the shell folds by more than the limit over an edge; the state is
  /// unchanged.
  Folds accept(const Eigen::VectorXd& positions, double t_new, double dt, const Eigen::VectorXd& fluid_forces);

 private:
  Eigen::VectorXd consistent_acceleration() const;
  Eigen::VectorXd damping_force(const Eigen::VectorXd& v) const;
  void freeze_damping(const Eigen::VectorXd& x);
  void assemble_tangent(const Eigen::VectorXd& x, const LoadsAtTime& loads, double dt, BlockMatrix& K) const;
  std::string when(double t_new) const;

  const Shell& shell_;
  Loads loads_;
  DynamicsOptions options_;
  State state_;
  EnergyLedger ledger_;
  Eigen::VectorXd prescribed_forces_;  ///< of the accepted state
  Eigen::VectorXd fluid_forces_;       ///< of the accepted state
  BlockMatrix damping_;
  KeptTangent tangent_;
  Linearisation linearisation_;
  bool slow_ = false;  ///< a solve since the last accept took many iterations
  int step_ = 0;
};

}  // namespace luff::shell
