// SPDX-License-Identifier: BSD-3-Clause
// Do surfaces pass through each other or through themselves?
#include "shell/contact/crossings.hpp"

#include <Eigen/Geometry>

namespace luff::shell {

namespace {

/// Six times the volume of the tetrahedron (a, b, c, d), relative to a.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return (b - a).dot((c - a).cross(d - a));
}

}  // namespace

/// The ends are on two sides of the plane and the edge passes all three sides of the triangle the same way around.
bool pierces(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle)
{
  const auto& [p, q, r] = triangle;
  if (volume(p, q, r, a) * volume(p, q, r, b) >= 0)
    return false;
  const double u = volume(a, b, p, q), v = volume(a, b, q, r), w = volume(a, b, r, p);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

Crossings crossings(const ContactPieces& pieces, const Eigen::VectorXd& x, bool self)
{
  Crossings found;
  Boxes edges, triangles;
  box_edges(pieces, x, edges);
  box_triangles(pieces, x, triangles);
  Sweep{}(edges, triangles, [&](int edge, int triangle) {
    const auto& [a, b] = pieces.edges()[edge];
    const auto& [p, q, r] = pieces.triangles()[triangle];
    const bool same = pieces.surface(a) == pieces.surface(p);
    const bool shared = a == p || a == q || a == r || b == p || b == q || b == r;
    if (shared || (same && !self) || !(pieces.deforms(a) || pieces.deforms(p)))
      return;
    if (!pierces(vertex(x, a), vertex(x, b), {vertex(x, p), vertex(x, q), vertex(x, r)}))
      return;
    if (found.count++ == 0) {
      found.vertex = a;
      found.place = 0.5 * (vertex(x, a) + vertex(x, b));
    }
  });
  return found;
}

}  // namespace luff::shell
