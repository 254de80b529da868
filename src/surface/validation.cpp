// SPDX-License-Identifier: BSD-3-Clause
// Is a mesh an oriented manifold with sound triangles?
#include "surface/validation.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "surface/orientation.hpp"
#include "surface/point_index.hpp"
#include "surface/topology.hpp"

namespace luff::surface {

namespace {

std::string at(const Vec3& p)
{
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

std::string corners(const TriangleMesh& mesh, int triangle)
{
  const auto& t = mesh.triangles[triangle];
  return fmt::format("triangle {} (vertices {}, {}, {}) at {}", triangle, t[0], t[1], t[2],
                     at(centroid(mesh, triangle)));
}

void check_shapes(const TriangleMesh& mesh, std::string_view where)
{
  // Height over length below which a triangle counts as having no area.
  constexpr double thinnest = 1e-6;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    if (i == j || j == k || k == i)
      fail_input("{}: {} uses a vertex twice; remove it", where, corners(mesh, t));
    const auto& x = mesh.vertices;
    const double longest = std::max({(x[i] - x[j]).norm(), (x[j] - x[k]).norm(), (x[k] - x[i]).norm()});
    if (!(2 * area(mesh, t) > thinnest * longest * longest))
      fail_input("{}: {} has no area (height/length below {:g}); remove it or move a vertex", where, corners(mesh, t),
                 thinnest);
  }
}

void check_vertices(const TriangleMesh& mesh, std::string_view where)
{
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const int v : t)
      used[v] = 1;
  const BoundingBox box = bounding_box(mesh.vertices);
  PointIndex placed(box.low, duplicate_tolerance * box.size());
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (!used[v])
      fail_input("{}: vertex {} at {} belongs to no triangle; remove it", where, v, at(mesh.vertices[v]));
    if (const int twin = placed.find(mesh.vertices[v]); twin >= 0)
      fail_input("{}: vertices {} and {} are at the same place {}; merge them", where, twin, v, at(mesh.vertices[v]));
    placed.add(v, mesh.vertices[v]);
  }
}

void check_duplicates(const TriangleMesh& mesh, std::string_view where)
{
  std::map<std::array<int, 3>, int> seen;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    std::array<int, 3> key = mesh.triangles[t];
    std::sort(key.begin(), key.end());
    const auto [other, is_new] = seen.emplace(key, t);
    if (!is_new)
      fail_input("{}: {} is a duplicate of triangle {}; remove one", where, corners(mesh, t), other->second);
  }
}

using EdgeMap = std::map<EdgeKey, std::vector<TriangleEdge>>;

void check_manifold(const TriangleMesh& mesh, const EdgeMap& edges, std::string_view where)
{
  for (const auto& [key, sides] : edges)
    if (sides.size() > 2)
      fail_input(
          "{}: {} triangles ({}, {}, {}{}) share the edge of vertices {} and {} at {}, at most 2 may; "
          "split the surface there",
          where, sides.size(), sides[0].triangle, sides[1].triangle, sides[2].triangle, sides.size() > 3 ? ", ..." : "",
          key.first, key.second, at(0.5 * (mesh.vertices[key.first] + mesh.vertices[key.second])));
}

void check_orientation(const TriangleMesh& mesh, std::string_view where)
{
  const Orientation found = orientation(mesh);
  if (found.one_sided >= 0)
    fail_input("{}: the surface has one side only (a Moebius band) at {}; cut it open", where,
               corners(mesh, found.one_sided));
  if (found.flipped.empty())
    return;
  const int first = found.flipped.front();
  const auto in_piece = [&](int t) { return found.piece[t] == found.piece[first]; };
  fail_input("{}: {} is flipped against its neighbours ({} of {} triangles are); reverse the order of its vertices",
             where, corners(mesh, first), std::count_if(found.flipped.begin(), found.flipped.end(), in_piece),
             std::count(found.piece.begin(), found.piece.end(), found.piece[first]));
}

}  // namespace

void validate_numbers(const TriangleMesh& mesh, std::string_view where)
{
  if (mesh.triangles.empty())
    fail_input("{}: the mesh has no triangles", where);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!mesh.vertices[v].allFinite())
      fail_input("{}: vertex {} at {} is not finite; write the file again", where, v, at(mesh.vertices[v]));
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (const int v : mesh.triangles[t])
      if (v < 0 || v >= mesh.n_vertices())
        fail_input("{}: triangle {} uses vertex {}, but vertices are numbered 0..{}", where, t, v,
                   mesh.n_vertices() - 1);
}

void validate(const TriangleMesh& mesh, std::string_view where)
{
  validate_numbers(mesh, where);
  check_shapes(mesh, where);
  check_vertices(mesh, where);
  check_duplicates(mesh, where);
  check_manifold(mesh, edge_map(mesh), where);
  check_orientation(mesh, where);
}

}  // namespace luff::surface
