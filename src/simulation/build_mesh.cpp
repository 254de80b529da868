// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/build_mesh.hpp"

#include "simulation/refusal.hpp"
#include "surface/generators.hpp"
#include "surface/readers.hpp"
#include "surface/validation.hpp"

namespace luff::simulation {

namespace {

surface::Pattern pattern_of(config::MeshPattern pattern)
{
  switch (pattern) {
    case config::MeshPattern::Alternating:
      return surface::Pattern::Alternating;
    case config::MeshPattern::Irregular:
      return surface::Pattern::Irregular;
    case config::MeshPattern::Delaunay:
      return surface::Pattern::Delaunay;
    case config::MeshPattern::Diagonal:
      break;
  }
  return surface::Pattern::Diagonal;
}

surface::Frame frame_of(const config::MeshOptions& mesh)
{
  return {.centre = mesh.centre, .axis = mesh.axis, .start = mesh.start};
}

surface::Sector sector_of(const auto& angles)
{
  return {angles.from, angles.to};
}

surface::Rectangle rectangle(const config::MeshOptions& mesh)
{
  return {.origin = mesh.origin,
          .a = mesh.a,
          .b = mesh.b,
          .divisions = mesh.divisions,
          .grading = mesh.grading,
          .pattern = pattern_of(mesh.pattern),
          .seed = static_cast<unsigned>(mesh.seed)};
}

surface::Disk disk(const config::MeshOptions& mesh)
{
  return {.frame = frame_of(mesh),
          .radius = mesh.radius,
          .angle = sector_of(mesh.angle),
          .rings = mesh.rings,
          .pattern = pattern_of(mesh.pattern),
          .seed = static_cast<unsigned>(mesh.seed)};
}

surface::Annulus annulus(const config::MeshOptions& mesh)
{
  return {.frame = frame_of(mesh),
          .inner_radius = mesh.inner_radius,
          .radius = mesh.radius,
          .angle = sector_of(mesh.angle),
          .divisions = mesh.divisions,
          .pattern = pattern_of(mesh.pattern),
          .seed = static_cast<unsigned>(mesh.seed)};
}

surface::Cylinder cylinder(const config::MeshOptions& mesh)
{
  return {.frame = frame_of(mesh),
          .radius = mesh.radius,
          .length = mesh.length,
          .angle = sector_of(mesh.angle),
          .divisions = mesh.divisions,
          .grading = mesh.grading,
          .pattern = pattern_of(mesh.pattern),
          .seed = static_cast<unsigned>(mesh.seed)};
}

surface::SphereCap sphere_cap(const config::MeshOptions& mesh)
{
  return {.frame = frame_of(mesh),
          .radius = mesh.radius,
          .polar = sector_of(mesh.polar),
          .angle = sector_of(mesh.angle),
          .rings = mesh.rings,
          .divisions = mesh.divisions,
          .grading = mesh.grading,
          .pattern = pattern_of(mesh.pattern),
          .seed = static_cast<unsigned>(mesh.seed)};
}

surface::Shape shape_of(const config::MeshOptions& mesh)
{
  switch (mesh.shape.value()) {
    case config::MeshShape::Rectangle:
      break;
    case config::MeshShape::Disk:
      return disk(mesh);
    case config::MeshShape::Annulus:
      return annulus(mesh);
    case config::MeshShape::Cylinder:
      return cylinder(mesh);
    case config::MeshShape::SphereCap:
      return sphere_cap(mesh);
  }
  return rectangle(mesh);
}

surface::MarkedMesh placed_mesh(const config::MeshOptions& mesh, const config::PlacementOptions& placement,
                                const std::string& owner)
{
  surface::MarkedMesh result =
      mesh.file ? surface::read_mesh(*mesh.file, mesh.repair ? surface::Repair::Yes : surface::Repair::No)
                : surface::make(shape_of(mesh));
  surface::scale(result.mesh, Vec3::Constant(placement.scale));
  if (placement.rotate)
    surface::rotate(result, placement.rotate->axis, placement.rotate->angle, placement.rotate->about);
  surface::translate(result.mesh, placement.translate);
  surface::validate(result.mesh, owner);
  return result;
}

}  // namespace

surface::MarkedMesh build_mesh(const config::MeshOptions& mesh, const config::PlacementOptions& placement,
                               const std::string& owner)
{
  return refusing_at(mesh.mark, [&] { return placed_mesh(mesh, placement, owner); });
}

}  // namespace luff::simulation
