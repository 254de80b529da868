// SPDX-License-Identifier: BSD-3-Clause
// Distance between the smallest pieces of two surfaces.
#include "surface/closest_points.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace luff::surface {

namespace {

/// Parameter in [0, 1] of the point of edge a..b closest to p.
double along_edge(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double length_squared = edge.squaredNorm();
  return length_squared > 0 ? std::clamp(edge.dot(p - a) / length_squared, 0.0, 1.0) : 0.0;
}

/// The vector between the closest points, taken relative to corner 0: gaps are small against coordinates.
Closest with_weights(const Corners& x, const std::array<double, 4>& weight)
{
  Closest closest{weight, Vec3::Zero(), 0};
  for (int k = 1; k < 4; ++k)
    closest.normal += weight[k] * (x[k] - x[0]);
  closest.distance = closest.normal.norm();
  if (closest.distance > 0)
    closest.normal /= closest.distance;
  return closest;
}

void keep_nearer(Closest& best, const Closest& other)
{
  if (other.distance < best.distance)
    best = other;
}

}  // namespace

/// Inside the triangle the weights are ratios of areas; else the closest point is on an edge.
Closest point_triangle(const Corners& x)
{
  const Vec3 n = (x[2] - x[1]).cross(x[3] - x[1]);
  const double u = n.dot((x[2] - x[0]).cross(x[3] - x[0]));
  const double v = n.dot((x[3] - x[0]).cross(x[1] - x[0]));
  const double w = n.dot((x[1] - x[0]).cross(x[2] - x[0]));
  if (u > 0 && v > 0 && w > 0) {
    const double sum = u + v + w;
    return with_weights(x, {1, -u / sum, -v / sum, -w / sum});
  }
  const double s = along_edge(x[0], x[1], x[2]), t = along_edge(x[0], x[2], x[3]), r = along_edge(x[0], x[3], x[1]);
  Closest best = with_weights(x, {1, -(1 - s), -s, 0});
  keep_nearer(best, with_weights(x, {1, 0, -(1 - t), -t}));
  keep_nearer(best, with_weights(x, {1, -r, 0, -(1 - r)}));
  return best;
}

/// Either an end of one edge is closest to the other edge, or the closest points of the two lines are inside both
/// edges. Comparing all five needs no tolerance for parallel edges: a bad inner point just is not the nearest.
Closest edge_edge(const Corners& x)
{
  const double s0 = along_edge(x[0], x[2], x[3]), s1 = along_edge(x[1], x[2], x[3]);
  const double s2 = along_edge(x[2], x[0], x[1]), s3 = along_edge(x[3], x[0], x[1]);
  Closest best = with_weights(x, {1, 0, -(1 - s0), -s0});
  keep_nearer(best, with_weights(x, {0, 1, -(1 - s1), -s1}));
  keep_nearer(best, with_weights(x, {1 - s2, s2, -1, 0}));
  keep_nearer(best, with_weights(x, {1 - s3, s3, 0, -1}));
  const Vec3 a = x[1] - x[0], b = x[3] - x[2], r = x[0] - x[2];
  const Vec3 across = a.cross(b);
  const double area_squared = across.squaredNorm();
  const double s = across.dot(b.cross(r)), t = across.dot(a.cross(r));
  if (s > 0 && t > 0 && s < area_squared && t < area_squared)
    keep_nearer(best,
                with_weights(x, {1 - s / area_squared, s / area_squared, -(1 - t / area_squared), -t / area_squared}));
  return best;
}

}  // namespace luff::surface
