// SPDX-License-Identifier: BSD-3-Clause
// Motion of a shell in time.
#include "shell/dynamics.hpp"

#include <cmath>

#include "core/error.hpp"

namespace luff::shell {

Dynamics::Dynamics(const Shell& shell, const std::vector<Load>& loads, DynamicsOptions options, double t0,
                   const Eigen::VectorXd& v0)
    : shell_(shell),
      loads_(shell, loads),
      options_(options),
      damping_(shell.pattern()),
      tangent_(shell, options.linear_solver)
{
  for (const PieceRange& piece : shell_.pieces())
    if (!(piece.properties.density > 0))
      fail_input("shell '{}': density = {} must be greater than 0 to move in time", piece.name,
                 piece.properties.density);
  state_.x = shell_.reference_positions();
  state_.v = v0.size() > 0 ? v0 : Eigen::VectorXd::Zero(state_.x.size());
  ensure(state_.v.size() == state_.x.size(), "an initial velocity has three numbers per vertex");
  shell_.clear_held(state_.v);
  state_.t = t0;
  freeze_damping(state_.x);
  prescribed_forces_ = loads_.at(t0).force(state_.x);
  fluid_forces_ = Eigen::VectorXd::Zero(state_.x.size());
  state_.a = consistent_acceleration();
  ledger_.kinetic = 0.5 * state_.v.dot(shell_.mass_times(state_.v));
  ledger_.elastic = shell_.elastic_energy(state_.x);
}

Checkpoint Dynamics::checkpoint() const
{
  return {state_, ledger_, fluid_forces_, tangent_.valid ? linearisation_ : Linearisation{}, step_};
}

void Dynamics::restore(const Checkpoint& checkpoint)
{
  state_ = checkpoint.state;
  ledger_ = checkpoint.ledger;
  fluid_forces_ = checkpoint.fluid_forces;
  linearisation_ = checkpoint.linearisation;
  step_ = checkpoint.step;
  slow_ = false;
  prescribed_forces_ = loads_.at(state_.t).force(state_.x);
  tangent_.valid = linearisation_.x.size() > 0;
  if (tangent_.valid) {
    freeze_damping(linearisation_.x_frozen);
    tangent_.K.set_zero();
    assemble_tangent(linearisation_.x, loads_.at(linearisation_.t), linearisation_.dt, tangent_.K);
    tangent_.solver->factorise(tangent_.K);
  }
  freeze_damping(state_.x);
}

/// M a = f_ext - f_int - D v on the free displacements.
Eigen::VectorXd Dynamics::consistent_acceleration() const
{
  const BlockMatrix mass = shell_.mass_matrix();
  const auto solver = make_linear_solver(LinearSolverKind::Direct, mass.pattern(), shell_.held());
  solver->factorise(mass);
  return solver->solve(prescribed_forces_ - shell_.internal_force(state_.x) - damping_force(state_.v));
}

void Dynamics::freeze_damping(const Eigen::VectorXd& x)
{
  if (!shell_.is_damped())
    return;
  damping_.set_zero();
  shell_.add_damping(x, damping_);
}

/// D v with D = f_m M + f_k K_mat(x_n).
Eigen::VectorXd Dynamics::damping_force(const Eigen::VectorXd& v) const
{
  if (!shell_.is_damped())
    return Eigen::VectorXd::Zero(v.size());
  return damping_ * v;
}

Eigen::VectorXd Dynamics::predicted_positions(double dt) const
{
  Eigen::VectorXd step = dt * state_.v + 0.5 * dt * dt * state_.a;
  shell_.clear_held(step);
  return state_.x + step;
}

Kinematics Dynamics::kinematics(const Eigen::VectorXd& positions, double dt) const
{
  Kinematics k;
  k.a = 4 / (dt * dt) * (positions - state_.x - dt * state_.v) - state_.a;
  k.v = state_.v + 0.5 * dt * (state_.a + k.a);
  shell_.clear_held(k.a);
  shell_.clear_held(k.v);
  return k;
}

/// K + 4/dt^2 M + 2/dt D - d f_ext/dx
void Dynamics::assemble_tangent(const Eigen::VectorXd& x, const LoadsAtTime& loads, double dt, BlockMatrix& K) const
{
  shell_.add_tangent(x, K);
  shell_.add_mass(4 / (dt * dt), K);
  if (shell_.is_damped())
    K.add(2 / dt, damping_);
  loads.subtract_stiffness(x, 1, K);
}

Dynamics::Trial Dynamics::solve(double t_new, double dt, const Eigen::VectorXd& fluid_forces,
                                const Eigen::VectorXd& guess)
{
  ensure(dt > 0 && fluid_forces.size() == state_.x.size() && guess.size() == state_.x.size(),
         "a step needs dt > 0 and three numbers per vertex");
  // The inertia in the tangent goes with 1/dt^2: beyond this change it would slow Newton's method down.
  constexpr double largest_change = 0.05;
  if (std::abs(dt - linearisation_.dt) > largest_change * dt)
    tangent_.valid = false;
  const LoadsAtTime loads = loads_.at(t_new);
  const Equilibrium equilibrium{
      .residual = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        const Kinematics k = kinematics(x, dt);
        return loads.force(x) + fluid_forces - shell_.internal_force(x) - shell_.mass_times(k.a) - damping_force(k.v);
      },
      .tangent =
          [&](const Eigen::VectorXd& x, BlockMatrix& K) {
            assemble_tangent(x, loads, dt, K);
            linearisation_ = {x, state_.x, t_new, dt};
          },
  };
  Eigen::VectorXd offset = guess - state_.x;
  shell_.clear_held(offset);
  Trial trial{state_.x + offset, {}};
  trial.report = newton(shell_, equilibrium, options_.newton, tangent_, trial.positions, when(t_new));
  // From here on a new tangent is cheaper than more iterations with the old one.
  constexpr int many = 6;
  slow_ = slow_ || trial.report.iterations > many;
  return trial;
}

Folds Dynamics::accept(const Eigen::VectorXd& positions, double t_new, double dt, const Eigen::VectorXd& fluid_forces)
{
  const Folds report = check_folds(shell_, positions, options_.fold_limit, when(t_new));
  const Kinematics k = kinematics(positions, dt);
  const Eigen::VectorXd prescribed = loads_.at(t_new).force(positions);
  const Eigen::VectorXd moved = positions - state_.x;
  ledger_.external_work += 0.5 * moved.dot(prescribed_forces_ + fluid_forces_ + prescribed + fluid_forces);
  ledger_.damping_work += 0.5 * moved.dot(damping_force(state_.v + k.v));
  ledger_.kinetic = 0.5 * k.v.dot(shell_.mass_times(k.v));
  ledger_.elastic = shell_.elastic_energy(positions);
  state_ = {positions, k.v, k.a, t_new};
  prescribed_forces_ = prescribed;
  fluid_forces_ = fluid_forces;
  ++step_;
  freeze_damping(state_.x);
  if (slow_)
    tangent_.valid = false;
  slow_ = false;
  return report;
}

std::string Dynamics::when(double t_new) const
{
  return fmt::format("step {}, t = {:.6g}", step_ + 1, t_new);
}

}  // namespace luff::shell
