// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/build_mesh.hpp"

#include "surface/generators.hpp"
#include "surface/readers.hpp"

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

surface::TriangleMesh rectangle(const config::MeshOptions& mesh)
{
  return surface::rectangle({.origin = mesh.origin,
                             .a = mesh.a,
                             .b = mesh.b,
                             .divisions = mesh.divisions,
                             .pattern = pattern_of(mesh.pattern),
                             .seed = static_cast<unsigned>(mesh.seed)});
}

surface::TriangleMesh disk(const config::MeshOptions& mesh)
{
  return surface::disk({.frame = frame_of(mesh),
                        .radius = mesh.radius,
                        .angle = sector_of(mesh.angle),
                        .rings = mesh.rings,
                        .pattern = pattern_of(mesh.pattern),
                        .seed = static_cast<unsigned>(mesh.seed)});
}

surface::TriangleMesh annulus(const config::MeshOptions& mesh)
{
  return surface::annulus({.frame = frame_of(mesh),
                           .inner_radius = mesh.inner_radius,
                           .radius = mesh.radius,
                           .angle = sector_of(mesh.angle),
                           .divisions = mesh.divisions,
                           .pattern = pattern_of(mesh.pattern),
                           .seed = static_cast<unsigned>(mesh.seed)});
}

surface::TriangleMesh cylinder(const config::MeshOptions& mesh)
{
  return surface::cylinder({.frame = frame_of(mesh),
                            .radius = mesh.radius,
                            .length = mesh.length,
                            .angle = sector_of(mesh.angle),
                            .divisions = mesh.divisions,
                            .pattern = pattern_of(mesh.pattern),
                            .seed = static_cast<unsigned>(mesh.seed)});
}

surface::TriangleMesh sphere_cap(const config::MeshOptions& mesh)
{
  return surface::sphere_cap({.frame = frame_of(mesh),
                              .radius = mesh.radius,
                              .polar = sector_of(mesh.polar),
                              .angle = sector_of(mesh.angle),
                              .rings = mesh.rings,
                              .divisions = mesh.divisions,
                              .pattern = pattern_of(mesh.pattern),
                              .seed = static_cast<unsigned>(mesh.seed)});
}

}  // namespace

surface::TriangleMesh build_unplaced(const config::MeshOptions& mesh)
{
  if (mesh.file)
    return surface::read_mesh(*mesh.file);
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

}  // namespace luff::simulation
