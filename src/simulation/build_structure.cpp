// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "simulation/build.hpp"
#include "simulation/build_mesh.hpp"
#include "simulation/build_material.hpp"
#include "simulation/refusal.hpp"
#include "surface/generators.hpp"
#include "surface/selection.hpp"
#include "surface/validation.hpp"

namespace luff::simulation {

namespace {

surface::TriangleMesh placed_mesh(const config::MeshOptions& mesh, const config::PlacementOptions& placement,
                                  const std::string& owner)
{
  surface::TriangleMesh result = build_unplaced(mesh);
  surface::scale(result, Vec3::Constant(placement.scale));
  if (placement.rotate)
    surface::rotate(result, placement.rotate->axis, placement.rotate->angle, placement.rotate->about);
  surface::translate(result, placement.translate);
  surface::validate(result, owner);
  return result;
}

surface::Where where_of(const config::WhereOptions& where)
{
  if (where.edge)
    return surface::EdgeWhere{(*where.edge)[0], (*where.edge)[1]};
  if (where.box)
    return surface::BoxWhere{(*where.box)[0], (*where.box)[1]};
  if (where.plane)
    return surface::PlaneWhere{where.plane->point, where.plane->normal};
  return surface::PointWhere{where.point.value()};
}

shell::BendingKind bending_of(config::BendingElement bending)
{
  switch (bending) {
    case config::BendingElement::Patch4:
      return shell::BendingKind::PatchQuadratic;
    case config::BendingElement::Hinge:
      return shell::BendingKind::Hinge;
    case config::BendingElement::Qavg:
      break;
  }
  return shell::BendingKind::AveragedQuadratics;
}

shell::Properties properties_of(const config::ShellOptions& options)
{
  return {.thickness = options.thickness,
          .density = options.density,
          .material = build_material(options.material),
          .thickness_points = options.material.thickness_points.value_or(0),
          .bending = bending_of(options.bending),
          .damping_mass = options.damping.mass,
          .damping_stiffness = options.damping.stiffness,
          .gravity = options.gravity};
}

shell::Support support_of(const config::SupportOptions& options, const surface::TriangleMesh& mesh,
                          const std::string& what)
{
  shell::Support support;
  support.vertices =
      refusing_at(options.mark, [&] { return surface::select_vertices(mesh, where_of(options.where), what); });
  if (options.fixed) {
    support.kind = shell::SupportKind::Fixed;
    support.components = {false, false, false};
    for (const config::Component c : *options.fixed)
      support.components[static_cast<int>(c)] = true;
    return support;
  }
  switch (options.type.value()) {
    case config::SupportType::Clamped:
      support.kind = shell::SupportKind::Clamped;
      break;
    case config::SupportType::Hinged:
      support.kind = shell::SupportKind::Hinged;
      break;
    case config::SupportType::Symmetry:
      support.kind = shell::SupportKind::Symmetry;
      break;
  }
  return support;
}

shell::Load load_of(const config::LoadOptions& options, const surface::TriangleMesh& mesh, const std::string& what)
{
  const std::vector<int> vertices = surface::select_vertices(mesh, where_of(options.where), what);
  if (options.force) {
    // The file gives the total force; a PointForce shares what its function returns among the vertices.
    return shell::PointForce{vertices, [f = *options.force](const Vec3& x, double t) { return f.evaluate(x, t); }};
  }
  if (options.edge_force)
    return shell::EdgeForce{vertices, [q = *options.edge_force](const Vec3& x, double t) { return q.evaluate(x, t); }};
  if (options.edge_moment)
    return shell::EdgeMoment{vertices,
                             [m = *options.edge_moment](const Vec3& x, double t) { return m.evaluate(x, t); }};
  const std::vector<int> triangles = shell::triangles_of(mesh, vertices);
  if (triangles.empty())
    fail_input("{}: no triangle lies wholly in the selection; select more, or give a force", what);
  if (options.pressure)
    return shell::Pressure{triangles, [p = *options.pressure](const Vec3& x, double t) { return p.evaluate(x, t); }};
  return shell::Traction{triangles,
                         [s = options.traction.value()](const Vec3& x, double t) { return s.evaluate(x, t); }};
}

/// x = R(t) (x_0 - about) + about + translation(t)
Vec3 moved(const config::MotionOptions& motion, const Vec3& x_0, double t)
{
  Vec3 x = x_0;
  if (motion.rotation) {
    const double angle = motion.rotation->angle.evaluate(x_0, t) * std::numbers::pi / 180.0;
    x = Eigen::AngleAxisd(angle, motion.rotation->axis.normalized()) * (x_0 - motion.rotation->about) +
        motion.rotation->about;
  }
  return x + motion.translation.evaluate(x_0, t);
}

RigidSheet build_rigid(const config::BodyOptions& options)
{
  RigidSheet sheet{.name = options.name,
                   .mesh = build_mesh(options.mesh, options.placement, fmt::format("body '{}'", options.name)),
                   .position = {},
                   .moves = options.motion.type == config::MotionType::Prescribed};
  sheet.position = [motion = options.motion](const Vec3& x_0, double t) { return moved(motion, x_0, t); };
  return sheet;
}

}  // namespace

surface::TriangleMesh build_mesh(const config::MeshOptions& mesh, const config::PlacementOptions& placement,
                                 const std::string& owner)
{
  return refusing_at(mesh.mark, [&] { return placed_mesh(mesh, placement, owner); });
}

namespace {

shell::Piece build_piece(const config::ShellOptions& options)
{
  const std::string owner = fmt::format("shell '{}'", options.name);
  shell::Piece piece{.reference = build_mesh(options.mesh, options.placement, owner),
                     .properties = properties_of(options),
                     .name = options.name};
  for (std::size_t n = 0; n < options.supports.size(); ++n)
    piece.supports.push_back(
        support_of(options.supports[n], piece.reference, fmt::format("{}, support {}", owner, n + 1)));
  piece.fibres = build_fibres(options, piece.reference);
  return piece;
}

/// The loads of one shell, in its own numbering.
std::vector<shell::Load> build_loads(const config::ShellOptions& options, const surface::TriangleMesh& mesh)
{
  std::vector<shell::Load> loads;
  for (std::size_t n = 0; n < options.loads.size(); ++n)
    loads.push_back(refusing_at(options.loads[n].mark, [&] {
      return load_of(options.loads[n], mesh, fmt::format("shell '{}', load {}", options.name, n + 1));
    }));
  return loads;
}

}  // namespace

LoadedShell build_shell(const std::vector<config::ShellOptions>& options)
{
  LoadedShell result;
  std::vector<shell::Piece> pieces;
  int first_vertex = 0, first_triangle = 0;
  for (const config::ShellOptions& shell_options : options) {
    shell::Piece piece = build_piece(shell_options);
    // What is wrong with a piece is told with its own place in the file.
    refusing_at(shell_options.mark, [&] { (void)shell::Shell({piece}); });
    for (const shell::Load& load : build_loads(shell_options, piece.reference))
      result.loads.push_back(shell::renumbered(load, first_vertex, first_triangle));
    first_vertex += piece.reference.n_vertices();
    first_triangle += piece.reference.n_triangles();
    pieces.push_back(std::move(piece));
  }
  result.shell = std::make_unique<shell::Shell>(std::move(pieces));
  return result;
}

namespace {

Shells build_shells(const config::Case& options)
{
  Shells shells;
  if (options.shells.empty())
    return shells;
  LoadedShell built = build_shell(options.shells);
  shells.shell = std::move(built.shell);
  shell::DynamicsOptions dynamics;
  dynamics.fold_limit = options.structure.fold_limit;
  if (options.structure.solver == config::StructureSolver::Cg)
    dynamics.linear_solver = shell::LinearSolverKind::ConjugateGradients;
  shells.dynamics = std::make_unique<shell::Dynamics>(*shells.shell, built.loads, dynamics);
  return shells;
}

}  // namespace

std::unique_ptr<Structure> build_structure(const config::Case& options)
{
  std::vector<RigidSheet> rigid;
  for (const config::BodyOptions& body : options.bodies)
    rigid.push_back(build_rigid(body));
  return std::make_unique<Structure>(build_shells(options), std::move(rigid));
}

}  // namespace luff::simulation
