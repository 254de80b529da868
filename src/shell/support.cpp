// SPDX-License-Identifier: BSD-3-Clause
// How a shell is held.
#include "shell/support.hpp"

#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "shell/edges.hpp"

namespace luff::shell {

namespace {

using surface::Topology;
using surface::TriangleEdge;
using surface::TriangleMesh;

constexpr const char* kind_names[] = {"clamped", "hinged", "symmetry", "fixed"};

/// One support being applied, with what its messages need.
struct Context {
  const TriangleMesh& mesh;
  const Topology& topology;
  const Support& support;
  std::string_view shell;
  int number;

  std::string name() const
  {
    return fmt::format("shell '{}', support {} ({})", shell, number, kind_names[static_cast<int>(support.kind)]);
  }
};

std::vector<char> selected(const Context& c)
{
  if (c.support.vertices.empty())
    fail_input("{}: it selects no vertex; widen its 'where'", c.name());
  std::vector<char> flags(c.mesh.vertices.size(), 0);
  for (const int v : c.support.vertices) {
    if (v < 0 || v >= c.mesh.n_vertices())
      fail_input("{}: vertex {} is not in 0..{}", c.name(), v, c.mesh.n_vertices() - 1);
    flags[v] = 1;
  }
  return flags;
}

bool contains_triangle(const TriangleMesh& mesh, const std::vector<char>& flags)
{
  for (const auto& t : mesh.triangles)
    if (flags[t[0]] && flags[t[1]] && flags[t[2]])
      return true;
  return false;
}

/// In-plane normal of a boundary edge, p = t x N: the mirror that keeps the slope of the reference.
Vec3 in_plane_normal(const TriangleMesh& mesh, TriangleEdge side)
{
  const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
  const Vec3 along = mesh.vertices[b] - mesh.vertices[a];
  return along.cross(surface::unit_normal(mesh, side.triangle)).normalized();
}

/// Normal of the symmetry plane, as given or as the mean over the edges; exactly along an axis.
int symmetry_axis(const Context& c, const std::vector<TriangleEdge>& edges)
{
  Vec3 normal = Vec3::Zero();
  if (c.support.normal)
    normal = *c.support.normal;
  else
    for (const TriangleEdge side : edges)
      normal += in_plane_normal(c.mesh, side);
  if (!(normal.norm() > 0))
    fail_input("{}: it has no boundary edge to find its plane from; give its 'where' as a plane", c.name());
  normal.normalize();
  int axis = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&axis);
  // A given plane must lie along an axis; one found from the edges of a curved shell need only be close to it.
  const double slack = c.support.normal ? 1e-9 : 0.05;
  if (largest < 1 - slack)
    fail_input("{}: its plane has normal [{}, {}, {}]; symmetry planes must be normal to x, y or z; turn the shell",
               c.name(), normal.x(), normal.y(), normal.z());
  return axis;
}

void require_one_plane(const Context& c, int axis)
{
  const double at = c.mesh.vertices[c.support.vertices.front()][axis];
  const double slack = 1e-6 * surface::bounding_box(c.mesh.vertices).size();
  for (const int v : c.support.vertices)
    if (std::abs(c.mesh.vertices[v][axis] - at) > slack)
      fail_input("{}: vertex {} at {} = {} is not in the plane {} = {} of vertex {}", c.name(), v, "xyz"[axis],
                 c.mesh.vertices[v][axis], "xyz"[axis], at, c.support.vertices.front());
}

/// Collects flags and mirrors; a clamp overrides a symmetry on the same edge.
class Builder {
 public:
  explicit Builder(int n_vertices) : held_(3 * static_cast<std::size_t>(n_vertices), 0) {}

  void apply(const Context& c)
  {
    const std::vector<char> flags = selected(c);
    const std::vector<TriangleEdge> edges = boundary_edges(c.mesh, c.topology, c.support.vertices);
    switch (c.support.kind) {
      case SupportKind::Clamped:
        if (edges.empty() && !contains_triangle(c.mesh, flags))
          fail_input(
              "{}: it selects no boundary edge, so there is no slope to keep; use 'hinged' or widen its "
              "'where' to both ends of an edge",
              c.name());
        hold(c, {true, true, true});
        for (const TriangleEdge side : edges)
          mirrors_[{side.triangle, side.edge}] = in_plane_normal(c.mesh, side);
        break;
      case SupportKind::Symmetry: {
        const int axis = symmetry_axis(c, edges);
        require_one_plane(c, axis);
        hold(c, {axis == 0, axis == 1, axis == 2});
        for (const TriangleEdge side : edges)
          mirrors_.try_emplace({side.triangle, side.edge}, Vec3::Unit(axis));
        break;
      }
      case SupportKind::Hinged:
        hold(c, {true, true, true});
        break;
      case SupportKind::Fixed:
        hold(c, c.support.components);
        break;
    }
  }

  Constraints result() const
  {
    Constraints all{held_, {}};
    for (const auto& [side, normal] : mirrors_)
      all.mirrors.push_back({{side.first, side.second}, normal});
    return all;
  }

 private:
  void hold(const Context& c, std::array<bool, 3> components)
  {
    for (const int v : c.support.vertices)
      for (int d = 0; d < 3; ++d)
        if (components[d])
          held_[3 * static_cast<std::size_t>(v) + d] = 1;
  }

  std::vector<char> held_;
  std::map<std::pair<int, int>, Vec3> mirrors_;
};

}  // namespace

Constraints constraints(const TriangleMesh& mesh, const Topology& topology, std::span<const Support> supports,
                        std::string_view shell)
{
  Builder builder(mesh.n_vertices());
  // Clamps last, so that they override.
  for (const bool clamps : {false, true})
    for (std::size_t s = 0; s < supports.size(); ++s)
      if ((supports[s].kind == SupportKind::Clamped) == clamps)
        builder.apply({mesh, topology, supports[s], shell, static_cast<int>(s) + 1});
  return builder.result();
}

}  // namespace luff::shell
