// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/curvilinear_plates.hpp"

namespace luff::test {
namespace {

/// Forces on a plate that moves through a skewed grid, over four steps.
std::vector<Vec3> forces(MPI_Comm comm, fluid::FlowOptions options)
{
  const Slab slab{.x = {-2.0, 2.0, 40, {}}, .y = {-1.5, 1.5, 30, {}}, .depth = 0.1, .stream = 0.5, .viscosity = 0.02};
  options.viscosity = slab.viscosity;
  const auto flow = make_curvilinear_flow(slab, skewed_around_origin, options, comm);
  const Plate plate{.degrees = 70.0, .centre = {0.007, 0.003, 0.0}, .velocity = {-1.0, 0.2, 0.0}};
  std::vector<Vec3> result;
  for (int n = 0; n < 4; ++n) {
    flow->step(0.02, plate.at(flow->t + 0.02, slab.depth));
    result.push_back(coefficients(total_force(flow->solver.loads()), slab.depth));
    flow->solver.accept();
  }
  EXPECT_LE(flow->largest_divergence, 1e-13);
  return result;
}

TEST(CurvilinearPlateOnRanks, FeelsTheForcesOfOneRankThatHoldsTheWholeGrid)
{
  for (const fluid::FlowOptions& options : std::vector<fluid::FlowOptions>{
           {}, {.immersed = fluid::ImmersedScheme::Curvib}, {.edges_cover_in_part = true}}) {
    const auto expected = forces(MPI_COMM_SELF, options);
    const auto shared = forces(MPI_COMM_WORLD, options);
    for (std::size_t n = 0; n < shared.size(); ++n)
      EXPECT_LE((shared[n] - expected[n]).norm(), 1e-8 * expected[n].norm());  // stage 2 leaves a residual of 1e-9
  }
}

}  // namespace
}  // namespace luff::test
