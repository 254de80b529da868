// SPDX-License-Identifier: BSD-3-Clause
// Walls as a surface: whole on the first rank, however many there are.
#include <gtest/gtest.h>

#include "simulation/wall_surface.hpp"
#include "support/flow.hpp"

namespace luff::simulation {
namespace {

using fluid::SideKind;

TEST(WallSurface, OfCouettesFlowCarriesItsShearAndTheWholeOfBothWalls)
{
  constexpr double rho = 3.0;
  constexpr double nu = 0.2;
  const Vec3 lid(1.5, 0.0, -0.5);
  const fluid::SideBoundary periodic{.kind = SideKind::Periodic};
  const fluid::Boundaries sides{{{periodic, periodic},
                                 {fluid::SideBoundary{.kind = SideKind::Wall},
                                  fluid::SideBoundary{SideKind::Wall, fluid::VectorFunction::uniform(lid)}},
                                 {periodic, periodic}}};
  test::TestFlow flow({test::stretched_faces(0.0, 3.0, 6, 0.3), test::stretched_faces(0.0, 2.0, 8, 0.4),
                       test::stretched_faces(0.0, 1.0, 5, -0.2)},
                      sides, {.density = rho, .viscosity = nu});
  flow.solver.start({[&](const Vec3& x, double) -> Vec3 { return 0.5 * x[1] * lid; }, false}, 0.0);
  flow.solver.fill_halos();
  const output::SurfaceSnapshot walls = wall_snapshot(flow.solver, MPI_COMM_WORLD);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {
    EXPECT_TRUE(walls.quadrilaterals.empty());
    return;
  }
  ASSERT_EQ(walls.quadrilaterals.size(), 2u * 6 * 5);
  EXPECT_EQ(walls.points.size(), 2u * 7 * 6);
  const auto& shear = std::get<std::vector<double>>(walls.face_fields[0].values);
  const auto& side = std::get<std::vector<double>>(walls.face_fields[2].values);
  double area = 0.0;
  for (std::size_t n = 0; n < walls.quadrilaterals.size(); ++n) {
    const auto& [a, b, c, d] = walls.quadrilaterals[n];
    area += (walls.points[b] - walls.points[a]).norm() * (walls.points[d] - walls.points[a]).norm();
    ASSERT_TRUE(side[n] == 2.0 || side[n] == 3.0);
    // It drags the lower wall along and holds the lid back.
    const Vec3 expected = (side[n] == 2.0 ? 0.5 : -0.5) * rho * nu * lid;
    for (int e = 0; e < 3; ++e)
      EXPECT_NEAR(shear[3 * n + e], expected[e], 1e-13);
  }
  EXPECT_NEAR(area, 2.0 * 3.0, 1e-13);
}

}  // namespace
}  // namespace luff::simulation
