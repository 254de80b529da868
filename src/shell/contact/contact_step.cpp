// SPDX-License-Identifier: BSD-3-Clause
// Contact in the steps of a shell, in time or of a growing load.
#include "shell/contact/contact_step.hpp"

#include <utility>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// Bodies are rigid whatever they were called; the shell's surfaces are found by what hangs together.
std::vector<ContactSheet> sheets_of(const Shell& shell, const std::vector<ContactSheet>& bodies)
{
  std::vector<ContactSheet> sheets{{shell.name(), shell.reference(), true}};
  for (const ContactSheet& body : bodies)
    sheets.push_back({body.name, body.mesh, false});
  return sheets;
}

}  // namespace

ContactStep::ContactStep(const Shell& shell, ContactOptions options, LinearSolverKind kind, const Eigen::VectorXd& x,
                         double t)
    : options_(std::move(options)),
      contact_(sheets_of(shell, options_.bodies), options_.law),
      newton_(shell, contact_, kind, options_.newton)
{
  restore(x, t);
}

Eigen::VectorXd ContactStep::with_bodies(const Eigen::VectorXd& x, double t) const
{
  if (options_.bodies.empty())
    return x;
  const Eigen::VectorXd bodies = options_.body_positions(t);
  Eigen::VectorXd z(x.size() + bodies.size());
  z << x, bodies;
  ensure(z.size() == contact_.pieces().reference().size(), "bodies keep their number of vertices");
  return z;
}

ContactNewton::Result ContactStep::solve(const SmoothBalance& balance, const Eigen::VectorXd& guess, double t_new,
                                         const std::string& when)
{
  ContactNewton::Result result = newton_.solve(balance, positions_, with_bodies(guess, t_new), when);
  result.positions.conservativeResize(guess.size());
  return result;
}

/// Trapezoidal rule with the forces that hold the bodies against the shell.
double ContactStep::accept(const Eigen::VectorXd& x, double t)
{
  const Eigen::VectorXd before = positions_, gradient_before = gradient_;
  restore(x, t);
  const Eigen::Index bodies = positions_.size() - x.size();
  return 0.5 * (positions_ - before).tail(bodies).dot((gradient_before + gradient_).tail(bodies));
}

void ContactStep::restore(const Eigen::VectorXd& x, double t)
{
  positions_ = with_bodies(x, t);
  contact_.gather(positions_, 0);
  gradient_ = Eigen::VectorXd::Zero(positions_.size());
  contact_.add_gradient(positions_, gradient_);
  energy_ = contact_.energy(positions_);
  report_ = contact_.report(positions_);
}

Crossings ContactStep::crossings() const
{
  return shell::crossings(contact_.pieces(), positions_, options_.law.self);
}

}  // namespace luff::shell
