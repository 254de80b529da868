// SPDX-License-Identifier: BSD-3-Clause
// Motion of a shell in time.
#include "shell/dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
  state_.t = t0;
  start(v0);
}

/// Velocity v0 or rest but for the supports, and the acceleration that balances the forces.
void Dynamics::start(const Eigen::VectorXd& v0)
{
  const Eigen::VectorXd& X = shell_.reference_positions();
  ensure(v0.size() == 0 || v0.size() == X.size(), "an initial velocity has three numbers per vertex");
  ensure(!shell_.supports().moves() || options_.first_step > 0, "moving supports need the length of the first step");
  Eigen::VectorXd x = X;
  shell_.supports().place(X, state_.t, 1, x);
  constexpr double round_off = 1e-9;
  if ((x - X).lpNorm<Eigen::Infinity>() > round_off * shell_.size())
    fail_input("shell '{}': the motion of a support starts {:.3g} away from where the mesh is; let it start from zero",
               shell_.name(), (x - X).lpNorm<Eigen::Infinity>());
  const Held::HeldRates held = shell_.supports().rates(X, state_.t, state_.t, options_.first_step);
  state_.v = v0.size() > 0 ? v0 : Eigen::VectorXd::Zero(X.size());
  shell_.clear_held(state_.v);
  state_.v += held.velocity;
  freeze_damping(state_.x, state_.t);
  prescribed_forces_ = loads_.at(state_.t).force(state_.x);
  fluid_forces_ = Eigen::VectorXd::Zero(X.size());
  state_.a = consistent_acceleration(held.acceleration);
  support_forces_ = support_forces();
  ledger_.kinetic = 0.5 * state_.v.dot(shell_.mass_times(state_.v));
  ledger_.elastic = shell_.elastic_energy(state_.x, shell_.images_at(state_.x, state_.t));
  if (options_.contact)
    contact_ = std::make_unique<ContactStep>(shell_, *options_.contact, options_.linear_solver, state_.x, state_.t);
}

Checkpoint Dynamics::checkpoint() const
{
  return {state_, ledger_, fluid_forces_, tangent_.valid ? linearisation_ : Linearisation{}, step_, borrowed_mass_};
}

void Dynamics::restore(const Checkpoint& checkpoint)
{
  state_ = checkpoint.state;
  solution_ = {};
  ledger_ = checkpoint.ledger;
  fluid_forces_ = checkpoint.fluid_forces;
  linearisation_ = checkpoint.linearisation;
  step_ = checkpoint.step;
  borrowed_mass_ = checkpoint.borrowed_mass;
  slow_ = false;
  prescribed_forces_ = loads_.at(state_.t).force(state_.x);
  tangent_.valid = linearisation_.x.size() > 0;
  if (tangent_.valid) {
    const Linearisation& at = linearisation_;
    freeze_damping(at.x_frozen, at.t_frozen);
    tangent_.K.set_zero();
    assemble_tangent(at.x, shell_.images_at(at.x, at.t), loads_.at(at.t), at.dt, tangent_.K);
    shell_.supports().decouple(tangent_.K);
    tangent_.solver->factorise(tangent_.K);
  }
  freeze_damping(state_.x, state_.t);
  support_forces_ = support_forces();
  if (contact_)
    contact_->restore(state_.x, state_.t);
}

void Dynamics::borrow_mass(double ratio)
{
  ensure(ratio >= 0, "a borrowed mass is not negative");
  borrowed_mass_ = ratio;
  tangent_.valid = false;
}

/// M a = f_ext - f_int - D v on the free displacements, with the held ones given.
Eigen::VectorXd Dynamics::consistent_acceleration(const Eigen::VectorXd& held) const
{
  BlockMatrix mass = shell_.mass_matrix();
  shell_.supports().decouple(mass);
  const auto solver = make_linear_solver(LinearSolverKind::Direct, mass.pattern(), shell_.held());
  solver->factorise(mass);
  Eigen::VectorXd r =
      -out_of_balance(state_.x, shell_.images_at(state_.x, state_.t), {state_.v, held}, prescribed_forces_);
  shell_.clear_held(r);
  return held + solver->solve(r);
}

void Dynamics::freeze_damping(const Eigen::VectorXd& x, double t)
{
  if (!shell_.is_damped())
    return;
  damping_.set_zero();
  shell_.add_damping(x, shell_.images_at(x, t), damping_);
}

/// D v with D = f_m M + f_k K_mat(x_n).
Eigen::VectorXd Dynamics::damping_force(const Eigen::VectorXd& v) const
{
  if (!shell_.is_damped())
    return Eigen::VectorXd::Zero(v.size());
  return damping_ * v;
}

/// M a + D v + f_int(x) - f
Eigen::VectorXd Dynamics::out_of_balance(const Eigen::VectorXd& x, const Images& images, const Kinematics& k,
                                         const Eigen::VectorXd& forces) const
{
  return shell_.mass_times(k.a) + damping_force(k.v) + shell_.internal_force(x, images) - forces;
}

Eigen::VectorXd Dynamics::predicted_positions(double dt) const
{
  Eigen::VectorXd x = state_.x + dt * state_.v + 0.5 * dt * dt * state_.a;
  shell_.supports().place(shell_.reference_positions(), state_.t + dt, 1, x);
  return x;
}

Kinematics Dynamics::kinematics(const Eigen::VectorXd& positions, double dt) const
{
  return kinematics(positions, dt, held_rates(dt));
}

Held::HeldRates Dynamics::held_rates(double dt) const
{
  return shell_.supports().rates(shell_.reference_positions(), state_.t + dt,
                                 options_.scheme.acceleration_time(state_.t, dt), dt);
}

Kinematics Dynamics::kinematics(const Eigen::VectorXd& positions, double dt, const Held::HeldRates& held) const
{
  Eigen::VectorXd moved = positions - state_.x;
  if (solution_.positions.size() > 0 && positions == solution_.positions)
    moved += solution_.rounding;
  Kinematics k = options_.scheme.kinematics(state_, moved, dt);
  shell_.clear_held(k.a);
  shell_.clear_held(k.v);
  k.a += held.acceleration;
  k.v += held.velocity;
  return k;
}

/// (1 - alpha_f) (K - d f_ext/dx) + (1 + borrowed) (1 - alpha_m)/(beta dt^2) M + (1 - alpha_f) gamma/(beta dt) D
void Dynamics::assemble_tangent(const Eigen::VectorXd& x, const Images& images, const LoadsAtTime& loads, double dt,
                                BlockMatrix& K) const
{
  const TimeScheme& scheme = options_.scheme;
  shell_.add_tangent(x, images, K);
  loads.subtract_stiffness(x, 1, K);
  if (scheme.position_slope() != 1)
    K.scale(scheme.position_slope());
  shell_.add_mass((1 + borrowed_mass_) * scheme.acceleration_slope(dt), K);
  if (shell_.is_damped())
    K.add(scheme.velocity_slope(dt), damping_);
}

/// Where forces are evaluated when the step ends at x_new.
Eigen::VectorXd Dynamics::configuration(const Eigen::VectorXd& x_new) const
{
  return options_.scheme.balanced(state_.x, x_new);
}

Dynamics::StepTerms Dynamics::step_terms(double t_new, double dt, const Eigen::VectorXd& fluid_forces,
                                         const Eigen::VectorXd& placed) const
{
  const TimeScheme& scheme = options_.scheme;
  const double t = scheme.balanced(state_.t, t_new);
  return {.loads = loads_.at(t),
          .images = shell_.images_at(configuration(placed), t),
          .fluid = scheme.balanced(fluid_forces_, fluid_forces),
          .held = held_rates(dt),
          .guess = placed,
          .t = t,
          .dt = dt};
}

/// Of the borrowed mass, for the way from the guess.
Eigen::VectorXd Dynamics::borrowed_inertia(const StepTerms& terms, const Eigen::VectorXd& x_new) const
{
  if (borrowed_mass_ == 0)
    return Eigen::VectorXd::Zero(x_new.size());
  return borrowed_mass_ * options_.scheme.acceleration_slope(terms.dt) * shell_.mass_times(x_new - terms.guess);
}

/// Contact adds its force at the end of the step, whatever the scheme; for the rest to have a potential of the new
/// positions, the elastic energy is that of the configuration over the slope of the configuration in them.
SmoothBalance Dynamics::smooth_balance(const StepTerms& terms) const
{
  const TimeScheme& scheme = options_.scheme;
  SmoothBalance balance;
  balance.elastic_energy = [&](const Eigen::VectorXd& x_new) {
    return shell_.elastic_energy(configuration(x_new), terms.images) / scheme.position_slope();
  };
  balance.elastic_force = [&](const Eigen::VectorXd& x_new) {
    return shell_.internal_force(configuration(x_new), terms.images);
  };
  balance.other_forces = [&](const Eigen::VectorXd& x_new) -> Eigen::VectorXd {
    const Kinematics k = scheme.balanced(state_, kinematics(x_new, terms.dt, terms.held));
    return terms.loads.force(configuration(x_new)) + terms.fluid - shell_.mass_times(k.a) - damping_force(k.v) -
           borrowed_inertia(terms, x_new);
  };
  balance.tangent = [&](const Eigen::VectorXd& x_new, BlockMatrix& K) {
    assemble_tangent(configuration(x_new), terms.images, terms.loads, terms.dt, K);
  };
  balance.add_resistance = [&](double part, BlockMatrix& K) {
    shell_.add_mass(part * scheme.acceleration_slope(terms.dt), K);
  };
  Eigen::VectorXd applied = terms.loads.force(state_.x) + terms.fluid;
  shell_.clear_held(applied);
  balance.force_scale = std::max(applied.norm(), shell_.mass_times(state_.a).norm());
  balance.energy = ledger_.kinetic + ledger_.elastic;
  return balance;
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
  Trial trial{guess, {}};
  shell_.supports().place(shell_.reference_positions(), t_new, 1, trial.positions);
  const StepTerms terms = step_terms(t_new, dt, fluid_forces, trial.positions);
  if (contact_) {
    const ContactNewton::Result result = contact_->solve(smooth_balance(terms), trial.positions, t_new, when(t_new));
    return {result.positions, result.report};
  }
  const Equilibrium equilibrium{
      .residual = [&](const Eigen::VectorXd& x_new) -> Eigen::VectorXd {
        const Kinematics k = kinematics(x_new, dt, terms.held);
        const Eigen::VectorXd x = configuration(x_new);
        return -out_of_balance(x, terms.images, options_.scheme.balanced(state_, k),
                               terms.loads.force(x) + terms.fluid - borrowed_inertia(terms, x_new));
      },
      .tangent =
          [&](const Eigen::VectorXd& x_new, BlockMatrix& K) {
            linearisation_ = {configuration(x_new), state_.x, terms.t, state_.t, dt};
            assemble_tangent(linearisation_.x, terms.images, terms.loads, dt, K);
          },
  };
  trial.report = newton(shell_, equilibrium, options_.newton, tangent_, trial.positions, when(t_new));
  solution_ = {trial.positions, trial.report.rounding};
  // From here on a new tangent is cheaper than more iterations with the old one.
  constexpr int many = 6;
  slow_ = slow_ || trial.report.iterations > many;
  return trial;
}

Folds Dynamics::accept(const Eigen::VectorXd& positions, double t_new, double dt, const Eigen::VectorXd& fluid_forces)
{
  const Folds report = check_folds(shell_, positions, options_.fold_limit, when(t_new), t_new);
  const Kinematics k = kinematics(positions, dt);
  const State before = std::exchange(state_, {positions, k.v, k.a, t_new});
  solution_ = {};
  book_work(before, fluid_forces);
  ++step_;
  if (slow_)
    tangent_.valid = false;
  slow_ = false;
  return report;
}

/// Work of the step that led to the accepted state: of the mean of the forces at its ends, or of those at the midpoint
/// where the scheme strikes its balance there.
void Dynamics::book_work(const State& before, const Eigen::VectorXd& fluid_forces)
{
  const bool at_midpoint = options_.scheme.works_at_midpoint();
  const Eigen::VectorXd moved = state_.x - before.x;
  const Eigen::VectorXd x = 0.5 * (before.x + state_.x), fluid = 0.5 * (fluid_forces_ + fluid_forces);
  const double t = 0.5 * (before.t + state_.t);
  const Eigen::VectorXd prescribed = loads_.at(state_.t).force(state_.x);
  const Eigen::VectorXd mean_prescribed =
      at_midpoint ? loads_.at(t).force(x) : Eigen::VectorXd(0.5 * (prescribed_forces_ + prescribed));
  ledger_.external_work += moved.dot(mean_prescribed + fluid);
  ledger_.fluid_work += moved.dot(fluid);
  ledger_.damping_work += moved.dot(damping_force(0.5 * (before.v + state_.v)));
  ledger_.kinetic = 0.5 * state_.v.dot(shell_.mass_times(state_.v));
  ledger_.elastic = shell_.elastic_energy(state_.x, shell_.images_at(state_.x, state_.t));
  if (contact_) {
    ledger_.external_work += contact_->accept(state_.x, state_.t);
    ledger_.contact = contact_->energy();
  }
  prescribed_forces_ = prescribed;
  fluid_forces_ = fluid_forces;
  Eigen::VectorXd support_forces_at_midpoint;
  if (at_midpoint && shell_.supports().moves())
    support_forces_at_midpoint =
        support_forces(x, t, options_.scheme.balanced(before, {state_.v, state_.a}), mean_prescribed + fluid);
  freeze_damping(state_.x, state_.t);
  if (shell_.supports().moves())
    book_support_work(before, support_forces_at_midpoint);
}

/// With the forces at the midpoint where they are given, else with the mean of those at both ends.
void Dynamics::book_support_work(const State& before, const Eigen::VectorXd& at_midpoint)
{
  const Eigen::VectorXd forces_before = std::exchange(support_forces_, support_forces());
  const Eigen::VectorXd forces =
      at_midpoint.size() > 0 ? at_midpoint : Eigen::VectorXd(0.5 * (forces_before + support_forces_));
  ledger_.support_work +=
      (state_.x - before.x).dot(forces) +
      shell_.image_work(before.x, shell_.images_at(before.x, before.t), state_.x, shell_.images_at(state_.x, state_.t));
}

/// Forces of the supports: what is out of balance where they hold.
Eigen::VectorXd Dynamics::support_forces(const Eigen::VectorXd& x, double t, const Kinematics& k,
                                         const Eigen::VectorXd& forces) const
{
  const Eigen::VectorXd all = out_of_balance(x, shell_.images_at(x, t), k, forces);
  Eigen::VectorXd unheld = all;
  shell_.clear_held(unheld);
  return all - unheld;
}

/// Of the accepted state; none where no support moves.
Eigen::VectorXd Dynamics::support_forces() const
{
  if (!shell_.supports().moves())
    return {};
  return support_forces(state_.x, state_.t, {state_.v, state_.a}, prescribed_forces_ + fluid_forces_);
}

std::string Dynamics::when(double t_new) const
{
  return fmt::format("step {}, t = {:.6g}", step_ + 1, t_new);
}

}  // namespace luff::shell
