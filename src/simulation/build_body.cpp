// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/build_body.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "simulation/build_mesh.hpp"
#include "simulation/check_flow.hpp"
#include "simulation/refusal.hpp"
#include "surface/solid.hpp"
#include "surface/topology.hpp"

namespace luff::simulation {

namespace {

/// Sides of the grid that edges of a mesh lie on, [axis][end].
using Touched = std::array<std::array<bool, 2>, 3>;

double coordinate(const config::AxisOptions& axis, int end)
{
  return end == 0 ? axis.from : axis.to;
}

/// Whether both ends of an edge lie on one side of the grid that sheets may end on; notes the side.
bool lies_on_a_side(const config::Case& all, const Vec3& a, const Vec3& b, Touched& touched)
{
  bool found = false;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const config::AxisOptions& options = all.grid.axes[axis];
      // Vertices on a plane carry the rounding of its coordinate.
      const double rounding = 1e-9 * (options.to - options.from);
      const double plane = coordinate(options, end);
      if (!sheets_may_end_on(all.boundary.sides[2 * axis + end].type) || std::abs(a[axis] - plane) > rounding ||
          std::abs(b[axis] - plane) > rounding)
        continue;
      touched[axis][end] = true;
      found = true;
    }
  return found;
}

/// In a curvilinear grid: the axis that the planes through all edges are normal to, as if they were sides of a box,
/// both of them.  Whether sides of the grid lie there turns out when the grid is made (check_sheets_inside).
Touched planes_of_edges(const surface::TriangleMesh& mesh, const std::string& owner)
{
  const std::vector<surface::TriangleEdge> edges = surface::topology(mesh).boundary;
  Touched touched{};
  if (edges.empty())
    return touched;
  const double rounding = 1e-9 * bounding_box(mesh.vertices).size();
  for (int axis = 0; axis < 3; ++axis)
    if (std::all_of(edges.begin(), edges.end(), [&](const surface::TriangleEdge& edge) {
          const auto [a, b] = surface::edge_vertices(mesh.triangles[edge.triangle], edge.edge);
          return std::abs(mesh.vertices[a][axis] - mesh.vertices[b][axis]) <= rounding;
        })) {
      touched[axis] = {true, true};
      return touched;
    }
  fail_input(
      "{}: declared closed, but its edges don't lie in planes normal to x, y or z; close the mesh (edges may lie on "
      "plane symmetry and slip sides of the grid), or leave `closed` out",
      owner);
}

/// The sides that the mesh's edges lie on.  Throws InputError when some lie on none.
Touched sides_of_edges(const surface::TriangleMesh& mesh, const config::Case& all, const std::string& owner)
{
  if (all.fluid && config::is_curvilinear(all.grid.kind))
    return planes_of_edges(mesh, owner);
  Touched touched{};
  int leaks = 0;
  std::string examples;
  for (const surface::TriangleEdge& edge : surface::topology(mesh).boundary) {
    const auto [a, b] = surface::edge_vertices(mesh.triangles[edge.triangle], edge.edge);
    const Vec3& from = mesh.vertices[a];
    const Vec3& to = mesh.vertices[b];
    if (all.fluid && lies_on_a_side(all, from, to, touched))
      continue;
    constexpr int shown = 3;
    if (leaks++ < shown)
      examples += fmt::format("{}({:.6g}, {:.6g}, {:.6g}) - ({:.6g}, {:.6g}, {:.6g})", leaks == 1 ? "" : ", ", from[0],
                              from[1], from[2], to[0], to[1], to[2]);
  }
  if (leaks > 0)
    fail_input(
        "{}: declared closed, but it leaks through {} edges that have a triangle on one side only: {}{}; close the "
        "mesh (edges may lie on symmetry, slip and periodic sides of the grid), or leave `closed` out",
        owner, leaks, examples, leaks > 3 ? ", ..." : "");
  return touched;
}

/// Volume between the surface and the sides: along an axis that it spans from one side at most.
surface::Solid enclosed(const surface::TriangleMesh& mesh, const config::Case& all, const Touched& touched,
                        const std::string& owner)
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [low, high] = touched[axis];
    if (low && high)
      continue;
    const double plane =
        low || high ? coordinate(all.grid.axes[axis], high ? 1 : 0) : bounding_box(mesh.vertices).low[axis];
    return surface::solid(mesh, {axis, plane});
  }
  fail_input("{}: its edges lie on all six sides of the grid: what is inside cannot be told", owner);
}

Vec3 mean_vertex(const surface::TriangleMesh& mesh)
{
  return std::accumulate(mesh.vertices.begin(), mesh.vertices.end(), Vec3(Vec3::Zero())) / mesh.n_vertices();
}

RigidBodyProperties properties_of(const config::MotionOptions& motion, const RigidSheet& sheet,
                                  const std::optional<surface::Solid>& solid, const std::string& owner)
{
  if (!solid && (motion.density || !motion.centre || !motion.inertia))
    fail_input(
        "{}: only a closed body has a volume, from which `density` gives mass, centre and inertia; give `mass`, "
        "`centre` and `inertia`",
        owner);
  RigidBodyProperties body{.centre = sheet.centre,
                           .stiffness = motion.stiffness,
                           .damping = motion.damping,
                           .turning_stiffness = motion.turning_stiffness,
                           .turning_damping = motion.turning_damping,
                           .gravity = motion.gravity,
                           .velocity = motion.velocity,
                           .spin = motion.spin,
                           .length = bounding_box(sheet.mesh.vertices).size()};
  const double density = motion.density ? *motion.density : solid ? *motion.mass / solid->volume : 0.0;
  body.mass = motion.mass ? *motion.mass : density * solid->volume;
  if (motion.inertia) {
    body.inertia = motion.inertia->asDiagonal();
  } else {
    // About the centre of mass, if that is another place (Steiner).
    const Vec3 r = solid->centroid - sheet.centre;
    body.inertia =
        density * (solid->inertia + solid->volume * (r.squaredNorm() * Mat3::Identity() - r * r.transpose()));
  }
  body.free.fill(false);
  for (const config::Freedom freedom : motion.freedoms)
    body.free[static_cast<int>(freedom)] = true;
  return body;
}

RigidSheet rigid_sheet(const config::BodyOptions& options, const config::Case& all)
{
  const std::string owner = fmt::format("body '{}'", options.name);
  surface::MarkedMesh marked = build_mesh(options.mesh, options.placement, owner);
  const bool edgeless = surface::topology(marked.mesh).boundary.empty();
  RigidSheet sheet{.name = options.name,
                   .mesh = std::move(marked.mesh),
                   .motion = build_motion(options.motion.translation, options.motion.rotation),
                   .moves = options.motion.type == config::MotionType::Prescribed,
                   .marks = std::move(marked.marks),
                   .closed = options.closed.value_or(edgeless)};
  std::optional<surface::Solid> solid;
  if (sheet.closed) {
    const Touched touched = sides_of_edges(sheet.mesh, all, owner);
    solid = enclosed(sheet.mesh, all, touched, owner);
    if (solid->volume < 0.0) {
      surface::reverse(sheet.mesh);
      solid = enclosed(sheet.mesh, all, touched, owner);
    }
  }
  sheet.centre = options.motion.centre ? *options.motion.centre : solid ? solid->centroid : mean_vertex(sheet.mesh);
  if (options.motion.type == config::MotionType::Free)
    sheet.free = RigidBody(properties_of(options.motion, sheet, solid, owner));
  return sheet;
}

}  // namespace

shell::Motion build_motion(const config::VectorExpression& translation,
                           const std::optional<config::RotationOptions>& rotation)
{
  shell::Motion motion;
  motion.translation = [translation](const Vec3& X, double t) { return translation.evaluate(X, t); };
  if (rotation)
    motion.rotation = {rotation->axis, rotation->about, [angle = rotation->angle](double t) {
                         return angle.evaluate(Vec3::Zero(), t) * std::numbers::pi / 180.0;
                       }};
  return motion;
}

RigidSheet build_rigid(const config::BodyOptions& options, const config::Case& all)
{
  return refusing_at(options.mark, [&] { return rigid_sheet(options, all); });
}

}  // namespace luff::simulation
