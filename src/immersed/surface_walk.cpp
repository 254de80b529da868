// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/surface_walk.hpp"

#include <algorithm>

#include "surface/closest_points.hpp"

namespace luff::immersed {

namespace {

/// Area coordinates below it are zero.
constexpr double on_edge = 1e-10;

}  // namespace

SurfaceWalk::SurfaceWalk(std::span<const Vec3> positions, std::span<const std::array<int, 3>> triangles)
    : positions_(positions), triangles_(triangles), first_(positions.size() + 1, 0), around_(3 * triangles.size())
{
  for (const auto& corners : triangles)
    for (const int v : corners)
      ++first_[v + 1];
  for (std::size_t v = 0; v < positions.size(); ++v)
    first_[v + 1] += first_[v];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (const int v : triangles[e])
      around_[next[v]++] = static_cast<int>(e);
}

SurfaceWalk::Reached SurfaceWalk::on_triangle(const Vec3& x, int triangle) const
{
  const auto& [a, b, c] = triangles_[triangle];
  const surface::Closest found = surface::point_triangle({x, positions_[a], positions_[b], positions_[c]});
  return {{triangle, {-found.weight[1], -found.weight[2], -found.weight[3]}, x - found.distance * found.normal},
          found.distance};
}

SurfacePoint SurfaceWalk::closest(const Vec3& x, int near_triangle) const
{
  Reached best = on_triangle(x, near_triangle);
  for (int from = -1; from != best.point.triangle;) {
    from = best.point.triangle;
    for (const int v : triangles_[from])
      for (int n = first_[v]; n < first_[v + 1]; ++n)
        if (const Reached other = on_triangle(x, around_[n]); other.distance < best.distance)
          best = other;
  }
  return best.point;
}

std::vector<int> SurfaceWalk::triangles_at(const SurfacePoint& point) const
{
  std::vector<int> corners;  // whose triangles all hold the point
  for (int n = 0; n < 3; ++n)
    if (point.weights[n] > on_edge)
      corners.push_back(triangles_[point.triangle][n]);
  std::vector<int> found;
  for (int n = first_[corners[0]]; n < first_[corners[0] + 1]; ++n) {
    const auto& triangle = triangles_[around_[n]];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](int v) { return std::find(triangle.begin(), triangle.end(), v) != triangle.end(); }))
      found.push_back(around_[n]);
  }
  return found;
}

}  // namespace luff::immersed
