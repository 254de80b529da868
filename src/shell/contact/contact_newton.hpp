// SPDX-License-Identifier: BSD-3-Clause
// Newton's method for the balance of a shell that may touch itself, others and rigid bodies.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "shell/contact/contact.hpp"
#include "shell/newton.hpp"
#include "shell/skew_solve.hpp"

namespace luff::shell {

/// The balance of a step without contact: other_forces(x) = elastic_force(x), as functions of the positions x of the
/// shell's vertices at the end of the step, in time or of a growing load.
struct SmoothBalance {
  std::function<double(const Eigen::VectorXd& x)> elastic_energy;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> elastic_force;  ///< gradient of elastic_energy
  /// Loads, the fluid's forces, minus inertia and damping; at most quadratic in x for the merit function to be exact.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> other_forces;
  std::function<void(const Eigen::VectorXd& x, BlockMatrix& K)> tangent;  ///< K = d (elastic - other forces)/d x
  /// What the tangent leaves out, a skew matrix: K - skew is the derivative. None: nothing.
  std::function<SkewProduct(const Eigen::VectorXd& x)> skew{};
  /// K += part * what resists motion, positive definite: inertia in a step in time, a small viscosity in a static one.
  std::function<void(double part, BlockMatrix& K)> add_resistance;
  double force_scale = 0;  ///< norm of loads and inertia: what a residual is compared with
  double energy = 0;       ///< kinetic and elastic at the start of the step
};

struct ContactNewtonPolicy {
  double tolerance = 1e-6;   ///< largest residual of a balanced step, part of the largest of its forces
  double round_off = 1e-12;  ///< increments below this part of the size end the iteration, too
  int max_iterations = 30;
  int most_shifts = 8;     ///< of a tangent that isn't positive definite, each times
  double shift_ratio = 3;  ///< the resistance before
  /// In time the inertia hides what the Gauss-Newton part leaves out.
  ContactHessian hessian = ContactHessian::GaussNewton;
};

/// Minimises Phi = W + contact energy - work of all other forces, whose gradient is the residual of the step, starting
/// from and passing through configurations without crossings only (\cite li_2020_incremental):
///
/// - every move leaves every pair half its distance (Contact::safe_fraction);
/// - a tangent that isn't positive definite gets more resistance, shift_ratio times each, until it is;
/// - a move is halved until Phi decreases. The work of the other forces is integrated along the move by Simpson's
///   rule: exact for inertia, damping and follower pressure, for which it is p (V(y) - V(x)) and the work on the rims;
/// - supports and rigid bodies that move are carried to their places together with the Newton steps, as far as is safe.
class ContactNewton {
 public:
  /// Keeps references to both.
  ContactNewton(const Shell& shell, Contact& contact, LinearSolverKind kind, ContactNewtonPolicy policy = {});

  /// Positions of all vertices, the shell's first and then those of rigid bodies, in balance.
  struct Result {
    Eigen::VectorXd positions;
    NewtonReport report;
  };

  /// From positions `start`, free of crossings, towards `goal`: a guess for the free vertices, the place to be for
  /// held displacements and rigid bodies. \throws NonConvergence that starts with `when`; a shorter step helps.
  Result solve(const SmoothBalance& balance, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
               const std::string& when);

 private:
  struct Move {
    Eigen::VectorXd direction;  ///< of all vertices
    bool carries = false;       ///< supports or bodies are not yet in their places
  };

  void gather(const Eigen::VectorXd& z, double margin);
  void cover(const Eigen::VectorXd& z, const Eigen::VectorXd& direction);
  Eigen::VectorXd shell_part(const Eigen::VectorXd& z) const { return z.head(n_); }
  Eigen::VectorXd approach(const SmoothBalance& balance, const Eigen::VectorXd& start, const Eigen::VectorXd& goal);
  Eigen::VectorXd residual(const SmoothBalance& balance, const Eigen::VectorXd& z, double& scale) const;
  Eigen::VectorXd increment(const SmoothBalance& balance, const Eigen::VectorXd& z, const Eigen::VectorXd& r,
                            NewtonReport& report);
  void factorise_positive(const SmoothBalance& balance, NewtonReport& report);
  Move move_to(const Eigen::VectorXd& z, const Eigen::VectorXd& goal, const Eigen::VectorXd& dx) const;
  double decreasing_fraction(const SmoothBalance& balance, const Eigen::VectorXd& z, const Eigen::VectorXd& direction,
                             const Eigen::VectorXd& r, double fraction) const;

  const Shell& shell_;
  Contact& contact_;
  LinearSolverKind kind_;
  ContactNewtonPolicy policy_;
  Eigen::Index n_;            ///< numbers per vector of the shell
  double longest_increment_;  ///< half an edge [L]
  BlockMatrix smooth_;        ///< tangent without contact
  Eigen::VectorXd centre_;    ///< where the pairs were gathered
  double margin_ = 0;
  std::shared_ptr<const BlockPattern> pattern_;  ///< of the shell and the pairs; null: not yet made
  std::unique_ptr<BlockMatrix> K_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace luff::shell
