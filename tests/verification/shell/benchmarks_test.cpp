// SPDX-License-Identifier: BSD-3-Clause
// Plates and shells of the literature on irregular meshes, and what the smoothed membrane adds.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/shell_benchmarks.hpp"

namespace luff::test {
namespace {

using shell::MembraneKind;
using surface::Pattern;

double said(const char* name, double ratio)
{
  std::printf("  %s: %.4f of the reference\n", name, ratio);
  return ratio;
}

TEST(ShellBenchmarks, ClampedPlateIsRightWithinTwoAndAHalfPercent)
{
  EXPECT_NEAR(said("irregular, n = 32", clamped_plate({.n = 32})), 1, 0.025);
  EXPECT_NEAR(said("Delaunay, n = 32", clamped_plate({.n = 32, .pattern = Pattern::Delaunay})), 1, 0.025);
}

TEST(ShellBenchmarks, SupportedPlateOfDelaunayTrianglesIsRight)
{
  EXPECT_NEAR(said("n = 32", supported_plate({.n = 32, .pattern = Pattern::Delaunay})), 1, 0.003);
}

// The constant membrane strain is stiff in the roof's edges, which bend in their own plane; 0.986 of 0.3024.
TEST(ShellBenchmarks, ScordelisLoRoofIsOnePercentStiffOnAnIrregularMesh)
{
  EXPECT_NEAR(said("n = 32", scordelis_lo_roof({.n = 32})) * 0.3006 / 0.3024, 0.986, 0.004);
}

TEST(ShellBenchmarks, ScordelisLoRoofWithSmoothedMembraneIsRightWithinHalfAPercent)
{
  for (const Pattern pattern : {Pattern::Diagonal, Pattern::Irregular, Pattern::Delaunay})
    EXPECT_NEAR(said("n = 32", scordelis_lo_roof({.n = 32, .pattern = pattern, .membrane = MembraneKind::Smoothed})), 1,
                0.005);
}

TEST(ShellBenchmarks, PinchedHemisphereIsRightWithinHalfAPercent)
{
  EXPECT_NEAR(said("irregular, n = 32", pinched_hemisphere({.n = 32})), 0.997, 0.005);
  EXPECT_NEAR(said("smoothed", pinched_hemisphere({.n = 32, .membrane = MembraneKind::Smoothed})), 1, 0.003);
}

// On even rows there is no order before n = 128: bending dies out over a single spacing of 32 from the free edge.
TEST(ShellBenchmarks, HemisphereConvergesAsItShouldWithFinerRowsAtItsEdge)
{
  std::array<double, 3> u;
  for (int level = 0; level < 3; ++level)
    u[level] = pinched_hemisphere_graded(
        {.n = 12 << level, .pattern = Pattern::Diagonal, .membrane = MembraneKind::Smoothed}, 8);
  const double order = observed_order(u[1] - u[0], u[2] - u[1]);
  std::printf("  n = 12, 24, 48: %.5f, %.5f, %.5f of the reference, order %.2f\n", u[0], u[1], u[2], order);
  EXPECT_GT(order, 1.8);
  EXPECT_NEAR(u[2], 1, 1e-3);
}

TEST(ShellBenchmarks, SmoothedMembraneCutsTheErrorOfABeamBentInItsPlaneToAThird)
{
  for (const Pattern pattern : {Pattern::Diagonal, Pattern::Irregular}) {
    const double constant = said("constant strain", in_plane_cantilever({.n = 40, .pattern = pattern}));
    const double smoothed =
        said("smoothed strain", in_plane_cantilever({.n = 40, .pattern = pattern, .membrane = MembraneKind::Smoothed}));
    EXPECT_LT(std::abs(smoothed - 1), std::abs(constant - 1) / 3);
  }
}

}  // namespace
}  // namespace luff::test
