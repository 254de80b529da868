// SPDX-License-Identifier: BSD-3-Clause
// From a layout to triangles on a surface.
#include "surface/pattern.hpp"

#include <cmath>

#include "core/error.hpp"
#include "surface/relaxation.hpp"

namespace luff::surface {

namespace {

void check(const Layout& layout, const Cut& cut, std::string_view shape)
{
  if (!(cut.displacement >= 0 && cut.displacement < 0.45))
    fail_input("{}: displacement = {} must be in [0, 0.45): beyond it triangles turn over", shape, cut.displacement);
  if (cut.pattern == Pattern::Alternating && layout.quadrilaterals.empty())
    fail_input("{}: pattern = \"alternating\" needs rows and columns; about a pole take another one", shape);
}

TriangleMesh placed(const Layout& layout, const ParametricSurface& surface, const Cut& cut, Random& random)
{
  TriangleMesh mesh;
  for (const Node& node : layout.nodes) {
    double u = node.u, v = node.v;
    if (node.inner && cut.pattern == Pattern::Irregular) {
      u += cut.displacement * random.symmetric() * node.du;
      v += cut.displacement * random.symmetric() * node.dv;
    }
    mesh.vertices.push_back(surface.point(u, v));
  }
  return mesh;
}

bool along_first_diagonal(const Cut& cut, const Node& node, Random& random)
{
  switch (cut.pattern) {
    case Pattern::Alternating:
      return (static_cast<long>(node.u) + static_cast<long>(node.v)) % 2 == 0;
    case Pattern::Irregular:
      return random.symmetric() > 0;
    case Pattern::Diagonal:
    case Pattern::Delaunay:
      break;
  }
  return true;
}

void join(const Layout& layout, const Cut& cut, Random& random, TriangleMesh& mesh)
{
  mesh.triangles = layout.triangles;
  for (const auto& [p, q, r, s] : layout.quadrilaterals) {
    if (along_first_diagonal(cut, layout.nodes[p], random)) {
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({p, r, s});
    } else {
      mesh.triangles.push_back({p, q, s});
      mesh.triangles.push_back({q, r, s});
    }
  }
}

}  // namespace

void check_grading(std::string_view shape, const std::array<double, 2>& grading, Pattern pattern)
{
  for (const double growth : grading)
    if (!(growth > 0) || !std::isfinite(growth))
      fail_input("{}: grading = [{}, {}] must be two numbers > 0", shape, grading[0], grading[1]);
  if (pattern == Pattern::Delaunay && (grading[0] != 1 || grading[1] != 1))
    fail_input("{}: grading = [{}, {}] goes with every pattern but \"delaunay\", which spreads vertices evenly", shape,
               grading[0], grading[1]);
}

ParametricSurface plane(std::function<Vec3(double, double)> point, const Vec3& origin, const Vec3& normal)
{
  const Vec3 n = normal.normalized();
  return {std::move(point), [origin, n](const Vec3& x) -> Vec3 { return x - n.dot(x - origin) * n; },
          [n](const Vec3&) { return n; }};
}

namespace {

std::vector<EdgeKey> edges_along(const Side& side)
{
  std::vector<EdgeKey> edges;
  for (std::size_t n = 1; n < side.nodes.size(); ++n)
    edges.push_back(edge_key(side.nodes[n - 1], side.nodes[n]));
  if (side.closed)
    edges.push_back(edge_key(side.nodes.back(), side.nodes.front()));
  return edges;
}

Sets named_sides(const Layout& layout, const TriangleMesh& mesh, const SideNames& names)
{
  Sets sets;
  for (const auto& [side, name] : names) {
    const auto found = layout.sides.find(side);
    if (found == layout.sides.end())
      continue;
    if (found->second.nodes.size() == 1)
      sets.vertices[name] = found->second.nodes;
    else
      sets.edges[name] = edges_along(found->second);
  }
  for (const auto& [edge, triangles] : edge_map(mesh))
    if (triangles.size() == 1)
      sets.edges["boundary"].push_back(edge);
  tidy(sets);
  return sets;
}

}  // namespace

MarkedMesh triangulate(const Layout& layout, const ParametricSurface& surface, const Cut& cut, std::string_view shape,
                       const SideNames& side_names)
{
  check(layout, cut, shape);
  Random random(cut.seed);
  TriangleMesh mesh = placed(layout, surface, cut, random);
  join(layout, cut, random, mesh);
  if (cut.pattern == Pattern::Irregular)
    flip_to_delaunay(mesh, surface);
  if (cut.pattern == Pattern::Delaunay) {
    std::vector<bool> inner;
    for (const Node& node : layout.nodes)
      inner.push_back(node.inner);
    spread(mesh, surface, inner, random);
  }
  Sets sets = named_sides(layout, mesh, side_names);
  return {std::move(mesh), {.sets = std::move(sets)}};
}

}  // namespace luff::surface
