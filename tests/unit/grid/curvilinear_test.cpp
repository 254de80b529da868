// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/curvilinear.hpp"
#include "support/faces.hpp"

namespace luff::grid {
namespace {

constexpr Index3 cells{8, 7, 6};
constexpr std::array<bool, 3> walls{false, false, false};

/// Largest norm over cells of the sum of the outward area vectors, relative to the largest area.
double largest_gap(const Grid& grid)
{
  double largest = 0.0;
  double area = 0.0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    Vec3 sum = Vec3::Zero();
    for (int a = 0; a < 3; ++a) {
      const Index3 high = stepped({i, j, k}, a, 1);
      sum += grid.area_vector(a, high[0], high[1], high[2]) - grid.area_vector(a, i, j, k);
      area = std::max(area, grid.area(a, i, j, k));
    }
    largest = std::max(largest, sum.norm());
  });
  return largest / area;
}

double total_volume(const Grid& grid)
{
  double sum = 0.0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { sum += grid.volume(i, j, k); });
  return sum;
}

TEST(CurvilinearGrid, CellsAreClosedAndFillTheDomainExactly)
{
  for (const NodeSource& nodes :
       {test::mapped_nodes(cells, test::Waved{}), test::mapped_nodes(cells, test::Mirrored<test::Waved>{}),
        test::mapped_nodes(cells, test::Perturbed{cells})}) {
    const Grid grid(MPI_COMM_SELF, cells, nodes, {true, true, true});
    EXPECT_LE(largest_gap(grid), 1e-14);
    EXPECT_NEAR(total_volume(grid), 1.0, 1e-13);
    for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { EXPECT_GT(grid.volume(i, j, k), 0.0); });
  }
}

TEST(CurvilinearGrid, OfStraightLinesHasTheMetricsOfTheRectilinearGrid)
{
  const std::array faces{test::stretched_faces(0, 1, 8, 0.3), test::stretched_faces(-1, 1, 7, -0.2),
                         test::stretched_faces(0, 3, 6, 0.1)};
  const Grid straight(MPI_COMM_SELF, faces, walls);
  const Grid curved(
      MPI_COMM_SELF, cells,
      [&](const IndexBox& nodes) {
        std::vector<Vec3> x;
        for_each_cell_in_order(nodes,
                               [&](int i, int j, int k) { x.emplace_back(faces[0][i], faces[1][j], faces[2][k]); });
        return x;
      },
      walls);
  EXPECT_EQ(curved.kind(), Kind::Curvilinear);
  EXPECT_NEAR(curved.smallest_width(), straight.smallest_width(), 1e-15);
  curved.visit([&](const auto metric) {
    if constexpr (is_curvilinear<std::remove_const_t<decltype(metric)>>) {
      for_each_cell_in_order(curved.owned(), [&](int i, int j, int k) {
        EXPECT_NEAR(curved.volume(i, j, k), straight.volume(i, j, k), 1e-15);
        EXPECT_LE((curved.centre(i, j, k) - straight.centre(i, j, k)).norm(), 1e-15);
        const Index3 c{i, j, k};
        for (int a = 0; a < 3; ++a) {
          EXPECT_LE((curved.area_vector(a, i, j, k) - straight.area_vector(a, i, j, k)).norm(), 1e-15);
          EXPECT_LE((curved.face_centre(a, i, j, k) - straight.face_centre(a, i, j, k)).norm(), 1e-15);
          EXPECT_NEAR(metric.G[a](i, j, k), straight.area(a, i, j, k) / straight.width(a, c[a]), 1e-13);
          EXPECT_NEAR(metric.G[3 + a](i, j, k), 0.0, 1e-14);
        }
      });
    } else {
      FAIL() << "not curvilinear";
    }
  });
}

TEST(CurvilinearGrid, LeftHandedOneHasTheMirroredAreasAndTheSameVolumes)
{
  const Index3 mirrored_cells{8, 6, 7};
  const Grid right(MPI_COMM_SELF, cells, test::mapped_nodes(cells, test::Waved{}), walls);
  const Grid left(MPI_COMM_SELF, mirrored_cells, test::mapped_nodes(mirrored_cells, test::Mirrored<test::Waved>{}),
                  walls);
  for_each_cell_in_order(right.owned(), [&](int i, int j, int k) {
    EXPECT_NEAR(right.volume(i, j, k), left.volume(i, k, j), 1e-16);
    EXPECT_LE((right.area_vector(0, i, j, k) - left.area_vector(0, i, k, j)).norm(), 1e-16);
    EXPECT_LE((right.area_vector(1, i, j, k) - left.area_vector(2, i, k, j)).norm(), 1e-16);
  });
}

TEST(CurvilinearGrid, RepeatsItselfBeyondPeriodicSidesAndMirrorsBeyondOthers)
{
  const Grid grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, test::Waved{}), {true, false, false});
  EXPECT_LE((grid.centre(-1, 3, 2) - grid.centre(7, 3, 2) + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LE((grid.centre(8, 3, 2) - grid.centre(0, 3, 2) - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LE((grid.centre(3, -1, 2) - (2.0 * grid.face_centre(1, 3, 0, 2) - grid.centre(3, 0, 2))).norm(), 1e-15);
}

}  // namespace
}  // namespace luff::grid
