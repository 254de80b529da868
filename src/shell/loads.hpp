// SPDX-License-Identifier: BSD-3-Clause
// Prescribed loads on a shell.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "core/vec3.hpp"
#include "shell/edge_turn.hpp"
#include "shell/shell.hpp"

namespace luff::shell {

/// Functions of a point of the reference configuration and of time.
using VectorFunction = std::function<Vec3(const Vec3&, double)>;
using ScalarFunction = std::function<double(const Vec3&, double)>;

/// A dead force [M L/T^2] shared among vertices: by the length of the boundary edges between them that each one owns,
/// or equally when there is no such edge. The function is evaluated at each vertex.
struct PointForce {
  std::vector<int> vertices;
  VectorFunction force;
};

/// A dead traction per area of the reference [M/(L T^2)], a third of each triangle's force to each corner.
/// No triangles listed: all of them.
struct Traction {
  std::vector<int> triangles;
  VectorFunction traction;
};

/// A pressure along the current normal [M/(L T^2)], f_i = p/6 (x2 - x1) x (x3 - x1); it follows the shell.
/// No triangles listed: all of them.
struct Pressure {
  std::vector<int> triangles;
  ScalarFunction pressure;
};

/// A dead force per length of the reference [M/T^2] on the boundary edges between the vertices, linear along each.
struct EdgeForce {
  std::vector<int> vertices;
  VectorFunction force;
};

/// A moment per length of the reference [M L/T^2] on the boundary edges between the vertices, about the direction that
/// each has in the reference; positive where it raises the edge towards the normal. It follows the edge: its work is
/// moment x length x turn (EdgeTurn), over any number of turns.
struct EdgeMoment {
  std::vector<int> vertices;
  ScalarFunction moment;
};

using Load = std::variant<PointForce, Traction, Pressure, EdgeForce, EdgeMoment>;

/// The load with its vertices and triangles counted from those of a piece: both numbers are added.
Load renumbered(Load load, int first_vertex, int first_triangle);

/// The loads of one instant: what doesn't depend on the configuration is evaluated once.
class LoadsAtTime {
 public:
  /// Nodal forces (3n) in configuration x.
  Eigen::VectorXd force(const Eigen::VectorXd& x) const;
  /// K -= factor * the symmetric part of d force / d x. What it leaves out vanishes for a uniform pressure on a shell
  /// without free edges.
  void subtract_stiffness(const Eigen::VectorXd& x, double factor, BlockMatrix& K) const;
  /// Whether that may leave something out.
  bool has_skew_stiffness() const { return !pressed_.empty(); }
  /// The skew part of d force / d x, times v.
  Eigen::VectorXd skew_stiffness_times(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

 private:
  friend class Loads;
  struct Pressed {
    std::array<int, 3> corner;
    double pressure;
  };
  struct Turned {
    EdgeTurn turn;
    double moment;  ///< of the whole edge
  };
  Eigen::VectorXd dead_;
  std::vector<Pressed> pressed_;
  std::vector<Turned> turned_;
};

/// Loads and gravity of a shell.
class Loads {
 public:
  /// Keeps a reference to the shell. \throws InputError for numbers out of range, a PointForce without vertex, an
  /// EdgeForce or EdgeMoment without edge.
  Loads(const Shell& shell, std::vector<Load> loads);

  LoadsAtTime at(double t) const;

 private:
  void add(const PointForce& load, const std::vector<double>& shares, double t, LoadsAtTime& now) const;
  void add(const Traction& load, double t, LoadsAtTime& now) const;
  void add(const Pressure& load, double t, LoadsAtTime& now) const;
  void add(const EdgeForce& load, double t, LoadsAtTime& now) const;
  void add(const EdgeMoment& load, double t, LoadsAtTime& now) const;
  void check_vertices(const std::vector<int>& vertices, std::string_view kind) const;
  void check_edges(const std::vector<int>& vertices, std::string_view kind) const;
  void check_triangles(std::vector<int>& triangles) const;

  const Shell& shell_;
  std::vector<Load> loads_;
  std::vector<std::vector<double>> shares_;  ///< of each point force, per vertex
  Eigen::VectorXd weight_;                   ///< gravity, constant
};

}  // namespace luff::shell
