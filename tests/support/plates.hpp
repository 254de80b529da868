// SPDX-License-Identifier: BSD-3-Clause
// A plate of length 1 in a slab of fluid one cell wide.
#pragma once

#include "grid/axis.hpp"
#include "support/flow.hpp"
#include "surface/generators.hpp"

namespace luff::test {

/// A flat plate through `centre`, turned about z, as wide as the slab; it moves at constant velocity.
struct Plate {
  double degrees = 0.0;
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  int divisions = 25;

  [[nodiscard]] immersed::SheetMotion at(double t, double depth) const
  {
    surface::TriangleMesh mesh = surface::rectangle(
        {.origin = {-0.5, 0.0, 0.0}, .a = Vec3::UnitX(), .b = depth * Vec3::UnitZ(), .divisions = {divisions, 1}});
    surface::rotate(mesh, Vec3::UnitZ(), degrees);
    surface::translate(mesh, centre + t * velocity);
    const std::size_t n = mesh.vertices.size();
    return {mesh.vertices, std::vector<Vec3>(n, velocity), std::vector<Vec3>(n, Vec3::Zero()), mesh.triangles};
  }
};

/// A slab one cell deep; a stream along x from x_min to x_max, or fluid at rest where it is zero.
struct Slab {
  grid::AxisSpec x;
  grid::AxisSpec y;
  double depth = 0.1;
  double stream = 1.0;
  double viscosity = 0.01;
  fluid::SideKind z_sides = fluid::SideKind::Symmetry;
};

inline std::unique_ptr<TestFlow> make_flow(const Slab& slab, MPI_Comm comm, const fluid::FlowOptions& options)
{
  using fluid::SideBoundary;
  using fluid::SideKind;
  const auto stream = fluid::VectorFunction::uniform({slab.stream, 0.0, 0.0});
  const SideBoundary slip{.kind = SideKind::Slip};
  const SideBoundary z_side{.kind = slab.z_sides};
  const fluid::Boundaries sides{{{SideBoundary{SideKind::Velocity, stream}, SideBoundary{.kind = SideKind::Outflow}},
                                 {slip, slip},
                                 {z_side, z_side}}};
  auto flow = std::make_unique<TestFlow>(std::array{grid::face_coordinates(slab.x, "x"),
                                                    grid::face_coordinates(slab.y, "y"), std::vector{0.0, slab.depth}},
                                         sides, options, comm);
  flow->solver.start(stream, 0.0);
  return flow;
}

inline std::unique_ptr<TestFlow> make_flow(const Slab& slab, MPI_Comm comm = MPI_COMM_WORLD)
{
  return make_flow(slab, comm, {.viscosity = slab.viscosity});
}

/// Drag and lift coefficients F/(1/2 rho U^2 L depth), U = L = 1, of a force on the plate.
inline Vec3 coefficients(const Vec3& force, double depth)
{
  return force / (0.5 * depth);
}

inline Vec3 total_force(const immersed::SheetLoads& loads)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t v = 0; v < loads.plus.size(); ++v)
    sum += loads.force(v);
  return sum;
}

}  // namespace luff::test
