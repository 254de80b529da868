// SPDX-License-Identifier: BSD-3-Clause
// Displacements that supports hold: which, along what, and where they take them.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "shell/block_matrix.hpp"
#include "shell/motion.hpp"

namespace luff::shell {

/// Held displacements of n vertices, in vectors of 3n numbers x0 y0 z0 x1 ...
struct Held {
  /// A vertex held along directions that are no axes; `free` projects on those in which it may move.
  struct Oblique {
    int vertex;
    Mat3 free;
  };
  /// Components of a vertex that a motion prescribes; they are among the flags.
  struct Moved {
    int vertex;
    std::array<bool, 3> components;
    int motion;
  };
  /// Velocities and accelerations of held components, zero elsewhere.
  struct HeldRates {
    Eigen::VectorXd velocity;
    Eigen::VectorXd acceleration;
  };

  std::vector<char> flags;  ///< 3n: 1 where a component is held
  std::vector<Oblique> oblique;
  std::vector<Moved> moved;
  std::vector<Motion> motions;

  /// Whether any support moves.
  bool moves() const { return !moved.empty(); }
  /// Take the vertices of another mesh in, after those that are here.
  void append(const Held& other);
  /// Put zeros where v is held, in directions that are no axes too.
  void clear(Eigen::VectorXd& v) const;
  /// Put what is held in its place at time t: the reference X, or as a `factor` of its motion takes it.
  void place(const Eigen::VectorXd& X, double t, double factor, Eigen::VectorXd& x) const;
  /// Velocities at t_velocity, accelerations at t_acceleration, for steps of dt.
  HeldRates rates(const Eigen::VectorXd& X, double t_velocity, double t_acceleration, double dt) const;
  /// Take held directions that are no axes out of the equations: K <- P K P + s (I - P) at their vertices, P = free, s
  /// the size of what was there times `weight`. With a right side cleared of them the solution has none.
  void decouple(BlockMatrix& K, double weight = 1) const;
};

}  // namespace luff::shell
