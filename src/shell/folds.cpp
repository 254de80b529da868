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

constexpr double degree = std::numbers::pi / 180;

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
  return std::atan2(n.cross(m).dot(along), n.dot(m)) / degree;
}

/// Angle by which triangle and mirror image differ: twice that of the triangle's normal out of the mirror [degrees].
double mirrored_angle(const Shell& shell, const Shell::Mirror& mirror, const Vec3& mirror_normal,
                      const Eigen::VectorXd& x)
{
  const auto& [a, b, c] = shell.reference().triangles[mirror.edge.triangle];
  const Vec3 n = surface::area_vector(x.segment<3>(3 * a), x.segment<3>(3 * b), x.segment<3>(3 * c));
  const Vec3 along = (x.segment<3>(3 * mirror.b) - x.segment<3>(3 * mirror.a)).normalized();
  return 2 * std::atan2(n.dot(mirror_normal), n.dot(mirror_normal.cross(along))) / degree;
}

/// Keeps the largest and counts the sharp ones.
void add(double angle, double reference_angle, surface::TriangleEdge at, Folds& result)
{
  constexpr double sharp = 45, turn = 360;
  const double fold = std::abs(std::remainder(angle - reference_angle, turn));
  result.n_sharp += fold > sharp ? 1 : 0;
  if (fold > result.largest) {
    result.largest = fold;
    result.at = at;
  }
}

}  // namespace

Folds folds(const Shell& shell, const Eigen::VectorXd& x, double t_supports, double factor)
{
  const Eigen::VectorXd& X = shell.reference_positions();
  Folds result;
  for (int t = 0; t < shell.reference().n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (shell.topology().neighbour[t][k] < t)
        continue;
      add(fold_angle(shell, x, t, k), fold_angle(shell, X, t, k), {t, k}, result);
    }
  for (const Shell::Mirror& mirror : shell.mirrors())
    add(mirrored_angle(shell, mirror, shell.normal_of(mirror, t_supports, factor), x),
        mirrored_angle(shell, mirror, mirror.normal, X), mirror.edge, result);
  return result;
}

Folds check_folds(const Shell& shell, const Eigen::VectorXd& x, double limit, const std::string& when, double t,
                  double factor)
{
  const Folds found = folds(shell, x, t, factor);
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
