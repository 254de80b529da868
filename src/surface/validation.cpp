// SPDX-License-Identifier: BSD-3-Clause
// Is a mesh an oriented manifold with sound triangles?
#include "surface/validation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/topology.hpp"

namespace luff::surface {

namespace {

/// Finds a point placed before, closer than a distance. Cells of that distance, so that only neighbours are looked at.
class PointIndex {
 public:
  /// A distance of zero stands for points that all coincide; then any other serves.
  PointIndex(const Vec3& origin, double distance) : origin_(origin), distance_(distance > 0 ? distance : 1) {}

  /// Number of an earlier point, or -1.
  int find(const Vec3& p) const
  {
    const Cell cell = cell_of(p);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({cell[0] + i, cell[1] + j, cell[2] + k});
          if (found == cells_.end())
            continue;
          for (const auto& [number, q] : found->second)
            if ((p - q).norm() <= distance_)
              return number;
        }
    return -1;
  }

  void add(int number, const Vec3& p) { cells_[cell_of(p)].emplace_back(number, p); }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& p) const
  {
    const Vec3 c = (p - origin_) / distance_;
    return {std::llround(c.x()), std::llround(c.y()), std::llround(c.z())};
  }

  Vec3 origin_;
  double distance_;
  std::map<Cell, std::vector<std::pair<int, Vec3>>> cells_;
};

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

/// Spreads an orientation over connected triangles and finds those that disagree with most of their component.
class OrientationCheck {
 public:
  OrientationCheck(const TriangleMesh& mesh, const EdgeMap& edges, std::string_view where)
      : mesh_(mesh), edges_(edges), where_(where), sign_(mesh.triangles.size(), 0)
  {
  }

  void run()
  {
    for (int t = 0; t < mesh_.n_triangles(); ++t)
      if (sign_[t] == 0)
        check_component(t);
  }

 private:
  void check_component(int seed)
  {
    std::vector<int> component{seed};
    sign_[seed] = 1;
    int sum = 0;
    for (std::size_t next = 0; next < component.size(); ++next) {
      sum += sign_[component[next]];
      for (int k = 0; k < 3; ++k)
        visit_neighbour(component[next], k, component);
    }
    const int minority = sum >= 0 ? -1 : 1;
    std::vector<int> flipped;
    for (const int t : component)
      if (sign_[t] == minority)
        flipped.push_back(t);
    if (flipped.empty())
      return;
    const int first = *std::min_element(flipped.begin(), flipped.end());
    fail_input("{}: {} is flipped against its neighbours ({} of {} triangles are); reverse the order of its vertices",
               where_, corners(mesh_, first), flipped.size(), component.size());
  }

  void visit_neighbour(int t, int k, std::vector<int>& component)
  {
    const auto [a, b] = edge_vertices(mesh_.triangles[t], k);
    for (const TriangleEdge side : edges_.at(edge_key(a, b))) {
      if (side.triangle == t)
        continue;
      const bool same_direction = edge_vertices(mesh_.triangles[side.triangle], side.edge).first == a;
      const int expected = same_direction ? -sign_[t] : sign_[t];
      if (sign_[side.triangle] == 0) {
        sign_[side.triangle] = expected;
        component.push_back(side.triangle);
      } else if (sign_[side.triangle] != expected) {
        fail_input("{}: the surface has one side only (a Moebius band) at {}; cut it open", where_,
                   corners(mesh_, side.triangle));
      }
    }
  }

  const TriangleMesh& mesh_;
  const EdgeMap& edges_;
  std::string_view where_;
  std::vector<int> sign_;
};

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
  const EdgeMap edges = edge_map(mesh);
  check_manifold(mesh, edges, where);
  OrientationCheck(mesh, edges, where).run();
}

TriangleMesh merge_vertices(const TriangleMesh& mesh, double tolerance)
{
  if (mesh.vertices.empty())
    return mesh;
  const BoundingBox box = bounding_box(mesh.vertices);
  PointIndex placed(box.low, tolerance * box.size());
  TriangleMesh merged;
  for (const auto& t : mesh.triangles) {
    std::array<int, 3> corner{};
    for (int i = 0; i < 3; ++i) {
      const Vec3& x = mesh.vertices[t[i]];
      corner[i] = placed.find(x);
      if (corner[i] < 0) {
        corner[i] = merged.n_vertices();
        placed.add(corner[i], x);
        merged.vertices.push_back(x);
      }
    }
    merged.triangles.push_back(corner);
  }
  return merged;
}

}  // namespace luff::surface
