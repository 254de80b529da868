// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/link_tree.hpp"

#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "support/links.hpp"
#include "support/watertight.hpp"

namespace luff::immersed {
namespace {

using test::any_placed_surface;
using test::any_spanning_sheet;
using test::Chance;
using test::is_watertight;
using test::jostled;
using test::Links;
using test::mapped;
using test::placed;
using test::TriangleMesh;

constexpr int cells = 12;
constexpr std::array<bool, 3> no_wrap{false, false, false};
const std::array<Vec3, 3> no_periods{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

/// Centres of 12 cells of width 1/4 along each axis, from -3/2.
Vec3 uniform(const Index3& c)
{
  return {-1.375 + 0.25 * c[0], -1.375 + 0.25 * c[1], -1.375 + 0.25 * c[2]};
}

/// Stretched, sheared to 45 degrees, and bent.
Vec3 skewed(const Index3& c)
{
  const Vec3 x = 1.1 * uniform(c) + 0.1 * uniform(c).array().cube().matrix();
  return {x[0] + 0.8 * x[1] - 0.3 * x[2], x[1] + 0.2 * std::sin(2.0 * x[0]) + 0.4 * x[2],
          x[2] - 0.2 * std::cos(x[0] + x[1])};
}

Vec3 left_handed(const Index3& c)
{
  const Vec3 x = skewed(c);
  return {x[1], x[0], x[2]};
}

/// Moved at random by up to 0.8 cells, so that many cells are inside out: centres may lie anywhere.
Vec3 jumbled(const Index3& c)
{
  Chance chance(1u + c[0] + 100u * c[1] + 10000u * c[2]);
  return skewed(c) + 0.2 * chance.vector();
}

class OnLinks : public ::testing::Test {
 protected:
  static Links make_links(const test::Centres& centre)
  {
    return {MPI_COMM_SELF, {cells, cells, cells}, no_wrap, centre};
  }

  const Links straight = make_links(uniform);
  const Links oblique = make_links(skewed);
  const Links mirrored = make_links(left_handed);
  const Links scattered = make_links(jumbled);
  const std::array<const Links*, 4> all{&straight, &oblique, &mirrored, &scattered};
};

/// Every vertex moved to the nearest centre: links run through vertices and along edges, centres lie in triangles.
TriangleMesh snapped(const Links& links, const TriangleMesh& mesh)
{
  std::vector<Vec3> centres;
  for_each_cell_in_order(links.ranks.owned(), [&](int i, int j, int k) { centres.push_back(links.centre({i, j, k})); });
  return mapped(mesh, [&](const Vec3& x) {
    return *std::min_element(centres.begin(), centres.end(), [&](const Vec3& p, const Vec3& q) {
      return (p - x).squaredNorm() < (q - x).squaredNorm();
    });
  });
}

/// Hits of one place may change their order by round-off.
std::vector<Crossing> by_triangle(std::vector<Crossing> hits)
{
  const auto key = [](const Crossing& hit) { return std::tuple(hit.axis, hit.cell, hit.triangle); };
  std::sort(hits.begin(), hits.end(), [&](const Crossing& p, const Crossing& q) { return key(p) < key(q); });
  return hits;
}

TEST_F(OnLinks, AlongTheAxesTheHitsAreThoseOfACartesianGrid)
{
  std::vector<double> faces(cells + 1);
  for (int i = 0; i <= cells; ++i)
    faces[i] = -1.5 + 0.25 * i;
  const grid::Grid grid(MPI_COMM_SELF, {faces, faces, faces}, no_wrap);
  Chance chance(1);
  for (int n = 0; n < 300; ++n) {
    auto mesh = n % 2 == 0 ? any_placed_surface(chance) : any_spanning_sheet(chance);
    if (n % 3 > 0)
      mesh = snapped(straight, mesh);
    if (n % 3 > 1)
      mesh = jostled(mesh, chance);
    const auto expected = by_triangle(find_crossings(grid, mesh.vertices, mesh.triangles));
    const auto hits = by_triangle(straight.crossings(mesh));
    ASSERT_EQ(hits.size(), expected.size()) << n;
    for (std::size_t q = 0; q < hits.size(); ++q) {
      const Crossing& hit = hits[q];
      ASSERT_EQ(std::tuple(hit.axis, hit.cell, hit.triangle, hit.side),
                std::tuple(expected[q].axis, expected[q].cell, expected[q].triangle, expected[q].side));
      // Right to 2^-43 of the triangle's reach, of up to 13 links, by either search.
      ASSERT_NEAR(hit.theta, expected[q].theta, 13.0 * 0x1p-42);
      for (int m = 0; m < 3; ++m)
        ASSERT_NEAR(hit.weights[m], expected[q].weights[m], 0x1p-43);
    }
  }
}

TEST_F(OnLinks, NoPathPassesAClosedSurfaceUncounted)
{
  Chance chance(2);
  for (int n = 0; n < 200; ++n)
    for (const Links* links : all)
      ASSERT_TRUE(is_watertight(links->ranks, links->crossings(any_placed_surface(chance)))) << n;
}

TEST_F(OnLinks, NoPathPassesAClosedSurfaceWithItsVerticesOnCentresOrOneUnitInTheLastPlaceBeside)
{
  Chance chance(3);
  for (int n = 0; n < 200; ++n)
    for (const Links* links : all) {
      auto mesh = snapped(*links, any_placed_surface(chance));
      if (n % 2 == 1)
        mesh = jostled(mesh, chance);
      const auto hits = links->crossings(mesh);
      ASSERT_TRUE(hits.empty() || is_watertight(links->ranks, hits)) << n;
    }
}

TEST_F(OnLinks, NoPathPassesASheetThatSpansTheGrid)
{
  Chance chance(4);
  for (int n = 0; n < 200; ++n)
    for (const Links* links : all)
      ASSERT_TRUE(is_watertight(links->ranks, links->crossings(any_spanning_sheet(chance)))) << n;
}

TEST_F(OnLinks, NoPathPassesASheetMadeOfLinks)
{
  // The sheet's vertices are the centres of a layer of cells and one around: its edges are links and diagonals, and
  // links across it end on its vertices.
  for (const Links* links : {&straight, &oblique, &mirrored})
    for (int axis = 0; axis < 3; ++axis) {
      const auto layer = mapped(test::sheet(cells + 1), [&](const Vec3& x) {
        const auto index = [](double s) { return static_cast<int>(std::lround(0.5 * (s + 1.0) * (cells + 1))) - 1; };
        Index3 cell{};
        cell[axis] = 5;
        cell[(axis + 1) % 3] = index(x[0]);
        cell[(axis + 2) % 3] = index(x[1]);
        return links->centre(cell);
      });
      const auto hits = links->crossings(layer);
      ASSERT_TRUE(is_watertight(links->ranks, hits));
      int through = 0;
      for (const Crossing& hit : hits)
        through += hit.axis == axis;
      EXPECT_EQ(through, cells * cells);
    }
}

TEST_F(OnLinks, CellsInsideATurnedCubeAreThoseInsideByItsFormula)
{
  Chance chance(6);
  int inside_cells = 0;
  for (int n = 0; n < 200; ++n)
    for (const Links* links : all) {
      const Mat3 turn = chance.turn();
      const Vec3 where = 0.2 * chance.vector();
      const double size = 0.5 + 0.1 * chance.number();
      const auto hits = links->crossings(placed(test::cube(), turn, size, where));
      const auto number = test::winding(links->ranks, test::net_crossings(links->ranks, hits));
      for_each_cell_in_order(links->ranks.owned(), [&](int i, int j, int k) {
        const bool inside = (turn.transpose() * (links->centre({i, j, k}) - where)).cwiseAbs().maxCoeff() < size;
        ASSERT_EQ(number(i, j, k), inside ? 1 : 0);
        inside_cells += inside;
      });
    }
  EXPECT_GT(inside_cells, 10000);
}

TEST_F(OnLinks, ThetaAndWeightsGiveTheSamePlaceToRoundOff)
{
  Chance chance(7);
  double largest = 0.0;
  for (int n = 0; n < 200; ++n)
    for (const Links* links : all) {
      auto mesh = any_placed_surface(chance);
      if (n % 2 == 1)  // squeezed to a sliver that most links see edge on
        mesh = mapped(mesh, [&](const Vec3& x) { return Vec3(x[0], x[1] + 1e-9 * x[2], x[1]); });
      for (const Crossing& hit : links->crossings(mesh)) {
        const Vec3 p = links->centre(stepped(hit.cell, hit.axis, -1));
        const Vec3 link = links->centre(hit.cell) - p;
        Vec3 offset = -hit.theta * link;
        double size = link.norm();
        for (int m = 0; m < 3; ++m) {
          const Vec3& corner = mesh.vertices[mesh.triangles[hit.triangle][m]];
          offset += hit.weights[m] * (corner - p);
          size = std::max(size, (corner - mesh.vertices[mesh.triangles[hit.triangle][(m + 1) % 3]]).norm());
        }
        EXPECT_GE(*std::min_element(hit.weights.begin(), hit.weights.end()), 0.0);
        EXPECT_NEAR(hit.weights[0] + hit.weights[1] + hit.weights[2], 1.0, 4e-16);
        EXPECT_GE(hit.theta, 0.0);
        EXPECT_LT(hit.theta, 1.0);
        largest = std::max(largest, offset.norm() / size);
      }
    }
  // Volumes right to 2^-45 of themselves make weights and theta right to 2^-44.
  EXPECT_LT(largest, 0x1p-43);
  RecordProperty("misplacement", fmt::format("{:.1e}", largest));
}

TEST_F(OnLinks, ScalingByAPowerOfTwoChangesNoBit)
{
  Chance chance(8);
  for (const double scale : {0x1p-60, 0x1p-3, 0x1p+60}) {
    const Links scaled = make_links([&](const Index3& c) -> Vec3 { return scale * skewed(c); });
    for (int n = 0; n < 60; ++n) {
      const auto mesh = jostled(snapped(oblique, any_placed_surface(chance)), chance);
      ASSERT_EQ(oblique.crossings(mesh),
                scaled.crossings(mapped(mesh, [&](const Vec3& x) { return Vec3(scale * x); })));
    }
  }
}

/// Centres of a sheared block that repeats along the axes: coordinates are short binary fractions.
Vec3 sheared(const Index3& c)
{
  const Vec3 x = uniform(c);
  return {x[0] + 0.5 * x[1], x[1] - 0.25 * x[2], x[2]};
}
const std::array<Vec3, 3> sheared_periods{3.0 * Vec3(1.0, 0.0, 0.0), 3.0 * Vec3(0.5, 1.0, 0.0),
                                          3.0 * Vec3(0.0, -0.25, 1.0)};

TEST(LinkTree, OnAPeriodicGridASurfaceNearASideIsThatInTheMiddle)
{
  const Links links(MPI_COMM_SELF, {cells, cells, cells}, {true, true, true}, sheared, sheared_periods);
  Chance chance(9);
  for (int n = 0; n < 200; ++n) {
    const auto short_coordinates = [](const Vec3& x) { return Vec3(0x1p-40 * (0x1p+40 * x).array().round()); };
    const auto mesh = mapped(placed(test::sphere(1), chance.turn(), 0.7, 0.2 * chance.vector()), short_coordinates);
    const auto middle = links.crossings(mesh);
    ASSERT_TRUE(is_watertight(links.ranks, middle));
    for (int axis = 0; axis < 3; ++axis) {
      // A quarter cell beyond the side at most: half a cell is what the links beyond it reach.
      const int steps = chance.index(4) - 2;
      const Vec3 by = steps / 12.0 * sheared_periods[axis];
      auto expected = middle;
      for (Crossing& hit : expected)
        hit.cell[axis] = (hit.cell[axis] + steps + cells) % cells;
      sort(expected, links.ranks.cells());
      auto hits = links.crossings(mapped(mesh, [&](const Vec3& x) { return Vec3(x + by); }));
      std::erase_if(hits, [&](const Crossing& hit) { return hit.cell[hit.axis] == cells; });
      ASSERT_EQ(hits, expected) << axis << ' ' << steps;
    }
  }
}

TEST(LinkTree, BothFacesOfAWrapAroundLinkListTheSameHits)
{
  const Links links(MPI_COMM_SELF, {cells, cells, cells}, {true, true, true}, sheared, sheared_periods);
  Chance chance(10);
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-0.3, 0.3}) {
      std::vector<Crossing> low;
      std::vector<Crossing> high;
      const auto mesh = placed(test::sphere(2), chance.turn(), 0.6, end * sheared_periods[axis]);
      for (Crossing hit : links.crossings(mesh)) {
        if (hit.axis == axis && hit.cell[axis] == 0)
          low.push_back(hit);
        if (hit.axis == axis && hit.cell[axis] == cells) {
          hit.cell[axis] = 0;
          high.push_back(hit);
        }
      }
      EXPECT_GT(low.size(), 3u);
      EXPECT_TRUE(low == high);
    }
}

TEST(LinkTree, OnAClosedRingEveryLinkIsListedOnce)
{
  const Links ring(MPI_COMM_SELF, {16, 5, 6}, {true, false, false}, [](const Index3& c) -> Vec3 {
    const double angle = 2.0 * M_PI * c[0] / 16.0;
    const double radius = 1.0 + 0.2 * c[1];
    return {radius * std::cos(angle), radius * std::sin(angle), 0.2 * c[2]};
  });
  Chance chance(11);
  for (int n = 0; n < 200; ++n) {
    // Around the point where the ring closes, and anywhere else.
    const double angle = n % 2 == 0 ? -M_PI / 16.0 : 3.0 * chance.number();
    const auto mesh =
        placed(test::sphere(2), chance.turn(), 0.35, Vec3(1.4 * std::cos(angle), 1.4 * std::sin(angle), 0.5));
    auto hits = ring.crossings(mesh);
    EXPECT_TRUE(is_watertight(ring.ranks, hits));
    std::erase_if(hits, [](const Crossing& hit) { return hit.cell[0] == 16; });
    for (std::size_t q = 1; q < hits.size(); ++q)
      ASSERT_FALSE(hits[q - 1] == hits[q]);
  }
}

TEST_F(OnLinks, TrianglesWithoutAreaAreNotHit)
{
  const Vec3 a = oblique.centre({2, 2, 2});
  const Vec3 b = oblique.centre({9, 9, 9});
  const TriangleMesh mesh{{a, b, 0.5 * (a + b)}, {{0, 1, 1}, {2, 2, 2}, {0, 1, 0}}};
  EXPECT_TRUE(oblique.crossings(mesh).empty());
  EXPECT_TRUE(oblique.crossings({}).empty());
}

}  // namespace
}  // namespace luff::immersed
