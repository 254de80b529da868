// SPDX-License-Identifier: BSD-3-Clause
// Good grids are told from bad ones, and the worst cell is named.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "grid/axis.hpp"
#include "grid/generators/aorta.hpp"
#include "grid/generators/mapped_box.hpp"
#include "grid/generators/pipe.hpp"
#include "grid/quality.hpp"
#include "support/curvilinear.hpp"

namespace luff::grid {
namespace {

using std::numbers::pi;

std::vector<double> evenly(double from, double to, int cells)
{
  return face_coordinates({from, to, cells, std::nullopt}, "test");
}

double total_volume(const Grid& grid)
{
  double sum = 0.0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { sum += grid.volume(i, j, k); });
  return sum;
}

std::string refusal(const GridQuality& quality)
{
  try {
    require_sound(quality);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GridQuality, OfABoxIsPerfect)
{
  const Grid grid(MPI_COMM_WORLD, {evenly(0.0, 1.0, 4), evenly(0.0, 2.0, 4), evenly(0.0, 0.5, 4)}, {});
  const GridQuality q = measure_quality(grid);
  EXPECT_LT(q.gap.value, 1e-15);
  EXPECT_NEAR(q.volume.value, 1.0, 1e-14);
  EXPECT_NEAR(q.jacobian.value, 1.0, 1e-14);
  EXPECT_LT(q.skew.value, 1e-14);
  EXPECT_NEAR(q.aspect.value, 4.0, 1e-13);
  EXPECT_NEAR(q.growth.value, 1.0, 1e-13);
  EXPECT_EQ(refusal(q), "accepted");
  EXPECT_TRUE(quality_warnings(q).empty());
}

TEST(GridQuality, OfASkewedBoxHasTheCosineOfItsAngle)
{
  const auto sheared = make_mapped_box({evenly(0.0, 1.0, 3), evenly(0.0, 1.0, 4), evenly(0.0, 1.0, 5)},
                                       [](const Vec3& x) { return Vec3(x[0] + x[1], x[1], x[2]); });
  const GridQuality q = measure_quality({MPI_COMM_WORLD, sheared.cells, sheared.source, {}});
  EXPECT_NEAR(q.skew.value, std::cos(pi / 4.0), 1e-14);
  ASSERT_EQ(quality_warnings(q).size(), 1U);
  EXPECT_NE(quality_warnings(q)[0].find("the cosine between faces is 0.707 in cell"), std::string::npos);
}

TEST(GridQuality, IsTheSameOfLeftHandedGrids)
{
  const Index3 cells{6, 5, 4};
  const Grid right(MPI_COMM_WORLD, cells, test::mapped_nodes(cells, test::Waved{}), {});
  const Index3 swapped{6, 4, 5};
  const Grid left(MPI_COMM_WORLD, swapped, test::mapped_nodes(swapped, test::Mirrored<test::Waved>{}), {});
  const GridQuality a = measure_quality(right);
  const GridQuality b = measure_quality(left);
  EXPECT_NEAR(a.volume.value, b.volume.value, 1e-13);
  EXPECT_NEAR(a.jacobian.value, b.jacobian.value, 1e-13);
  EXPECT_NEAR(a.skew.value, b.skew.value, 1e-13);
  EXPECT_EQ(refusal(b), "accepted");
}

TEST(GridQuality, RefusesACellThatIsInsideOutAndNamesIt)
{
  const Index3 cells{4, 4, 4};
  const auto nodes = node_source([](int i, int j, int k) {
    return Vec3(i == 2 && j == 2 && k == 2 ? 8.0 : i, j, k);  // one node pushed far beyond its neighbour
  });
  const std::string said = refusal(measure_quality({MPI_COMM_WORLD, cells, nodes, {}}));
  EXPECT_NE(said.find("the grid's cell (2, "), std::string::npos) << said;
}

TEST(GridQuality, RefusesCellsWithoutVolumeAndFoldedOnes)
{
  const Index3 cells{3, 3, 3};
  const auto flat = node_source([](int i, int j, int k) { return Vec3(i == 2 ? 1 : i, j, k); });
  EXPECT_NE(refusal(measure_quality({MPI_COMM_WORLD, cells, flat, {}})).find("has no volume"), std::string::npos);
  const auto folded = node_source([](int i, int j, int k) { return Vec3(i == 2 ? 0.5 : i, j, k); });
  EXPECT_NE(refusal(measure_quality({MPI_COMM_WORLD, cells, folded, {}})).find("has negative volume"),
            std::string::npos);
}

TEST(GridQuality, WarnsOfCellsThatGrowTooFastAndOfFlatOnes)
{
  const auto grown =
      make_mapped_box({std::vector<double>{0.0, 1.0, 4.0}, {0.0, 0.01}, {0.0, 1.0}}, [](const Vec3& x) { return x; });
  const auto said = quality_warnings(measure_quality({MPI_COMM_WORLD, grown.cells, grown.source, {}}));
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("grows by 3.00"), std::string::npos);
  EXPECT_NE(said[1].find("aspect ratio of 300"), std::string::npos);
}

TEST(GridQuality, RefusesPeriodicSidesThatAreNoTranslationOfEachOther)
{
  const Index3 cells{3, 4, 5};
  const auto check = [&](double bulge) {
    const auto nodes = node_source(
        [=](int i, int j, int k) { return Vec3(i + (i == 3 && j == 2 && k == 1 ? bulge : 0.0), j + 0.2 * i, k); });
    try {
      require_periodic_sides({MPI_COMM_WORLD, cells, nodes, {true, false, false}}, nodes);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(check(1e-9), "accepted");
  EXPECT_NE(check(0.1).find("opposite sides along xi are periodic, but the node opposite (0, 2, 1) lies 0.1 from"),
            std::string::npos);
}

TEST(Pipe, ThatBendsIsSoundAndHasTheVolumeOfPappus)
{
  Centreline line(frame_along(Vec3::Zero(), Vec3::UnitZ()));
  line.add_bend(3.0, pi, Vec3::UnitX());
  const CurvilinearNodes pipe =
      make_pipe({line, evenly(0.0, line.length(), 120), 24, [](double) { return 0.8; }, nullptr});
  const Grid grid(MPI_COMM_WORLD, pipe.cells, pipe.source, {});
  const GridQuality q = measure_quality(grid);
  EXPECT_LT(q.gap.value, 1e-13);
  EXPECT_EQ(refusal(q), "accepted");
  EXPECT_LT(q.skew.value, 0.49);
  const double exact = pi * 0.64 * line.length();
  EXPECT_NEAR(total_volume(grid), exact, 1.5e-3 * exact);  // polygon of 96 sides: 7e-4; stations: 3e-4
}

TEST(Annulus, IsSoundAndOrthogonalAllRound)
{
  const CurvilinearNodes annulus = make_annulus({frame_along(Vec3::Zero(), {1.0, 1.0, 1.0}), evenly(0.5, 1.0, 8),
                                                 evenly(0.0, 2.0 * pi, 60), evenly(0.0, 1.0, 3)});
  const Grid grid(MPI_COMM_WORLD, annulus.cells, annulus.source, {false, true, false});
  require_periodic_sides(grid, annulus.source);
  const GridQuality q = measure_quality(grid);
  EXPECT_EQ(refusal(q), "accepted");
  EXPECT_LT(q.skew.value, 1e-12);
  EXPECT_NEAR(total_volume(grid), 0.75 * 60 * std::sin(2.0 * pi / 60) / 2.0, 1e-13);
}

/// The numbers that the method's study asks of this grid.
TEST(Aorta, IsSoundAndHoldsTheVolumeOfItsLumen)
{
  constexpr double R = 12.7;  // mm
  auto stations = face_coordinates({aorta_inlet * R, aorta_outlet() * R, 159, Refinement{-2.0, 22.0, 0.5}}, "along");
  for (double& s : stations)
    s /= R;
  const CurvilinearNodes aorta = make_aorta(stations, 48, R);
  const Grid grid(MPI_COMM_WORLD, aorta.cells, aorta.source, {});
  const GridQuality q = measure_quality(grid);
  EXPECT_LT(q.gap.value, 1e-13);
  EXPECT_EQ(refusal(q), "accepted");
  EXPECT_LE(q.skew.value, 0.66);
  EXPECT_NEAR(total_volume(grid) / 1000.0, 147.1, 0.3);
}

}  // namespace
}  // namespace luff::grid
