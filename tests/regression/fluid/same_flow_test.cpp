// SPDX-License-Identifier: BSD-3-Clause
// The same flow on any number of threads, in any units, and however a slab is closed.
#include <iostream>

#include <gtest/gtest.h>

#include "support/plates.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

/// What the flow sees of a sheet: both schemes, and edges that cover faces in part.
const std::array<fluid::FlowOptions, 3> ways_to_see_sheets{
    {{}, {.immersed = fluid::ImmersedScheme::Curvib}, {.edges_cover_in_part = true}}};

TEST(Flow, HasTheSameBitsOnOneAndTwoThreads)
{
  const int threads = omp_get_max_threads();
  for (const fluid::FlowOptions& options : ways_to_see_sheets) {
    omp_set_num_threads(1);
    const Signature one = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, options);
    omp_set_num_threads(2);
    const Signature two = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, options);
    EXPECT_EQ(one.values, two.values);
  }
  omp_set_num_threads(threads);
}

TEST(Flow, HasTheSameBitsWhenLengthAndTimeAreScaledByPowersOfTwo)
{
  for (const fluid::FlowOptions& options : ways_to_see_sheets) {
    const Signature plain = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, options);
    const Signature scaled =
        run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {.length = 0x1p-9, .time = 0x1p3}, options);
    EXPECT_EQ(plain.values, scaled.values);
  }
}

TEST(Flow, HasTheSameDigitsInMillimetresAndMilliseconds)
{
  const Signature plain = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true);
  const Signature scaled = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {.length = 13.7, .time = 420.0});
  const double difference = plain.difference(scaled);
  std::cout << "  other units: " << difference << " relative\n";
  EXPECT_LE(difference, 1e-11);
}

/// Force on a plate along the grid after it has passed over three rows of cells.
Vec3 force_on_passing_plate(fluid::SideKind z_sides)
{
  const Slab slab{.x = {-1.5, 1.5, 60, {}}, .y = {-1.5, 1.5, 60, {}}, .depth = 0.05, .stream = 0.0, .z_sides = z_sides};
  const Plate plate{.degrees = 90.0, .centre = {0.613, 0.017, 0.0}, .velocity = {-1.0, 0.0, 0.0}};
  const auto flow = make_flow(slab);
  for (int n = 0; n < 15; ++n) {
    flow->step(0.01, plate.at(flow->t + 0.01, slab.depth));
    flow->solver.accept();
  }
  return coefficients(total_force(flow->solver.loads()), slab.depth);
}

TEST(Flow, OfASlabDoesNotKnowWhetherItIsPeriodicOrBetweenSymmetryPlanes)
{
  const Vec3 symmetric = force_on_passing_plate(fluid::SideKind::Symmetry);
  const Vec3 periodic = force_on_passing_plate(fluid::SideKind::Periodic);
  const double difference = (symmetric - periodic).norm() / periodic.norm();
  std::cout << "  symmetric against periodic: " << difference << " relative\n";
  EXPECT_LE(difference, 1e-9);
}

}  // namespace
}  // namespace luff::test
