// SPDX-License-Identifier: BSD-3-Clause
// Choosing vertices of a surface by where they are.
#include "surface/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace luff::surface {

namespace {

std::string text(const Vec3& p)
{
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

double distance(const EdgeWhere& edge, const Vec3& x)
{
  const Vec3 along = edge.q - edge.p;
  const double s = std::clamp(along.dot(x - edge.p) / along.squaredNorm(), 0.0, 1.0);
  return (x - edge.p - s * along).norm();
}

double distance(const BoxWhere& box, const Vec3& x)
{
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

double distance(const PlaneWhere& plane, const Vec3& x)
{
  return std::abs(plane.normal.normalized().dot(x - plane.point));
}

double distance(const PointWhere& point, const Vec3& x)
{
  return (x - point.point).norm();
}

void check(const EdgeWhere& edge, std::string_view what)
{
  if (!((edge.q - edge.p).norm() > 0))
    fail_input("{}: edge = [{}, {}] has no length; give its two ends", what, text(edge.p), text(edge.q));
}

void check(const BoxWhere& box, std::string_view what)
{
  if (!((box.high - box.low).minCoeff() >= 0))
    fail_input("{}: box = [{}, {}] must have its low corner first", what, text(box.low), text(box.high));
}

void check(const PlaneWhere& plane, std::string_view what)
{
  if (!(plane.normal.norm() > 0))
    fail_input("{}: the plane's normal {} must have a length", what, text(plane.normal));
}

void check(const PointWhere& point, std::string_view what)
{
  if (!point.point.allFinite())
    fail_input("{}: point = {} must be finite", what, text(point.point));
}

}  // namespace

std::vector<int> select_vertices(const TriangleMesh& mesh, const Where& where, std::string_view what)
{
  ensure(!mesh.vertices.empty(), "selection from an empty mesh");
  std::visit([&](const auto& w) { check(w, what); }, where);
  const double slack = selection_tolerance * bounding_box(mesh.vertices).size();
  std::vector<int> found;
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const double d = std::visit([&](const auto& w) { return distance(w, mesh.vertices[v]); }, where);
    if (d <= slack)
      found.push_back(v);
    if (d < least) {
      least = d;
      nearest = v;
    }
  }
  if (std::holds_alternative<PointWhere>(where))
    return {nearest};
  if (found.empty())
    fail_input(
        "{}: no vertex lies there (in the reference configuration, after rotate, translate and scale); the nearest "
        "is vertex {} at {}, {:.3g} away",
        what, nearest, text(mesh.vertices[nearest]), least);
  return found;
}

}  // namespace luff::surface
