// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "support/watertight.hpp"

namespace luff::immersed {
namespace {

using grid::Grid;
using test::any_placed_surface;
using test::any_spanning_sheet;
using test::Chance;
using test::jostled;
using test::mapped;
using test::placed;
using test::TriangleMesh;

constexpr int cells = 12;

std::vector<double> uniform_faces(int n = cells)
{
  std::vector<double> x(n + 1);
  for (int i = 0; i <= n; ++i)
    x[i] = -1.5 + 0.25 * i;
  return x;
}

/// Widths that grow away from a point, so that no two centres are a round distance apart.
std::vector<double> stretched_faces(double centre)
{
  std::vector<double> x(cells + 1);
  for (int i = 0; i <= cells; ++i)
    x[i] = 1.4 * std::sinh(1.3 * (2.0 * i / cells - 1.0 - centre));
  return x;
}

std::array<std::vector<double>, 3> cube_of(const std::vector<double>& x)
{
  return {x, x, x};
}

constexpr std::array<bool, 3> no_wrap{false, false, false};

class OnGrids : public ::testing::Test {
 protected:
  Grid uniform{MPI_COMM_SELF, cube_of(uniform_faces()), no_wrap};
  Grid stretched{MPI_COMM_SELF, {stretched_faces(0.1), stretched_faces(-0.2), stretched_faces(0.3)}, no_wrap};
  const std::array<const Grid*, 2> grids{&uniform, &stretched};
};

std::vector<Crossing> crossings(const Grid& grid, const TriangleMesh& mesh)
{
  return find_crossings(grid, mesh.vertices, mesh.triangles);
}

::testing::AssertionResult is_watertight(const Grid& grid, const TriangleMesh& mesh)
{
  return test::is_watertight(grid.ranks(), crossings(grid, mesh));
}

/// The centre or face coordinate nearest to x.
double nearest_coordinate(const Grid& grid, int axis, double x)
{
  double best = grid.face(axis, 0);
  for (int i = 0; i < grid.cells()[axis]; ++i)
    for (const double candidate : {grid.centre(axis, i), grid.face(axis, i + 1)})
      if (std::abs(candidate - x) < std::abs(best - x))
        best = candidate;
  return best;
}

/// Every vertex moved to the nearest centre or face along each axis: lines run through vertices, along edges and in the
/// planes of triangles; some triangles lose their area, some of the surface may pass through itself.
TriangleMesh snapped(const Grid& grid, const TriangleMesh& mesh)
{
  return mapped(mesh, [&](const Vec3& x) {
    return Vec3(nearest_coordinate(grid, 0, x[0]), nearest_coordinate(grid, 1, x[1]),
                nearest_coordinate(grid, 2, x[2]));
  });
}

TEST_F(OnGrids, NoPathPassesAClosedSurfaceUncounted)
{
  Chance chance(1);
  for (int n = 0; n < 1000; ++n)
    for (const Grid* grid : grids)
      ASSERT_TRUE(is_watertight(*grid, any_placed_surface(chance))) << n;
}

TEST_F(OnGrids, NoPathPassesAClosedSurfaceWithItsVerticesOnCentresAndFaces)
{
  Chance chance(2);
  for (int n = 0; n < 1000; ++n)
    for (const Grid* grid : grids)
      ASSERT_TRUE(is_watertight(*grid, snapped(*grid, any_placed_surface(chance)))) << n;
}

TEST_F(OnGrids, NoPathPassesAClosedSurfaceOneUnitInTheLastPlaceOffCentresAndFaces)
{
  Chance chance(3);
  for (int n = 0; n < 1000; ++n)
    for (const Grid* grid : grids)
      ASSERT_TRUE(is_watertight(*grid, jostled(snapped(*grid, any_placed_surface(chance)), chance))) << n;
}

TEST_F(OnGrids, NoPathPassesASheetThatSpansTheGrid)
{
  Chance chance(4);
  for (int n = 0; n < 1000; ++n)
    for (const Grid* grid : grids)
      ASSERT_TRUE(is_watertight(*grid, any_spanning_sheet(chance))) << n;
}

/// (x, y, z) -> turned cyclically `times` times.
Vec3 turned_axes(const Vec3& x, int times)
{
  return {x[(3 - times) % 3], x[(4 - times) % 3], x[(5 - times) % 3]};
}

TEST_F(OnGrids, NoPathPassesAFoldOnAGridLineOrAPlaneThroughCentres)
{
  // Slopes 0, +-1 and +-2 keep vertices, creases and planes of triangles on the centres of the uniform grid.
  int hits = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const int left : {-2, -1, 0, 1, 2})
      for (const int right : {-2, -1, 0, 1, 2})
        for (const double offset : {0.0, 0.125}) {
          const auto fold = mapped(test::sheet(8), [&](const Vec3& x) {
            const double along = 4.0 * x[0];
            const Vec3 folded(along + offset, 4.0 * x[1] + offset, (along < 0.0 ? -left : right) * along + offset);
            return turned_axes(folded, axis);
          });
          ASSERT_TRUE(is_watertight(uniform, fold)) << axis << left << right << offset;
          hits += static_cast<int>(crossings(uniform, fold).size());
        }
  EXPECT_GT(hits, 0);
}

TEST_F(OnGrids, EveryLineIsCutAnEvenNumberOfTimesByAClosedSurface)
{
  Chance chance(5);
  for (int n = 0; n < 300; ++n)
    for (const Grid* grid : grids) {
      const auto hits = crossings(*grid, snapped(*grid, any_placed_surface(chance)));
      const auto line = [](const Crossing& hit) {
        Index3 cell = hit.cell;
        cell[hit.axis] = 0;
        return std::tuple(hit.axis, cell);
      };
      std::map<decltype(line(hits[0])), int> count;
      for (const Crossing& hit : hits)
        ++count[line(hit)];
      for (const auto& [key, number] : count)
        ASSERT_EQ(number % 2, 0);
    }
}

TEST_F(OnGrids, CellsInsideATurnedCubeAreThoseInsideByItsFormula)
{
  Chance chance(6);
  int inside_cells = 0;
  for (int n = 0; n < 300; ++n)
    for (const Grid* grid : grids) {
      const Mat3 turn = chance.turn();
      const Vec3 where = 0.2 * chance.vector();
      const double size = 0.5 + 0.1 * chance.number();
      const auto number = test::winding(
          grid->ranks(), test::net_crossings(grid->ranks(), crossings(*grid, placed(test::cube(), turn, size, where))));
      for (int k = 0; k < cells; ++k)
        for (int j = 0; j < cells; ++j)
          for (int i = 0; i < cells; ++i) {
            const bool inside = (turn.transpose() * (grid->centre(i, j, k) - where)).cwiseAbs().maxCoeff() < size;
            ASSERT_EQ(number(i, j, k), inside ? 1 : 0);
            inside_cells += inside;
          }
    }
  EXPECT_GT(inside_cells, 10000);
}

TEST_F(OnGrids, ASheetInAPlaneOfCentresIsHitOncePerLineAtThetaZero)
{
  for (const Grid* grid : grids)
    for (int axis = 0; axis < 3; ++axis) {
      const int plane = 5;
      const auto sheet = mapped(test::sheet(3), [&](const Vec3& x) {
        Vec3 y = turned_axes(4.0 * x, (axis + 1) % 3);
        y[axis] = grid->centre(axis, plane);
        return y;
      });
      const auto hits = crossings(*grid, sheet);
      ASSERT_EQ(hits.size(), cells * cells);
      for (const Crossing& hit : hits) {
        EXPECT_EQ(hit.axis, axis);
        EXPECT_EQ(hit.cell[axis], plane + 1);
        EXPECT_EQ(hit.theta, 0.0);
        EXPECT_EQ(hit.side, 1);
      }
    }
}

TEST_F(OnGrids, ASheetInAPlaneOfFacesIsHitOncePerLineAtItsFace)
{
  for (int axis = 0; axis < 3; ++axis) {
    const auto sheet = mapped(test::sheet(6), [&](const Vec3& x) {
      Vec3 y = turned_axes(4.0 * x, (axis + 1) % 3);
      y[axis] = uniform.face(axis, 7);
      return y;
    });
    const auto hits = crossings(uniform, sheet);
    ASSERT_EQ(hits.size(), cells * cells);
    for (const Crossing& hit : hits) {
      EXPECT_EQ(hit.axis, axis);
      EXPECT_EQ(hit.cell[axis], 7);
      EXPECT_DOUBLE_EQ(hit.theta, 0.5);
    }
  }
}

TEST_F(OnGrids, ADiagonalPlaneThroughCentresCutsTheLinksOnOneSideOfEachCentre)
{
  // x = y through the centres: half-open intervals on every axis would cut x and y links on different sides of P.
  const auto plane = mapped(test::sheet(2), [](const Vec3& x) { return Vec3(4.0 * x[0], 4.0 * x[0], 4.0 * x[1]); });
  const auto hits = crossings(uniform, plane);
  ASSERT_TRUE(is_watertight(uniform, plane));
  ASSERT_EQ(hits.size(), 2 * (cells - 1) * cells);
  for (const Crossing& hit : hits) {
    EXPECT_EQ(hit.cell[0] - hit.cell[1], hit.axis == 0 ? 1 : 0);
    EXPECT_EQ(hit.theta, hit.axis == 0 ? 0.0 : std::nextafter(1.0, 0.0));
    EXPECT_EQ(hit.side, hit.axis == 0 ? 1 : -1);  // the normal is along (1, -1, 0)
  }
}

TEST_F(OnGrids, AVertexOfAnyNumberOfTrianglesOnACentreIsHitOnce)
{
  Chance chance(7);
  const Vec3 centre = uniform.centre(6, 6, 6);
  for (int corners = 3; corners < 40; ++corners) {
    TriangleMesh fan;
    fan.vertices.push_back(centre);
    for (int c = 0; c < corners; ++c) {
      const double angle = 2.0 * M_PI * c / corners;
      fan.vertices.push_back(centre + Vec3(std::cos(angle), std::sin(angle), 0.5 * chance.number()));
      fan.triangles.push_back({0, 1 + c, 1 + (c + 1) % corners});
    }
    int along_z = 0;
    for (const Crossing& hit : crossings(uniform, fan))
      if (hit.axis == 2 && hit.cell[0] == 6 && hit.cell[1] == 6) {
        ++along_z;
        const bool at_centre = (hit.cell[2] == 7 && hit.theta == 0.0) || (hit.cell[2] == 6 && 1.0 - hit.theta < 1e-15);
        EXPECT_TRUE(at_centre) << hit.cell[2] << ' ' << hit.theta;
      }
    ASSERT_EQ(along_z, 1);
  }
}

/// Largest distance between the hit on its link and the one its weights give, over the triangle's size.
double misplacement(const Grid& grid, const TriangleMesh& mesh, const Crossing& hit)
{
  Vec3 on_link = grid.centre(hit.cell[0], hit.cell[1], hit.cell[2]);
  on_link[hit.axis] = grid.centre(hit.axis, hit.cell[hit.axis] - 1);
  Vec3 offset = -hit.theta * grid.distance(hit.axis, hit.cell[hit.axis]) * Vec3::Unit(hit.axis);
  double size = 0.0;
  for (int m = 0; m < 3; ++m) {
    const Vec3& corner = mesh.vertices[mesh.triangles[hit.triangle][m]];
    offset += hit.weights[m] * (corner - on_link);
    size = std::max(size, (corner - mesh.vertices[mesh.triangles[hit.triangle][(m + 1) % 3]]).norm());
  }
  return offset.norm() / size;
}

TEST_F(OnGrids, WeightsReproduceTheHitToRoundOffOfTheTriangleSizeEvenWhenSeenEdgeOn)
{
  Chance chance(8);
  std::array<double, 2> largest{};
  std::array<int, 2> count{};
  for (int n = 0; n < 2000; ++n)
    for (const Grid* grid : grids) {
      // Edge on: the sheet holds a line of z but for a lean, and its shadow is a sliver askew to x and y.
      const bool edge_on = n % 2 == 1;
      const double lean = std::exp2(-40.0 + 5.0 * chance.number());
      const Vec3 along(1.0, chance.number(), 0.0);
      const auto sheet = mapped(test::sheet(1), [&](const Vec3& x) {
        const double height = 1.1 * x[1];
        const Vec3 lines_end(grid->centre(0, 6), grid->centre(1, 6), height);
        return Vec3(lines_end + x[0] * along + lean * (height + 0.5 * chance.number()) * Vec3::UnitX());
      });
      const auto mesh = edge_on ? sheet : any_placed_surface(chance);
      for (const Crossing& hit : crossings(*grid, mesh)) {
        EXPECT_GE(*std::min_element(hit.weights.begin(), hit.weights.end()), 0.0);
        EXPECT_NEAR(hit.weights[0] + hit.weights[1] + hit.weights[2], 1.0, 4e-16);
        largest[edge_on] = std::max(largest[edge_on], misplacement(*grid, mesh, hit));
        count[edge_on] += !edge_on || hit.axis == 2;
      }
    }
  // The areas that make the weights are right to 2^-45 of themselves.
  EXPECT_LT(largest[0], 0x1p-44);
  EXPECT_LT(largest[1], 0x1p-44);
  EXPECT_GT(count[1], 100);
  RecordProperty("misplacement", fmt::format("{:.1e}", largest[0]));
  RecordProperty("misplacement_edge_on", fmt::format("{:.1e}", largest[1]));
}

TEST_F(OnGrids, ScalingByAPowerOfTwoChangesNoBit)
{
  Chance chance(9);
  for (const double scale : {0x1p-60, 0x1p-3, 0x1p+60}) {
    auto faces = std::array{stretched_faces(0.1), stretched_faces(-0.2), stretched_faces(0.3)};
    for (auto& x : faces)
      for (double& face : x)
        face *= scale;
    const Grid scaled(MPI_COMM_SELF, faces, no_wrap);
    for (int n = 0; n < 100; ++n) {
      const auto mesh = jostled(snapped(stretched, any_placed_surface(chance)), chance);
      ASSERT_EQ(crossings(stretched, mesh),
                crossings(scaled, mapped(mesh, [&](const Vec3& x) { return Vec3(scale * x); })));
    }
  }
}

/// Coordinates cut to 40 binary places, so that moving them by a cell loses nothing.
TriangleMesh cut_short(const TriangleMesh& mesh)
{
  return mapped(mesh, [](const Vec3& x) { return Vec3(0x1p-40 * (0x1p+40 * x).array().round()); });
}

TEST_F(OnGrids, MovingBothByACellChangesNothingButTheCell)
{
  Chance chance(10);
  for (int n = 0; n < 300; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const auto surface = any_placed_surface(chance);
      const auto mesh = n % 2 == 0 ? cut_short(surface) : snapped(uniform, surface);
      auto hits = crossings(uniform, mesh);
      for (Crossing& hit : hits)
        ++hit.cell[axis];
      ASSERT_EQ(hits,
                crossings(uniform, mapped(mesh, [&](const Vec3& x) { return Vec3(x + 0.25 * Vec3::Unit(axis)); })));
    }
}

TEST_F(OnGrids, TurningTheAxesTurnsTheHits)
{
  Chance chance(11);
  const Grid turned(MPI_COMM_SELF, {stretched.faces(2), stretched.faces(0), stretched.faces(1)}, no_wrap);
  for (int n = 0; n < 100; ++n) {
    const auto mesh = any_placed_surface(chance);
    auto hits = crossings(stretched, mesh);
    for (Crossing& hit : hits) {
      hit.axis = (hit.axis + 1) % 3;
      hit.cell = {hit.cell[2], hit.cell[0], hit.cell[1]};
    }
    std::sort(hits.begin(), hits.end(), [](const Crossing& p, const Crossing& q) {
      return std::tuple(p.axis, p.cell[2], p.cell[1], p.cell[0], p.theta) <
             std::tuple(q.axis, q.cell[2], q.cell[1], q.cell[0], q.theta);
    });
    ASSERT_TRUE(hits == crossings(turned, mapped(mesh, [](const Vec3& x) { return turned_axes(x, 1); })));
  }
}

TEST_F(OnGrids, HitsAreSortedAndThetaIsAtLeastZeroAndBelowOne)
{
  Chance chance(12);
  for (int n = 0; n < 300; ++n)
    for (const Grid* grid : grids) {
      const auto hits = crossings(*grid, snapped(*grid, any_placed_surface(chance)));
      for (std::size_t m = 0; m < hits.size(); ++m) {
        ASSERT_GE(hits[m].theta, 0.0);
        ASSERT_LT(hits[m].theta, 1.0);
        const auto key = [&](std::size_t q) {
          const Crossing& hit = hits[q];
          return std::tuple(hit.axis, hit.cell[2], hit.cell[1], hit.cell[0], hit.theta, hit.triangle);
        };
        ASSERT_TRUE(m == 0 || key(m - 1) < key(m));
      }
    }
}

TEST(Crossings, LinksEndAtTheOutermostCentresUnlessTheAxisIsPeriodic)
{
  for (const bool wraps : {false, true}) {
    const Grid grid(MPI_COMM_SELF, cube_of(uniform_faces(4)), {wraps, false, false});
    // Sheets across x below the first centre, between centres, and beyond the last centre.
    for (const double x : {-1.5, -1.4375, -1.0, -0.625, -0.5625, -0.5}) {
      const auto sheet = mapped(test::sheet(2), [&](const Vec3& y) { return Vec3(x, 3.0 * y[0], 3.0 * y[1]); });
      const auto hits = crossings(grid, sheet);
      const bool outermost = x < -1.375 || x >= -0.625;
      ASSERT_EQ(hits.size(), outermost ? (wraps ? 32 : 0) : 16) << x;
      const double p = x < -1.375 ? -1.625 : x < -0.625 ? -1.125 : -0.625;
      for (const Crossing& hit : hits) {
        EXPECT_DOUBLE_EQ(hit.theta, (x - p) / 0.25);
        EXPECT_TRUE(outermost ? hit.cell[0] == 0 || hit.cell[0] == 4 : hit.cell[0] == 2);
      }
    }
  }
}

/// z = height + amplitude f(x, y) on a grid of 16 cells from -1.5 to 2.5, closed around x and y.
TriangleMesh wavy_sheet(double height, double amplitude)
{
  return cut_short(mapped(test::sheet(8), [&](const Vec3& x) {
    const double wave = 0.5 * (std::sin(M_PI * x[0]) + std::cos(M_PI * x[1]));
    return Vec3(0.5 + 2.0 * x[0], 0.5 + 2.0 * x[1], height + amplitude * wave);
  }));
}

TriangleMesh turned(const TriangleMesh& mesh, int times)
{
  return mapped(mesh, [&](const Vec3& x) { return turned_axes(x, times); });
}

TEST(Crossings, OfASheetThatMovesAroundAPeriodicGridMoveWithIt)
{
  constexpr int n = 16;
  const Grid grid(MPI_COMM_SELF, cube_of(uniform_faces(n)), {true, true, true});
  for (int axis = 0; axis < 3; ++axis)
    for (const double within_cell : {0.0625, 0.1875}) {  // below and above the centres
      const auto in_cell = [&](int cell) {
        return turned(wavy_sheet(-1.5 + 0.25 * cell + within_cell, 0.06), (axis + 1) % 3);
      };
      const auto first = crossings(grid, in_cell(7));
      ASSERT_EQ(first.size(), n * n);
      for (int cell = 0; cell < n; ++cell) {
        auto hits = crossings(grid, in_cell(cell));
        auto expected = first;
        for (Crossing& hit : expected)
          hit.cell[axis] = (hit.cell[axis] + cell - 7 + n) % n;
        EXPECT_EQ(hits.size(), expected[0].cell[axis] == 0 ? 2 * n * n : n * n);
        std::erase_if(hits, [&](const Crossing& hit) { return hit.cell[axis] == n; });
        ASSERT_TRUE(hits == expected) << axis << ' ' << cell;
      }
    }
}

TEST(Crossings, BothFacesOfAWrapAroundLinkListTheSameHits)
{
  constexpr int n = 16;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid grid(MPI_COMM_SELF, cube_of(uniform_faces(n)), {axis != 0, axis != 1, axis != 2});
    for (const double height : {0.0, 0.125, 0.3}) {
      const auto mesh = turned(wavy_sheet(height, 0.8), (axis + 1) % 3);
      ASSERT_TRUE(is_watertight(grid, mesh));
      std::vector<Crossing> low;
      std::vector<Crossing> high;
      for (Crossing hit : crossings(grid, mesh)) {
        if (hit.cell[hit.axis] == 0)
          low.push_back(hit);
        if (hit.cell[hit.axis] == n) {
          hit.cell[hit.axis] = 0;
          high.push_back(hit);
        }
      }
      EXPECT_FALSE(low.empty());
      EXPECT_TRUE(low == high);
    }
  }
}

TEST(Crossings, ASlabHasNoLinksAcrossItAndSheetsSealItBetweenTheSymmetryPlanes)
{
  const Grid slab(MPI_COMM_SELF, {uniform_faces(), uniform_faces(), {0.0, 0.25}}, no_wrap);
  Chance chance(14);
  for (int n = 0; n < 300; ++n) {
    const double angle = n % 4 == 0 ? M_PI / 4.0 * chance.index(8) : M_PI * chance.number();
    const auto sheet = mapped(test::sheet(7), [&](const Vec3& x) {
      return Vec3(9.0 * std::cos(angle) * x[0], 9.0 * std::sin(angle) * x[0], 0.125 + 0.125 * x[1]);
    });
    ASSERT_TRUE(is_watertight(slab, sheet)) << angle;
    for (const Crossing& hit : crossings(slab, sheet))
      ASSERT_NE(hit.axis, 2);
  }
}

TEST(Crossings, AnOpenSheetIsHitOnlyWithinItsShadow)
{
  const Grid grid(MPI_COMM_SELF, cube_of(uniform_faces()), no_wrap);
  // |x|, |y| <= .5 at z = .05: lines at +-.125 and +-.375.
  const auto sheet = mapped(test::sheet(4), [](const Vec3& x) { return Vec3(0.5 * x[0], 0.5 * x[1], 0.05); });
  const auto hits = crossings(grid, sheet);
  ASSERT_EQ(hits.size(), 16);
  for (const Crossing& hit : hits) {
    EXPECT_EQ(hit.axis, 2);
    EXPECT_EQ(hit.cell[2], 6);
    EXPECT_NEAR(hit.theta, 0.7, 1e-15);
    for (const int d : {0, 1})
      EXPECT_TRUE(hit.cell[d] >= 4 && hit.cell[d] < 8);
  }
}

TEST(Crossings, TrianglesWithoutAreaAreNotHit)
{
  const Grid grid(MPI_COMM_SELF, cube_of(uniform_faces()), no_wrap);
  const Vec3 a(-1.125, -1.125, -1.125);
  const Vec3 b(1.125, 1.125, 1.125);
  const std::vector<Vec3> points{a, b, 0.5 * (a + b)};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 1, 1}, {2, 2, 2}};
  EXPECT_TRUE(find_crossings(grid, points, triangles).empty());
  EXPECT_TRUE(find_crossings(grid, {}, {}).empty());
}

}  // namespace
}  // namespace luff::immersed
