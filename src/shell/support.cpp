// SPDX-License-Identifier: BSD-3-Clause
// How a shell is held.
#include "shell/support.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "shell/edges.hpp"

namespace luff::shell {

namespace {

using surface::Topology;
using surface::TriangleEdge;
using surface::TriangleMesh;

constexpr const char* kind_names[] = {"clamped", "hinged", "symmetry", "fixed", "elastic"};

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

/// Vertices within this fraction of the mesh's size of a plane are in it.
constexpr double in_plane = 1e-6;

double size_of(const Context& c)
{
  return bounding_box(c.mesh.vertices).size();
}

void check_vertices(const Context& c)
{
  if (c.support.vertices.empty())
    fail_input("{}: it selects no vertex; widen its 'where'", c.name());
  for (const int v : c.support.vertices)
    if (v < 0 || v >= c.mesh.n_vertices())
      fail_input("{}: vertex {} is not in 0..{}", c.name(), v, c.mesh.n_vertices() - 1);
}

std::vector<char> selected(const Context& c)
{
  std::vector<char> flags(c.mesh.vertices.size(), 0);
  for (const int v : c.support.vertices)
    flags[v] = 1;
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

bool is_flat(const TriangleMesh& mesh)
{
  const Vec3 first = surface::unit_normal(mesh, 0);
  for (int t = 1; t < mesh.n_triangles(); ++t)
    if (surface::unit_normal(mesh, t).cross(first).norm() > in_plane)
      return false;
  return true;
}

/// A straight edge doesn't tell the plane of a curved shell: its triangles meet it only nearly at a right angle. The
/// axis that is near is meant.
Vec3 axis_near(const Context& c, const Vec3& normal)
{
  constexpr double slack = 0.05;
  int axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) < (1 - slack) * normal.norm())
    fail_input("{}: a straight edge of a curved shell doesn't tell its plane; give its 'where' as a plane", c.name());
  return Vec3::Unit(axis);
}

/// Normal of the plane that the vertices of a symmetry are in: the mean over its edges, made normal to what the
/// vertices span, so that edges of a curved shell, whose triangles meet the plane only nearly at a right angle, do as
/// well.
Vec3 fitted_normal(const Context& c, const std::vector<TriangleEdge>& edges)
{
  Vec3 mean = Vec3::Zero();
  for (const TriangleEdge side : edges)
    mean += in_plane_normal(c.mesh, side);
  if (!(mean.norm() > 0))
    fail_input("{}: it has no boundary edge to find its plane from; give its 'where' as a plane", c.name());
  Eigen::Matrix<double, 3, Eigen::Dynamic> from_first(3, c.support.vertices.size());
  for (std::size_t i = 0; i < c.support.vertices.size(); ++i)
    from_first.col(i) = c.mesh.vertices[c.support.vertices[i]] - c.mesh.vertices[c.support.vertices.front()];
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(from_first, Eigen::ComputeFullU);
  const auto& span = svd.singularValues();
  int dimensions = 0;
  for (int i = 0; i < std::min<int>(2, static_cast<int>(span.size())); ++i)
    if (span[i] > in_plane * std::sqrt(static_cast<double>(from_first.cols())) * size_of(c)) {
      mean -= svd.matrixU().col(i).dot(mean) * svd.matrixU().col(i);
      ++dimensions;
    }
  return dimensions == 2 || is_flat(c.mesh) ? mean : axis_near(c, mean);
}

/// Normal of the symmetry plane, as given or as fitted; exactly along an axis where it is nearly so.
Vec3 symmetry_normal(const Context& c, const std::vector<TriangleEdge>& edges)
{
  Vec3 normal = c.support.normal ? *c.support.normal : fitted_normal(c, edges);
  if (!(normal.norm() > (c.support.normal ? 0 : in_plane * static_cast<double>(edges.size()))))
    fail_input("{}: its plane has no normal: the edges selected are not in one plane", c.name());
  normal.normalize();
  int axis = 0;
  constexpr double round_off = 1e-9;
  if (normal.cwiseAbs().maxCoeff(&axis) > 1 - round_off)
    normal = Vec3::Unit(axis);
  return normal;
}

void require_one_plane(const Context& c, const Vec3& normal)
{
  const Vec3& first = c.mesh.vertices[c.support.vertices.front()];
  for (const int v : c.support.vertices) {
    const double distance = normal.dot(c.mesh.vertices[v] - first);
    if (std::abs(distance) > in_plane * size_of(c))
      fail_input("{}: vertex {} is {:.3g} away from the plane through vertex {} with normal [{:.6g}, {:.6g}, {:.6g}]",
                 c.name(), v, std::abs(distance), c.support.vertices.front(), normal.x(), normal.y(), normal.z());
  }
}

/// What holds one vertex.
struct VertexHold {
  std::array<bool, 3> component{false, false, false};
  std::array<int, 3> motion{-1, -1, -1};  ///< of each component, -1: at rest
  std::vector<Vec3> normals;              ///< held directions that are no axes
};

/// Orthonormal directions, in columns, that span all that holds the vertex.
Eigen::Matrix<double, 3, Eigen::Dynamic> held_directions(const VertexHold& hold)
{
  std::vector<Vec3> directions = hold.normals;
  for (int d = 0; d < 3; ++d)
    if (hold.component[d])
      directions.insert(directions.begin(), Vec3::Unit(d));
  Eigen::Matrix<double, 3, Eigen::Dynamic> basis(3, 0);
  constexpr double parallel = 1e-6;
  for (Vec3 n : directions) {
    n -= (basis * (basis.transpose() * n)).eval();
    if (n.norm() < parallel)
      continue;
    basis.conservativeResize(3, basis.cols() + 1);
    basis.rightCols<1>() = n.normalized();
  }
  return basis;
}

/// Collects what holds each vertex, mirrors and springs; a clamp overrides a symmetry on the same edge, and a support
/// that moves one that rests.
class Builder {
 public:
  explicit Builder(int n_vertices) : holds_(n_vertices) {}

  void apply(const Context& c)
  {
    if (c.support.motion && (c.support.kind == SupportKind::Symmetry || c.support.kind == SupportKind::Elastic))
      fail_input("{}: it has a motion, but only clamped, hinged and fixed supports move", c.name());
    check_vertices(c);
    const std::vector<TriangleEdge> edges = boundary_edges(c.mesh, c.topology, c.support.vertices);
    const int motion = add_motion(c.support);
    switch (c.support.kind) {
      case SupportKind::Clamped:
        clamp(c, edges, motion);
        break;
      case SupportKind::Symmetry:
        mirror(c, edges);
        break;
      case SupportKind::Hinged:
        hold(c, {true, true, true}, motion);
        break;
      case SupportKind::Fixed:
        hold(c, c.support.components, motion);
        break;
      case SupportKind::Elastic:
        suspend(c, edges);
        break;
    }
  }

  Constraints result(const TriangleMesh& mesh, std::string_view shell)
  {
    for (int v = 0; v < static_cast<int>(holds_.size()); ++v)
      finish(v, holds_[v], mesh, shell);
    for (const auto& [side, edge] : mirrors_)
      all_.mirrors.push_back(edge);
    return std::move(all_);
  }

 private:
  int add_motion(const Support& support)
  {
    if (!support.motion)
      return -1;
    all_.held.motions.push_back(*support.motion);
    return static_cast<int>(all_.held.motions.size()) - 1;
  }

  void clamp(const Context& c, const std::vector<TriangleEdge>& edges, int motion)
  {
    if (edges.empty() && !contains_triangle(c.mesh, selected(c)))
      fail_input(
          "{}: it selects no boundary edge, so there is no slope to keep; use 'hinged' or widen its "
          "'where' to both ends of an edge",
          c.name());
    hold(c, {true, true, true}, motion);
    for (const TriangleEdge side : edges)
      mirrors_[{side.triangle, side.edge}] = {side, in_plane_normal(c.mesh, side), motion};
  }

  void mirror(const Context& c, const std::vector<TriangleEdge>& edges)
  {
    const Vec3 normal = symmetry_normal(c, edges);
    require_one_plane(c, normal);
    const std::array<bool, 3> along{std::abs(normal.x()) == 1, std::abs(normal.y()) == 1, std::abs(normal.z()) == 1};
    hold(c, along, -1);
    if (!along[0] && !along[1] && !along[2])
      for (const int v : c.support.vertices)
        holds_[v].normals.push_back(normal);
    for (const TriangleEdge side : edges)
      mirrors_.try_emplace({side.triangle, side.edge}, MirrorEdge{side, normal});
  }

  void hold(const Context& c, std::array<bool, 3> components, int motion)
  {
    for (const int v : c.support.vertices)
      for (int d = 0; d < 3; ++d) {
        if (!components[d])
          continue;
        VertexHold& here = holds_[v];
        here.component[d] = true;
        if (motion < 0)
          continue;
        if (here.motion[d] >= 0)
          fail_input("{}: vertex {} already moves along {} with another support", c.name(), v, "xyz"[d]);
        here.motion[d] = motion;
      }
  }

  void suspend(const Context& c, const std::vector<TriangleEdge>& edges)
  {
    const Support& s = c.support;
    if (!((s.stiffness.array() >= 0).all() && s.turning_stiffness >= 0 && s.stiffness.allFinite()) ||
        !(s.stiffness.norm() + s.turning_stiffness > 0))
      fail_input("{}: stiffness = [{}, {}, {}] and turning_stiffness = {} must be at least 0, and one of them greater",
                 c.name(), s.stiffness.x(), s.stiffness.y(), s.stiffness.z(), s.turning_stiffness);
    if (s.turning_stiffness > 0 && edges.empty())
      fail_input("{}: it selects no boundary edge that could turn; widen its 'where' to both ends of one", c.name());
    const std::vector<double> share = shares(c.mesh, c.topology, s.vertices);
    if (s.stiffness.norm() > 0)
      for (std::size_t i = 0; i < share.size(); ++i)
        all_.springs.on_vertices.push_back({s.vertices[i], share[i] * s.stiffness});
    if (s.turning_stiffness > 0)
      for (const TriangleEdge side : edges) {
        const EdgeTurn turn(c.mesh, side);
        all_.springs.on_edges.push_back({turn, turn.length() * s.turning_stiffness});
      }
  }

  /// Flags where all that holds a vertex is along axes, a projector where it isn't.
  void finish(int v, const VertexHold& hold, const TriangleMesh& mesh, std::string_view shell)
  {
    std::array<bool, 3> flags = hold.component;
    if (!hold.normals.empty()) {
      const auto directions = held_directions(hold);
      if (directions.cols() == 3)
        flags = {true, true, true};
      else {
        flags = {false, false, false};
        all_.held.oblique.push_back({v, Mat3::Identity() - directions * directions.transpose()});
      }
      const Vec3 at = mesh.vertices[v];
      for (int d = 0; d < 3; ++d)
        if (flags[d] != hold.component[d] && *std::max_element(hold.motion.begin(), hold.motion.end()) >= 0)
          fail_input(
              "shell '{}': vertex {} at ({:.6g}, {:.6g}, {:.6g}) moves with a support in some components only and is "
              "in an oblique plane of symmetry; prescribe all three",
              shell, v, at.x(), at.y(), at.z());
    }
    for (int d = 0; d < 3; ++d)
      all_.held.flags.push_back(flags[d] ? 1 : 0);
    for (int m = 0; m < static_cast<int>(all_.held.motions.size()); ++m) {
      const std::array<bool, 3> with{hold.motion[0] == m, hold.motion[1] == m, hold.motion[2] == m};
      if (with[0] || with[1] || with[2])
        all_.held.moved.push_back({v, with, m});
    }
  }

  std::vector<VertexHold> holds_;
  std::map<std::pair<int, int>, MirrorEdge> mirrors_;
  Constraints all_;
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
  return builder.result(mesh, shell);
}

}  // namespace luff::shell
