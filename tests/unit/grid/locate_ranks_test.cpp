// SPDX-License-Identifier: BSD-3-Clause
// Points are found in grids of any kind, by one rank, and what is linear in space is interpolated exactly there.
#include <random>

#include <gtest/gtest.h>

#include "grid/generators/pipe.hpp"
#include "grid/locate.hpp"
#include "support/curvilinear.hpp"

namespace luff::grid {
namespace {

Vec3 interpolated_place(const Grid& grid, const Location& location)
{
  Vec3 x = Vec3::Zero();
  for (int c = 0; c < 8; ++c) {
    double w = 1.0;
    for (int a = 0; a < 3; ++a)
      w *= (c >> a & 1) == 1 ? location.weight[a] : 1.0 - location.weight[a];
    x += w * grid.centre(location.base[0] + (c & 1), location.base[1] + (c >> 1 & 1), location.base[2] + (c >> 2));
  }
  return x;
}

/// The point is found by one rank, from whose weights its place comes back.
void expect_found(const Grid& grid, const Vec3& x)
{
  const auto location = locate(grid, x);
  ASSERT_TRUE(location.has_value()) << x.transpose();
  EXPECT_EQ(grid.ranks().sum(location->mine ? 1.0 : 0.0), 1.0) << x.transpose();
  if (location->mine) {
    EXPECT_LT((interpolated_place(grid, *location) - x).norm(), 1e-11) << x.transpose();
  }
}

TEST(Locate, FindsPointsAnywhereInASkewedGrid)
{
  const Index3 cells{9, 8, 10};
  const Grid grid(MPI_COMM_WORLD, cells, test::mapped_nodes(cells, test::Waved{.amplitude = 0.08}), {});
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const Vec3 s(share(engine), share(engine), share(engine));
    // A place in the trilinear cell, not of the map, whose sides are curved.
    const Vec3 low = (s.array() * Eigen::Array3d(9, 8, 10)).floor().min(Eigen::Array3d(8, 7, 9));
    Vec3 x = Vec3::Zero();
    for (int c = 0; c < 8; ++c) {
      Vec3 node;
      double w = 1.0;
      for (int a = 0; a < 3; ++a) {
        const double t = s[a] * cells[a] - low[a];
        node[a] = (low[a] + (c >> a & 1)) / cells[a];
        w *= (c >> a & 1) == 1 ? t : 1.0 - t;
      }
      x += w * test::Waved{.amplitude = 0.08}(node);
    }
    expect_found(grid, x);
  }
}

TEST(Locate, FindsPointsOnTheWallsAndCornersOfABox)
{
  const Grid grid(MPI_COMM_WORLD,
                  {std::vector<double>{0.0, 0.5, 1.2, 2.0}, {0.0, 1.0, 2.5, 4.0, 5.0}, {-1.0, 0.0, 0.5, 1.0, 2.0}}, {});
  for (const Vec3& x : {Vec3(0.0, 0.0, -1.0), Vec3(2.0, 5.0, 2.0), Vec3(0.5, 1.0, 0.5), Vec3(1.0, 3.3, -0.99)})
    expect_found(grid, x);
  EXPECT_FALSE(locate(grid, {2.01, 1.0, 0.0}).has_value());
  EXPECT_FALSE(locate(grid, {1.0, 1.0, std::nan("")}).has_value());
}

TEST(Locate, FindsThePointsOfABentPipeAndNoneBesideIt)
{
  Centreline line(frame_along(Vec3::Zero(), Vec3::UnitZ()));
  line.add_straight(1.0);
  line.add_bend(2.0, 2.0, Vec3::UnitX());
  std::vector<double> stations;
  for (int k = 0; k <= 24; ++k)
    stations.push_back(line.length() * k / 24);
  const CurvilinearNodes pipe = make_pipe({line, stations, 8, [](double) { return 0.5; }, nullptr});
  const Grid grid(MPI_COMM_WORLD, pipe.cells, pipe.source, {});
  for (double s = 0.02; s < line.length(); s += 0.21) {
    const CurvePoint p = line.at(s);
    expect_found(grid, p.x);
    expect_found(grid, p.x + 0.45 * p.e1);
    expect_found(grid, p.x - 0.3 * p.e1 + 0.3 * p.e2);
    EXPECT_FALSE(locate(grid, p.x + 0.52 * p.e2).has_value());
  }
  EXPECT_FALSE(locate(grid, {0.0, 0.0, -0.01}).has_value());
}

TEST(Standings, TellPointsInsideOnSidesAndOutside)
{
  const Index3 cells{9, 8, 10};
  const Grid grid(MPI_COMM_WORLD, cells, test::mapped_nodes(cells, test::Waved{.amplitude = 0.08}), {});
  std::vector<Vec3> points;
  const auto node = [&](int i, int j, int k) { return test::Waved{.amplitude = 0.08}({i / 9.0, j / 8.0, k / 10.0}); };
  points.push_back(0.5 * (node(4, 4, 5) + node(5, 5, 6)));
  points.push_back(0.25 * (node(0, 3, 4) + node(0, 4, 4) + node(0, 3, 5) + node(0, 4, 5)));  // on xi_min
  points.push_back(node(9, 8, 3));                                                           // on two sides
  points.push_back({3.0, 0.5, 0.5});
  points.push_back(node(0, 3, 4) - Vec3(1e-6, 0.0, 0.0));
  const std::vector<Standing> standing = standings(grid, points);
  const auto sides = [&](std::size_t p) {
    int count = 0;
    for (const auto& ends : standing[p].on_side)
      count += ends[0] + ends[1];
    return count;
  };
  EXPECT_TRUE(standing[0].inside && sides(0) == 0);
  EXPECT_TRUE(standing[1].inside && standing[1].on_side[0][0] && sides(1) == 1);
  EXPECT_TRUE(standing[2].inside && standing[2].on_side[0][1] && standing[2].on_side[1][1] && sides(2) == 2);
  EXPECT_FALSE(standing[3].inside);
  EXPECT_FALSE(standing[4].inside);
}

/// Middle and mean edges of a cell of a map.
template <class Map>
std::pair<Vec3, Mat3> middle_and_edges(const Map& map, const Index3& cells, const Index3& cell)
{
  Vec3 middle = Vec3::Zero();
  Mat3 edges = Mat3::Zero();
  for (int c = 0; c < 8; ++c) {
    Vec3 s;
    for (int a = 0; a < 3; ++a)
      s[a] = static_cast<double>(cell[a] + (c >> a & 1)) / cells[a];
    middle += map(s) / 8.0;
    for (int a = 0; a < 3; ++a)
      edges.col(a) += ((c >> a & 1) == 1 ? 0.25 : -0.25) * map(s);
  }
  return {middle, edges};
}

/// The edges of a cell are one cell long, along their own direction; also for points beyond the last cell.
TEST(Standings, KnowTheShapeOfTheCellsAround)
{
  const Index3 cells{9, 8, 10};
  const test::Waved map{.amplitude = 0.08};
  const Grid grid(MPI_COMM_WORLD, cells, test::mapped_nodes(cells, map), {});
  for (int n = 0; n < 8; ++n) {
    const auto [middle, edges] = middle_and_edges(map, cells, {n, 7 - n, n + 1});
    const auto [last, edges_of_last] = middle_and_edges(map, cells, {8, 7 - n, n + 1});
    const std::vector<Standing> standing = standings(grid, std::vector{middle, Vec3(last + Vec3(0.13, 0.0, 0.0))});
    EXPECT_TRUE(standing[0].inside);
    EXPECT_FALSE(standing[1].inside);
    for (int a = 0; a < 3; ++a) {
      EXPECT_LE((standing[0].cell.in_cells(edges.col(a)) - Vec3::Unit(a)).norm(), 1e-12);
      EXPECT_LE((standing[1].cell.in_cells(edges_of_last.col(a)) - Vec3::Unit(a)).norm(), 1e-12);
    }
  }
}

/// A ring closes where it has no side; the two ends of other periodic axes are sides.
TEST(Standings, TellPeriodicSidesFromTheSeamOfARing)
{
  const Index3 cells{16, 4, 4};
  const auto ring = [](const Vec3& s) {
    const double angle = 2.0 * M_PI * s[0];
    return Vec3((1.0 + s[1]) * std::cos(angle), (1.0 + s[1]) * std::sin(angle), s[2]);
  };
  const Grid grid(MPI_COMM_WORLD, cells, test::mapped_nodes(cells, ring), {true, false, true});
  const std::vector<Standing> standing = standings(grid, std::vector{Vec3(1.3, 0.0, 0.4), Vec3(1.3, 0.0, 1.0)});
  const auto none = std::array<std::array<bool, 2>, 3>{};
  EXPECT_TRUE(standing[0].inside && standing[0].on_side == none);
  EXPECT_TRUE(standing[1].inside && standing[1].on_side[2][1] && !standing[1].on_side[2][0]);
  EXPECT_NEAR(standing[0].cell.in_cells({0.0, 0.0, 0.25})[2], 1.0, 1e-12);
}

}  // namespace
}  // namespace luff::grid
