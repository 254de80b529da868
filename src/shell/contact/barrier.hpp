// SPDX-License-Identifier: BSD-3-Clause
// Energy of a pair of surface pieces that come close: a logarithmic barrier that no finite force overcomes.
#pragma once

#include <array>

#include <Eigen/Core>

#include "surface/closest_points.hpp"

namespace luff::shell {

using surface::Closest;
using surface::Corners;
using surface::edge_edge;
using surface::point_triangle;

/// Value and derivatives of a barrier at one distance.
struct BarrierValue {
  double energy;  ///< per area [M/T^2]
  double slope;   ///< d energy / d distance, <= 0 [M/(L T^2)]
  double curvature;
};

/// stiffness * reach * B(d / reach) with B(x) = -(x - 1)^2 ln x for x < 1, else 0: twice differentiable at x = 1,
/// infinite at x = 0. The form is that of \cite li_2020_incremental, scaled so that `stiffness` is a pressure: the
/// slope is -stiffness at x = 0.53.
BarrierValue barrier(double distance, double reach, double stiffness);

enum class PairKind : char { PointTriangle, EdgeEdge };

/// Two pieces of surface that may meet, see Corners for the order of the vertices.
struct ContactPair {
  std::array<int, 4> vertex;
  PairKind kind;
  double area;      ///< that the pair stands for [L^2]
  double reach;     ///< distance where the force begins [L]
  double parallel;  ///< edges: |a x b|^2 below which the mollifier acts [L^4]
};

using PairGradient = Eigen::Matrix<double, 12, 1>;
using PairHessian = Eigen::Matrix<double, 12, 12>;

Closest closest(PairKind kind, const Corners& x);

/// area * m * barrier(distance). For edges, m = y (2 - y) with y = min(1, |a x b|^2 / parallel) fades the energy out as
/// they turn parallel, where their closest points jump (after \cite li_2020_incremental, with a larger threshold).
double pair_energy(const ContactPair& pair, const Corners& x, double stiffness);

/// Exact gradient of pair_energy.
PairGradient pair_gradient(const ContactPair& pair, const Corners& x, double stiffness);

/// Gauss-Newton part of the Hessian, area * m * barrier'' * (grad d)(grad d)': positive semi-definite. It leaves out
/// what the changing direction of the normal adds, which is negative, and the mollifier's derivatives.
PairHessian pair_hessian(const ContactPair& pair, const Corners& x, double stiffness);

/// Exact Hessian of pair_energy where the closest points stay on the pieces that they are on; indefinite.
PairHessian exact_pair_hessian(const ContactPair& pair, const Corners& x, double stiffness);

}  // namespace luff::shell
