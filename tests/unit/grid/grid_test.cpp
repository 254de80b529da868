// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "grid/axis.hpp"
#include "grid/grid.hpp"

namespace luff::grid {
namespace {

AxisSpec refined(double from, double to, int cells, Refinement r)
{
  return {from, to, cells, r};
}

TEST(FaceCoordinates, OfAUniformAxisAreEvenlySpacedAndEndExactly)
{
  const auto x = face_coordinates({-1.0, 2.0, 6, {}}, "x");
  ASSERT_EQ(x.size(), 7u);
  EXPECT_EQ(x.front(), -1.0);
  EXPECT_EQ(x.back(), 2.0);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(x[i + 1] - x[i], 0.5, 1e-15);
}

TEST(FaceCoordinates, KeepTheGivenSpacingInsideAndGrowByOneRatioOnEachSide)
{
  const auto x = face_coordinates(refined(-4.0, 9.0, 70, {-1.0, 2.0, 0.1}), "x");
  ASSERT_EQ(x.size(), 71u);
  EXPECT_EQ(x.front(), -4.0);
  EXPECT_EQ(x.back(), 9.0);
  int inside = 0;
  for (int i = 1; i + 1 < 71; ++i) {
    const double before = x[i] - x[i - 1];
    const double after = x[i + 1] - x[i];
    const double ratio = std::max(before / after, after / before);
    EXPECT_LT(ratio, largest_growth);
    inside += x[i] > -1.0 + 1e-9 && x[i] < 2.0 - 1e-9 && std::abs(after - 0.1) < 1e-12 ? 1 : 0;
  }
  EXPECT_EQ(inside, 29);
}

TEST(FaceCoordinates, TouchingRefinementAtOneEndGrowsOnlyTowardsTheOther)
{
  const auto x = face_coordinates(refined(0.0, 3.0, 30, {0.0, 1.0, 0.05}), "y");
  EXPECT_EQ(x.front(), 0.0);
  EXPECT_NEAR(x[1], 0.05, 1e-14);
  EXPECT_GT(x[30] - x[29], 0.05);
}

TEST(FaceCoordinates, RefuseTooFewAndTooManyCells)
{
  EXPECT_THROW(face_coordinates(refined(-4.0, 9.0, 32, {-1.0, 2.0, 0.1}), "x"), InputError);
  EXPECT_THROW(face_coordinates(refined(-4.0, 9.0, 400, {-1.0, 2.0, 0.1}), "x"), InputError);
  EXPECT_THROW(face_coordinates(refined(-4.0, 9.0, 20, {-1.0, 2.0, 0.1}), "x"), InputError);
  EXPECT_THROW(face_coordinates({1.0, 1.0, 4, {}}, "x"), InputError);
}

std::array<std::vector<double>, 3> stretched_faces()
{
  return {std::vector<double>{0.0, 1.0, 3.0, 6.0}, {0.0, 0.5, 1.0}, {-1.0, 0.0, 4.0}};
}

TEST(Grid, KnowsItsKindFromTheCoordinates)
{
  const Grid uniform(MPI_COMM_SELF, {std::vector<double>{0.0, 0.1, 0.2, 0.30000000000000004}, {0.0, 0.3}, {0.0, 0.2}},
                     {false, false, false});
  EXPECT_EQ(uniform.kind(), Kind::Uniform);
  const Grid stretched(MPI_COMM_SELF, stretched_faces(), {false, false, false});
  EXPECT_EQ(stretched.kind(), Kind::Rectilinear);
}

TEST(Grid, MirrorsWidthsBeyondWallsAndRepeatsThemBeyondPeriodicSides)
{
  const Grid walls(MPI_COMM_SELF, stretched_faces(), {false, false, false});
  EXPECT_EQ(walls.width(0, -1), 1.0);
  EXPECT_EQ(walls.width(0, 3), 3.0);
  EXPECT_EQ(walls.distance(0, 0), 1.0);
  EXPECT_EQ(walls.centre(0, -1), -0.5);
  const Grid periodic(MPI_COMM_SELF, stretched_faces(), {true, false, false});
  EXPECT_EQ(periodic.width(0, -1), 3.0);
  EXPECT_EQ(periodic.distance(0, 0), 2.0);
  EXPECT_EQ(periodic.distance(0, 0), periodic.distance(0, 3));
}

TEST(Metrics, OfTheSameGridAgreeWhateverTheirKind)
{
  const Grid grid(MPI_COMM_SELF, stretched_faces(), {false, false, false});
  const auto agree = [&](auto metric) {
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) {
          EXPECT_EQ(metric.template width<0>(i), grid.width(0, i));
          EXPECT_EQ(metric.template area<0>(i, j, k), grid.area(0, i, j, k));
          EXPECT_EQ(metric.template area<1>(i, j, k), grid.area(1, i, j, k));
          EXPECT_EQ(metric.template area<2>(i, j, k), grid.area(2, i, j, k));
          EXPECT_EQ(metric.volume(i, j, k), grid.volume(i, j, k));
          EXPECT_DOUBLE_EQ(metric.template inverse_distance<2>(k) * grid.distance(2, k), 1.0);
        }
  };
  grid.visit([&](auto metric) {
    if constexpr (!is_curvilinear<decltype(metric)>)
      agree(metric);
  });
}

TEST(Grid, RefusesCoordinatesThatDoNotIncrease)
{
  auto faces = stretched_faces();
  faces[1] = {0.0, 0.5, 0.5};
  EXPECT_THROW(Grid(MPI_COMM_SELF, faces, {false, false, false}), InputError);
}

}  // namespace
}  // namespace luff::grid
