// SPDX-License-Identifier: BSD-3-Clause
// Newton's method for the balance of a shell that may touch itself, others and rigid bodies.
#include "shell/contact/contact_newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"

namespace luff::shell {

namespace {

double largest_move(const Eigen::VectorXd& dz)
{
  double most = 0;
  for (Eigen::Index i = 0; i < dz.size(); i += 3)
    most = std::max(most, dz.segment<3>(i).norm());
  return most;
}

/// Factorise; a singular matrix counts as one with a negative pivot. Conjugate gradients find out later.
std::optional<int> negative_pivots(LinearSolver& solver, const BlockMatrix& K)
{
  try {
    return solver.factorise(K).negative_pivots;
  } catch (const RunError&) {
    return 1;
  }
}

std::vector<std::array<int, 4>> coupled_vertices(const Contact& contact)
{
  std::vector<std::array<int, 4>> groups;
  groups.reserve(contact.pairs().size());
  for (const ContactPair& pair : contact.pairs())
    groups.push_back(pair.vertex);
  return groups;
}

}  // namespace

ContactNewton::ContactNewton(const Shell& shell, Contact& contact, LinearSolverKind kind, ContactNewtonPolicy policy)
    : shell_(shell),
      contact_(contact),
      kind_(kind),
      policy_(policy),
      n_(shell.reference_positions().size()),
      longest_increment_(0.5 * contact.pieces().shortest_mean_edge()),
      smooth_(shell.pattern())
{
}

void ContactNewton::gather(const Eigen::VectorXd& z, double margin)
{
  contact_.gather(z, margin);
  centre_ = z;
  margin_ = margin;
  pattern_ = nullptr;
}

/// Pairs are gathered anew when a move would leave the region that they were gathered for.
void ContactNewton::cover(const Eigen::VectorXd& z, const Eigen::VectorXd& direction)
{
  if (largest_move(z + direction - centre_) <= margin_)
    return;
  gather(z, std::max(margin_, 1.5 * largest_move(direction)));
}

/// The guess, as far as is safe, unless it has much more energy than there was: a thin shell that was stretched by the
/// extrapolation is a worse start than the last step.
Eigen::VectorXd ContactNewton::approach(const SmoothBalance& balance, const Eigen::VectorXd& start,
                                        const Eigen::VectorXd& goal)
{
  constexpr double much = 2;
  const Eigen::VectorXd direction = goal - start;
  const double fraction = contact_.safe_fraction(start, direction);
  const Eigen::VectorXd reached = fraction == 1 ? goal : start + fraction * direction;
  const double energy = balance.elastic_energy(shell_part(reached)) + contact_.energy(reached);
  return energy <= much * (balance.energy + contact_.energy(start)) ? reached : start;
}

/// Of the shell's free displacements; `scale` is the largest of the forces that should balance.
Eigen::VectorXd ContactNewton::residual(const SmoothBalance& balance, const Eigen::VectorXd& z, double& scale) const
{
  Eigen::VectorXd contact = Eigen::VectorXd::Zero(z.size());
  contact_.add_gradient(z, contact);
  contact.conservativeResize(n_);
  Eigen::VectorXd elastic = balance.elastic_force(shell_part(z));
  shell_.clear_held(contact);
  shell_.clear_held(elastic);
  Eigen::VectorXd r = balance.other_forces(shell_part(z)) - elastic - contact;
  shell_.clear_held(r);
  scale = std::max({balance.force_scale, elastic.norm(), contact.norm()});
  return r;
}

/// Folds and buckling make the tangent indefinite; inertia of a shorter step, or viscosity, makes it positive again.
void ContactNewton::factorise_positive(const SmoothBalance& balance, NewtonReport& report)
{
  double resistance = 1;
  for (int shift = 0; shift <= policy_.most_shifts; ++shift) {
    ++report.factorisations;
    const std::optional<int> negative = negative_pivots(*solver_, *K_);
    if (shift == 0)
      report.negative_pivots = negative;
    if (negative.value_or(0) == 0)
      return;
    smooth_.set_zero();
    balance.add_resistance((policy_.shift_ratio - 1) * resistance, smooth_);
    shell_.supports().decouple(smooth_);
    K_->add(1, smooth_);
    resistance *= policy_.shift_ratio;
  }
  fail_run("no amount of inertia or viscosity makes the tangent positive definite");
}

Eigen::VectorXd ContactNewton::increment(const SmoothBalance& balance, const Eigen::VectorXd& z,
                                         const Eigen::VectorXd& r, NewtonReport& report)
{
  if (!pattern_) {
    pattern_ = std::make_shared<BlockPattern>(united(*shell_.pattern(), coupled_vertices(contact_)));
    K_ = std::make_unique<BlockMatrix>(pattern_);
    solver_ = make_linear_solver(kind_, *pattern_, shell_.held());
  }
  smooth_.set_zero();
  balance.tangent(shell_part(z), smooth_);
  K_->set_zero();
  K_->add(1, smooth_);
  contact_.add_stiffness(z, policy_.hessian, *K_);
  shell_.supports().decouple(*K_);
  factorise_positive(balance, report);
  Eigen::VectorXd dx = balance.skew ? solve_with_skew(*solver_, balance.skew(shell_part(z)), r) : solver_->solve(r);
  const double longest = largest_move(dx);
  report.increment = longest / shell_.size();
  report.increments.push_back(report.increment);
  if (longest > longest_increment_)
    dx *= longest_increment_ / longest;
  return dx;
}

/// The Newton step and, on top, what carries held displacements and rigid bodies to their places.
ContactNewton::Move ContactNewton::move_to(const Eigen::VectorXd& z, const Eigen::VectorXd& goal,
                                           const Eigen::VectorXd& dx) const
{
  Move move{goal - z, false};
  Eigen::VectorXd free = shell_part(move.direction);
  shell_.clear_held(free);
  move.direction.head(n_) -= free;
  move.carries = largest_move(move.direction) > policy_.round_off * shell_.size();
  move.direction.head(n_) += dx;
  return move;
}

/// Halves the move until Phi decreases by Armijo's part of what its slope promises.
double ContactNewton::decreasing_fraction(const SmoothBalance& balance, const Eigen::VectorXd& z,
                                          const Eigen::VectorXd& direction, const Eigen::VectorXd& r,
                                          double fraction) const
{
  constexpr int most_halvings = 12;
  constexpr double armijo = 1e-4, round_off = 1e-11;
  const Eigen::VectorXd x = shell_part(z), dx = shell_part(direction);
  const double slope = r.dot(dx);
  const double elastic = balance.elastic_energy(x), contact = contact_.energy(z);
  const Eigen::VectorXd forces = balance.other_forces(x);
  const double magnitude = std::abs(elastic) + contact + std::abs(forces.dot(dx));
  if (slope * fraction <= round_off * magnitude)
    return fraction;
  for (int n = 0; n < most_halvings; ++n, fraction *= 0.5) {
    const double work =
        fraction / 6 *
        dx.dot(forces + 4 * balance.other_forces(x + 0.5 * fraction * dx) + balance.other_forces(x + fraction * dx));
    const double change = balance.elastic_energy(x + fraction * dx) - elastic +
                          contact_.energy(z + fraction * direction) - contact - work;
    if (change <= -armijo * fraction * slope + round_off * magnitude)
      break;
  }
  return fraction;
}

ContactNewton::Result ContactNewton::solve(const SmoothBalance& balance, const Eigen::VectorXd& start,
                                           const Eigen::VectorXd& goal, const std::string& when)
{
  gather(start, std::max(0.75 * contact_.law().distance, 1.25 * largest_move(goal - start)));
  Result result{approach(balance, start, goal), {}};
  Eigen::VectorXd& z = result.positions;
  NewtonReport& report = result.report;
  while (true) {
    double scale = 0;
    const Eigen::VectorXd r = residual(balance, z, scale);
    report.residual = r.norm();
    report.residuals.push_back(report.residual);
    Move move = move_to(z, goal, Eigen::VectorXd::Zero(n_));
    if (!move.carries && report.residual <= policy_.tolerance * scale)
      return result;
    if (!r.allFinite() || report.iterations == policy_.max_iterations)
      fail_to_converge(
          "{}: shell '{}' found no equilibrium with contact in {} iterations: last residual {:.2e} of its forces, last "
          "increment {:.2e} of its size, smallest gap {:.3g}; take smaller steps",
          when, shell_.name(), report.iterations, report.residual / scale, report.increment,
          contact_.report(z).smallest_gap);
    move.direction.head(n_) += increment(balance, z, r, report);
    ++report.iterations;
    cover(z, move.direction);
    double fraction = contact_.safe_fraction(z, move.direction);
    if (!move.carries)
      fraction = decreasing_fraction(balance, z, move.direction, r, fraction);
    z += fraction * move.direction;
    if (!move.carries && report.increment <= policy_.round_off) {
      report.stopped_at_round_off = true;
      return result;
    }
  }
}

}  // namespace luff::shell
