// SPDX-License-Identifier: BSD-3-Clause
#include <functional>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "simulation/build.hpp"
#include "simulation/build_body.hpp"
#include "simulation/build_mesh.hpp"
#include "simulation/build_material.hpp"
#include "simulation/refusal.hpp"
#include "simulation/still_run.hpp"
#include "surface/selection.hpp"

namespace luff::simulation {

namespace {

surface::Where where_of(const config::WhereOptions& where)
{
  if (where.edge)
    return surface::EdgeWhere{(*where.edge)[0], (*where.edge)[1]};
  if (where.box)
    return surface::BoxWhere{(*where.box)[0], (*where.box)[1]};
  if (where.plane)
    return surface::PlaneWhere{where.plane->point, where.plane->normal};
  if (where.set)
    return surface::SetWhere{*where.set};
  if (where.all)
    return surface::AllWhere{};
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
          .lumped_mass = options.mass == config::MassMatrix::Lumped,
          .membrane = options.membrane == config::MembraneElement::Smoothed ? shell::MembraneKind::Smoothed
                                                                            : shell::MembraneKind::ConstantStrain,
          .damping_mass = options.damping.mass,
          .damping_stiffness = options.damping.stiffness,
          .gravity = options.gravity};
}

shell::Support support_of(const config::SupportOptions& options, const surface::MarkedMesh& marked,
                          const std::string& what)
{
  shell::Support support;
  support.vertices = refusing_at(options.mark, [&] {
    return surface::select_vertices(marked.mesh, where_of(options.where), what, marked.marks.sets);
  });
  if (options.motion)
    support.motion = build_motion(options.motion->translation, options.motion->rotation);
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
      if (options.where.plane)
        support.normal = options.where.plane->normal;
      break;
    case config::SupportType::Elastic:
      support.kind = shell::SupportKind::Elastic;
      support.stiffness = options.stiffness;
      support.turning_stiffness = options.turning_stiffness;
      break;
  }
  return support;
}

shell::Load load_of(const config::LoadOptions& options, const surface::MarkedMesh& marked, const std::string& what)
{
  const surface::Where where = where_of(options.where);
  const std::vector<int> vertices = surface::select_vertices(marked.mesh, where, what, marked.marks.sets);
  if (options.force) {
    // The file gives the total force; a PointForce shares what its function returns among the vertices.
    return shell::PointForce{vertices, [f = *options.force](const Vec3& x, double t) { return f.evaluate(x, t); }};
  }
  if (options.edge_force)
    return shell::EdgeForce{vertices, [q = *options.edge_force](const Vec3& x, double t) { return q.evaluate(x, t); }};
  if (options.edge_moment)
    return shell::EdgeMoment{vertices,
                             [m = *options.edge_moment](const Vec3& x, double t) { return m.evaluate(x, t); }};
  const std::vector<int> triangles = surface::select_triangles(marked.mesh, where, what, marked.marks.sets);
  if (options.pressure)
    return shell::Pressure{triangles, [p = *options.pressure](const Vec3& x, double t) { return p.evaluate(x, t); }};
  return shell::Traction{triangles,
                         [s = options.traction.value()](const Vec3& x, double t) { return s.evaluate(x, t); }};
}

shell::Piece build_piece(const config::ShellOptions& options, const surface::MarkedMesh& marked)
{
  const std::string owner = fmt::format("shell '{}'", options.name);
  shell::Piece piece{.reference = marked.mesh, .properties = properties_of(options), .name = options.name};
  for (std::size_t n = 0; n < options.supports.size(); ++n)
    piece.supports.push_back(support_of(options.supports[n], marked, fmt::format("{}, support {}", owner, n + 1)));
  piece.fibres = build_fibres(options, marked);
  return piece;
}

/// The loads of one shell, in its own numbering.
std::vector<shell::Load> build_loads(const config::ShellOptions& options, const surface::MarkedMesh& marked)
{
  std::vector<shell::Load> loads;
  for (std::size_t n = 0; n < options.loads.size(); ++n)
    loads.push_back(refusing_at(options.loads[n].mark, [&] {
      return load_of(options.loads[n], marked, fmt::format("shell '{}', load {}", options.name, n + 1));
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
    surface::MarkedMesh marked =
        build_mesh(shell_options.mesh, shell_options.placement, fmt::format("shell '{}'", shell_options.name));
    shell::Piece piece = build_piece(shell_options, marked);
    // What is wrong with a piece is told with its own place in the file.
    refusing_at(shell_options.mark, [&] { (void)shell::Shell({piece}); });
    for (const shell::Load& load : build_loads(shell_options, marked))
      result.loads.push_back(shell::renumbered(load, first_vertex, first_triangle));
    first_vertex += piece.reference.n_vertices();
    first_triangle += piece.reference.n_triangles();
    pieces.push_back(std::move(piece));
    result.marks.push_back(std::move(marked.marks));
  }
  result.shell = std::make_unique<shell::Shell>(std::move(pieces));
  return result;
}

namespace {

/// Without numerical damping the acceleration of a shell that is much lighter than the fluid keeps a sawtooth from step
/// to step (docs/numerics/coupling.md).
shell::TimeScheme scheme_of(const config::StructureOptions& structure, bool in_flow)
{
  switch (structure.scheme) {
    case config::StructureScheme::GeneralisedAlpha:
      return shell::TimeScheme::generalised_alpha(structure.rho_inf);
    case config::StructureScheme::Midpoint:
      return shell::TimeScheme::midpoint();
    case config::StructureScheme::Auto:
      if (in_flow)
        return shell::TimeScheme::generalised_alpha(structure.rho_inf);
      break;
    case config::StructureScheme::Newmark:
      break;
  }
  return shell::TimeScheme::newmark(structure.numerical_damping);
}

/// The bodies as contact sees them, and where they are at a time, or at a load factor.
shell::ContactOptions contact_of(const config::ContactOptions& options, const std::vector<RigidSheet>& rigid,
                                 const std::function<Vec3(const RigidSheet&, const Vec3& x_0, double t)>& place)
{
  shell::ContactOptions contact;
  contact.law = {.distance = options.distance, .stiffness = options.stiffness, .self = options.self};
  for (const RigidSheet& sheet : rigid)
    contact.bodies.push_back({sheet.name, sheet.mesh, /*deforms=*/false});
  contact.body_positions = [rigid, place](double t) {
    std::vector<Vec3> positions;
    for (const RigidSheet& sheet : rigid)
      for (const Vec3& x_0 : sheet.mesh.vertices)
        positions.push_back(place(sheet, x_0, t));
    return surface::interleaved(positions);
  };
  return contact;
}

std::vector<RigidSheet> build_rigid_sheets(const config::Case& options)
{
  std::vector<RigidSheet> rigid;
  for (const config::BodyOptions& body : options.bodies)
    rigid.push_back(build_rigid(body, options));
  return rigid;
}

/// Where vertices stay on planes of symmetry.
std::vector<HeldNormal> held_normals(const config::ShellOptions& options, const surface::MarkedMesh& marked)
{
  std::vector<HeldNormal> held;
  for (std::size_t n = 0; n < options.supports.size(); ++n) {
    const config::SupportOptions& support = options.supports[n];
    if (support.type != config::SupportType::Symmetry || !support.where.plane)
      continue;
    for (const int v : surface::select_vertices(marked.mesh, where_of(support.where), options.name, marked.marks.sets))
      held.push_back({.vertex = v, .plane = static_cast<int>(n), .normal = support.where.plane->normal.normalized()});
  }
  return held;
}

std::vector<std::optional<Skin>> build_skins(const std::vector<config::ShellOptions>& options,
                                             const shell::Shell& shell, const std::vector<surface::Marks>& marks)
{
  std::vector<std::optional<Skin>> skins(options.size());
  for (std::size_t n = 0; n < options.size(); ++n) {
    if (options[n].wetted != config::WettedSurface::Faces)
      continue;
    const surface::MarkedMesh middle{shell.reference_of(shell.pieces()[n]), marks[n]};
    skins[n].emplace(middle, options[n].thickness, held_normals(options[n], middle));
  }
  return skins;
}

Shells build_shells(const config::Case& options, const std::vector<RigidSheet>& rigid)
{
  Shells shells;
  if (options.shells.empty())
    return shells;
  LoadedShell built = build_shell(options.shells);
  shells.shell = std::move(built.shell);
  shells.skins = build_skins(options.shells, *shells.shell, built.marks);
  shells.marks = std::move(built.marks);
  shell::DynamicsOptions dynamics;
  dynamics.scheme = scheme_of(options.structure, options.fluid.has_value());
  // An analysis without time takes no step; any length does for the rates that it doesn't use.
  dynamics.first_step = options.structure.analysis == config::Analysis::Dynamic ? options.time.step : 1.0;
  dynamics.fold_limit = options.structure.fold_limit;
  dynamics.linear_solver = build_solver(options.structure.solver);
  if (options.contact)
    dynamics.contact = contact_of(*options.contact, rigid, [](const RigidSheet& sheet, const Vec3& x_0, double t) {
      return sheet.motion.position(x_0, t);
    });
  shells.dynamics = refusing_at(options.contact ? options.contact->mark : config::Mark{}, [&] {
    return std::make_unique<shell::Dynamics>(*shells.shell, built.loads, dynamics);
  });
  return shells;
}

}  // namespace

shell::ControlledDisplacement build_control(const config::ControlOptions& options, const shell::Shell& shell)
{
  return refusing_at(options.mark, [&] {
    const shell::ControlledDisplacement control{
        surface::select_vertices(shell.reference(), where_of(options.where), "structure.control"),
        static_cast<int>(options.component), options.displacement};
    shell::check_controllable(shell, control);
    return control;
  });
}

shell::ContactOptions build_static_contact(const config::Case& options)
{
  return contact_of(options.contact.value(), build_rigid_sheets(options),
                    [](const RigidSheet& sheet, const Vec3& x_0, double factor) {
                      return sheet.motion.position(x_0, end_of_loading, factor);
                    });
}

shell::LinearSolverKind build_solver(config::StructureSolver solver)
{
  switch (solver) {
    case config::StructureSolver::Cg:
      return shell::LinearSolverKind::ConjugateGradients;
    case config::StructureSolver::CgIc:
      return shell::LinearSolverKind::CgIncompleteCholesky;
    case config::StructureSolver::Direct:
      break;
  }
  return shell::LinearSolverKind::Direct;
}

std::unique_ptr<Structure> build_structure(const config::Case& options)
{
  std::vector<RigidSheet> rigid = build_rigid_sheets(options);
  Shells shells = build_shells(options, rigid);
  return std::make_unique<Structure>(std::move(shells), std::move(rigid));
}

}  // namespace luff::simulation
