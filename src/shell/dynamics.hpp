// SPDX-License-Identifier: BSD-3-Clause
// Motion of a shell in time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "shell/contact/contact_step.hpp"
#include "shell/folds.hpp"
#include "shell/loads.hpp"
#include "shell/newton.hpp"
#include "shell/shell.hpp"
#include "shell/time_scheme.hpp"

namespace luff::shell {

/// Where the energy is and what went in and out since the start [M L^2/T^2];
/// kinetic + elastic + contact + damping_work - external_work - support_work stays constant but for the time
/// integration's error.
struct EnergyLedger {
  double kinetic = 0;
  double elastic = 0;  ///< with that of elastic supports
  double contact = 0;  ///< of the barriers between surfaces that come close
  double damping_work = 0;
  double external_work = 0;
  double fluid_work = 0;    ///< part of it: of the forces given to solve()
  double support_work = 0;  ///< done by supports that move
};

struct DynamicsOptions {
  TimeScheme scheme = TimeScheme::newmark();
  std::optional<ContactOptions> contact{};
  NewtonPolicy newton{};
  double fold_limit = 75;  ///< a step that folds the shell by more over an edge is refused [degrees]
  LinearSolverKind linear_solver = LinearSolverKind::Direct;
  double first_step = 0;  ///< length of it, for the rates of moving supports at the start; else not used
};

/// Where the tangent in use was taken, so that a restart can take it again.
struct Linearisation {
  Eigen::VectorXd x;         ///< of the stiffness; empty: none, the next solve() takes a new one
  Eigen::VectorXd x_frozen;  ///< of the damping
  double t = 0;              ///< of the loads
  double t_frozen = 0;
  double dt = 0;
};

/// All that the next step depends on; restoring it gives the same bits as going on.
struct Checkpoint {
  State state;
  EnergyLedger ledger;
  Eigen::VectorXd fluid_forces;
  Linearisation linearisation;
  int step = 0;
  double borrowed_mass = 0;
};

/// Solves M a + D v + f_int(x) = f_ext(x, t) + f_fluid step by step, with Rayleigh damping D = f_m M + f_k K_mat(x_n)
/// frozen in the step, by a TimeScheme. What supports hold follows their motion: positions, and rates by differences in
/// time, so that an average acceleration does not make them ring.
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
  /// Keeps a reference to the shell. \throws InputError when the density is zero or a support is elsewhere at t0.
  Dynamics(const Shell& shell, const std::vector<Load>& loads, DynamicsOptions options = {}, double t0 = 0,
           const Eigen::VectorXd& v0 = {});

  const Shell& shell() const { return shell_; }
  const State& accepted() const { return state_; }
  const EnergyLedger& ledger() const { return ledger_; }
  /// Contact in the accepted state; null without it.
  const ContactStep* contact() const { return contact_.get(); }
  int step() const { return step_; }

  Checkpoint checkpoint() const;
  /// Go on from a checkpoint of the same shell, loads and options.
  void restore(const Checkpoint& checkpoint);

  /// From now on solve() resists being moved away from its guess as if the shell were `ratio` times its mass heavier,
  ///
  ///   M a + ... + ratio (1 - alpha_m)/(beta dt^2) M (x - x_guess) = f_fluid:
  ///
  /// nothing where a coupling iteration has come to rest, x = x_guess, and before that a bound on how far the forces of
  /// a fluid that is much heavier throw the shell.
  void borrow_mass(double ratio);
  const TimeScheme& scheme() const { return options_.scheme; }

  /// Second-order extrapolation x + dt v + dt^2/2 a, with what supports hold in its place.
  Eigen::VectorXd predicted_positions(double dt) const;
  /// Rates at t + dt that the scheme gives to new positions, those of the supports where they hold. For what solve()
  /// gave last they balance the forces to more digits than the positions have.
  Kinematics kinematics(const Eigen::VectorXd& positions, double dt) const;

  /// Positions at t_new = t + dt in balance with the fluid's nodal forces (3n) at t_new, starting Newton from `guess`.
  /// \throws RunError naming the step, time and place when there is no equilibrium.
  Trial solve(double t_new, double dt, const Eigen::VectorXd& fluid_forces, const Eigen::VectorXd& guess);

  /// Make positions, with the scheme's velocity and acceleration, the accepted state.
  /// \throws RunError naming the place when the shell folds by more than the limit over an edge; the state is
  /// unchanged.
  Folds accept(const Eigen::VectorXd& positions, double t_new, double dt, const Eigen::VectorXd& fluid_forces);

 private:
  /// What the balance of one step is made of, besides the new positions.
  struct StepTerms {
    LoadsAtTime loads;
    Images images;
    Eigen::VectorXd fluid;
    Held::HeldRates held;
    Eigen::VectorXd guess;
    double t;  ///< of the balance
    double dt;
  };

  /// Of the last solve() since the accepted state, with the digits that positions far from the origin have no place
  /// for: rates are differences over a short step, and without these digits they would not balance.
  struct Solution {
    Eigen::VectorXd positions;
    Eigen::VectorXd rounding;
  };

  void start(const Eigen::VectorXd& v0);
  Eigen::VectorXd consistent_acceleration(const Eigen::VectorXd& held) const;
  Eigen::VectorXd damping_force(const Eigen::VectorXd& v) const;
  void freeze_damping(const Eigen::VectorXd& x, double t);
  Held::HeldRates held_rates(double dt) const;
  Kinematics kinematics(const Eigen::VectorXd& positions, double dt, const Held::HeldRates& held) const;
  void assemble_tangent(const Eigen::VectorXd& x, const Images& images, const LoadsAtTime& loads, double dt,
                        BlockMatrix& K) const;
  Eigen::VectorXd borrowed_inertia(const StepTerms& terms, const Eigen::VectorXd& x_new) const;
  Eigen::VectorXd out_of_balance(const Eigen::VectorXd& x, const Images& images, const Kinematics& k,
                                 const Eigen::VectorXd& forces) const;
  Eigen::VectorXd support_forces(const Eigen::VectorXd& x, double t, const Kinematics& k,
                                 const Eigen::VectorXd& forces) const;
  Eigen::VectorXd configuration(const Eigen::VectorXd& x_new) const;
  StepTerms step_terms(double t_new, double dt, const Eigen::VectorXd& fluid_forces,
                       const Eigen::VectorXd& placed) const;
  SmoothBalance smooth_balance(const StepTerms& terms) const;
  Eigen::VectorXd support_forces() const;
  void book_support_work(const State& before, const Eigen::VectorXd& at_midpoint);
  void book_work(const State& before, const Eigen::VectorXd& fluid_forces);
  std::string when(double t_new) const;

  const Shell& shell_;
  Loads loads_;
  DynamicsOptions options_;
  State state_;
  EnergyLedger ledger_;
  Eigen::VectorXd prescribed_forces_;  ///< of the accepted state
  Eigen::VectorXd fluid_forces_;       ///< of the accepted state
  Eigen::VectorXd support_forces_;     ///< of the accepted state, where a support moves
  BlockMatrix damping_;
  KeptTangent tangent_;
  Linearisation linearisation_;
  Solution solution_;
  std::unique_ptr<ContactStep> contact_;  ///< null: none
  double borrowed_mass_ = 0;              ///< in parts of the shell's own
  bool slow_ = false;                     ///< a solve since the last accept took many iterations
  int step_ = 0;
};

}  // namespace luff::shell
