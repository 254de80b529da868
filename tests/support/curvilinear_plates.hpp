// SPDX-License-Identifier: BSD-3-Clause
// Slabs of fluid on curvilinear grids.
#pragma once

#include "support/curvilinear.hpp"
#include "support/plates.hpp"

namespace luff::test {

/// Where a node of a Cartesian grid is moved to.
using Deformation = Vec3 (*)(const Vec3&);

inline Vec3 undeformed(const Vec3& x)
{
  return x;
}

/// Grid lines turned by up to 28 degrees along x and 22 along y around the origin, straight far away; angles between
/// them down to 45 degrees.
inline Vec3 skewed_around_origin(const Vec3& x)
{
  const double fade = std::exp(-(x[0] * x[0] + x[1] * x[1]) / 2.25);
  return {x[0] + 0.53 * x[1] * fade, x[1] + 0.4 * x[0] * fade, x[2]};
}

/// The flow of make_flow(slab) on a grid whose nodes are those of the slab's, deformed; left-handed if asked for.
inline std::unique_ptr<TestFlow> make_curvilinear_flow(const Slab& slab, Deformation deformed,
                                                       const fluid::FlowOptions& options,
                                                       MPI_Comm comm = MPI_COMM_WORLD)
{
  using fluid::SideBoundary;
  using fluid::SideKind;
  const auto stream = fluid::VectorFunction::uniform({slab.stream, 0.0, 0.0});
  const SideBoundary slip{.kind = SideKind::Slip};
  const SideBoundary symmetry{.kind = SideKind::Symmetry};
  const fluid::Boundaries sides{{{SideBoundary{SideKind::Velocity, stream}, SideBoundary{.kind = SideKind::Outflow}},
                                 {slip, slip},
                                 {symmetry, symmetry}}};
  const std::vector<double> x = grid::face_coordinates(slab.x, "x");
  const std::vector<double> y = grid::face_coordinates(slab.y, "y");
  const Index3 cells{static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1, 1};
  auto flow = std::make_unique<TestFlow>(cells, grid::node_source([=](int i, int j, int k) -> Vec3 {
                                           return deformed({x[i], y[j], k * slab.depth});
                                         }),
                                         sides, options, comm);
  flow->solver.start(stream, 0.0);
  return flow;
}

}  // namespace luff::test
