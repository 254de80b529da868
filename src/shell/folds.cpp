// SPDX-License-Identifier: BSD-3-Clause
// How sharply a deformed shell folds over the edges of its mesh.
#include "shell/folds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// Signed angle between the normals of triangle t and of its neighbour over edge k [degrees].
double fold_angle(const Shell& shell, const Eigen::VectorXd& x, int t, int k)
{
  const auto normal = [&](int triangle) -> Vec3 {
    const auto [a, b, c] = shell.reference().triangles[triangle];
    return surface::area_vector(x.segment<3>(3 * a), x.segment<3>(3 * b), x.segment<3>(3 * c));
  };
  const auto [a, b] = surface::edge_vertices(shell.reference().triangles[t], k);
  const Vec3 along = (x.segment<3>(3 * b) - x.segment<3>(3 * a)).normalized();
  const Vec3 n = normal(t), m = normal(shell.topology().neighbour[t][k]);
  return std::atan2(n.cross(m).dot(along), n.dot(m)) * 180 / std::numbers::pi;
}

}  // namespace

Folds folds(const Shell& shell, const Eigen::VectorXd& x)
{
  constexpr double sharp = 45;
  Folds result;
  for (int t = 0; t < shell.reference().n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (shell.topology().neighbour[t][k] < t)
        continue;
      const double change = std::abs(fold_angle(shell, x, t, k) - fold_angle(shell, shell.reference_positions(), t, k));
      const double fold = std::min(change, 360 - change);
      result.n_sharp += fold > sharp ? 1 : 0;
      if (fold > result.largest) {
        result.largest = fold;
        result.at = {t, k};
      }
    }
  return result;
}

Folds check_folds(const Shell& shell, const Eigen::VectorXd& x, double limit, const std::string& when)
{
  const Folds found = folds(shell, x);
  if (found.largest > limit) {
    const auto [a, b] = surface::edge_vertices(shell.reference().triangles[found.at.triangle], found.at.edge);
    const PieceRange& piece = shell.piece_of_vertex(a);
    const Vec3 at = 0.5 * (x.segment<3>(3 * a) + x.segment<3>(3 * b));
    fail_run(
        "{}: shell '{}' folds by {:.0f} degrees over the edge of vertices {} and {} at ({:.6g}, {:.6g}, {:.6g}), "
        "more than structure.fold_limit = {:.0f}; refine the mesh there or take smaller steps",
        when, piece.name, found.largest, a - piece.first_vertex, b - piece.first_vertex, at.x(), at.y(), at.z(), limit);
  }
  return found;
}

}  // namespace luff::shell
