// SPDX-License-Identifier: BSD-3-Clause
// Contact in the steps of a shell, in time or of a growing load.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "shell/contact/contact_newton.hpp"

namespace luff::shell {

/// Contact of the shell's pieces with themselves, each other and rigid bodies.
struct ContactOptions {
  ContactLaw law;
  std::vector<ContactSheet> bodies{};  ///< rigid, as they are at the start
  /// Coordinates of all the bodies' vertices at time t, 3m numbers; not needed without bodies. Of statics t is the load
  /// factor.
  std::function<Eigen::VectorXd(double t)> body_positions{};
  ContactNewtonPolicy newton{};
};

/// Contact acts at the end of a step. All that a step depends on is where shell and bodies are accepted to be.
class ContactStep {
 public:
  /// From the shell at x and time t. Keeps a reference to the shell. \throws InputError as Contact does.
  ContactStep(const Shell& shell, ContactOptions options, LinearSolverKind kind, const Eigen::VectorXd& x, double t);

  /// Positions of the shell's vertices (3n) in balance at t_new; see ContactNewton::solve.
  ContactNewton::Result solve(const SmoothBalance& balance, const Eigen::VectorXd& guess, double t_new,
                              const std::string& when);
  /// Make x and the bodies' places at time t the accepted ones. Returns the work that moving bodies did on the shell
  /// since the last accepted ones.
  double accept(const Eigen::VectorXd& x, double t);
  /// The same without a past.
  void restore(const Eigen::VectorXd& x, double t);

  /// Of the accepted configuration.
  double energy() const { return energy_; }
  const ContactReport& report() const { return report_; }
  Crossings crossings() const;

 private:
  Eigen::VectorXd with_bodies(const Eigen::VectorXd& x, double t) const;

  ContactOptions options_;
  Contact contact_;
  ContactNewton newton_;
  Eigen::VectorXd positions_;  ///< of all vertices, accepted
  Eigen::VectorXd gradient_;   ///< of the contact energy there
  double energy_ = 0;
  ContactReport report_;
};

}  // namespace luff::shell
