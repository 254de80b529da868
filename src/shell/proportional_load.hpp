// SPDX-License-Identifier: BSD-3-Clause
// A shell under loads that grow together by one factor.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "shell/loads.hpp"
#include "shell/newton.hpp"
#include "shell/skew_solve.hpp"

namespace luff::shell {

/// Equilibrium f_int(x) = factor f_ext(x) of a shell; every load, gravity and the motion of supports is
/// multiplied by the factor.
class ProportionalLoad {
 public:
  /// Loads are those of this time. Keeps a reference to the shell. \throws InputError as Loads does.
  ProportionalLoad(const Shell& shell, const std::vector<Load>& loads, double time);

  const Shell& shell() const { return shell_; }
  /// f_ext, zero where held.
  Eigen::VectorXd load(const Eigen::VectorXd& x) const;
  /// factor f_ext - f_int, zero where held.
  Eigen::VectorXd residual(const Eigen::VectorXd& x, double factor) const;
  double elastic_energy(const Eigen::VectorXd& x, double factor) const;
  /// f_int
  Eigen::VectorXd internal_force(const Eigen::VectorXd& x, double factor) const;
  /// Put what is held where the factor's part of its motion takes it.
  void place_supports(double factor, Eigen::VectorXd& x) const;
  /// K += -d residual / d x
  void add_tangent(const Eigen::VectorXd& x, double factor, BlockMatrix& K) const;
  /// Whether the tangent leaves out a skew part, of follower pressure.
  bool has_skew_stiffness() const { return loads_.has_skew_stiffness(); }
  /// That part times v: -d residual / d x is the tangent less it.
  SkewProduct skew_stiffness(const Eigen::VectorXd& x, double factor) const;
  /// Energy that the straight move from x to y sets free, factor * work of the loads - change of the elastic energy.
  double released_energy(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double factor) const;
  /// The equations of Newton's method. Keeps references to this and to the factor.
  Equilibrium equilibrium(const double& factor) const;

 private:
  const Shell& shell_;
  double time_;
  LoadsAtTime loads_;
};

}  // namespace luff::shell
