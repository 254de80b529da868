// SPDX-License-Identifier: BSD-3-Clause
// What sheets cover of faces beyond their ends.
#include "immersed/free_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "immersed/link_tree.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"
#include "support/surfaces.hpp"
#include "surface/generators.hpp"
#include "surface/mesh.hpp"

namespace luff::immersed {
namespace {

using surface::TriangleMesh;

grid::Grid stretched_box()
{
  return {MPI_COMM_SELF,
          {test::stretched_faces(0, 1, 20, 0.3), test::stretched_faces(0, 1, 18, -0.2),
           test::stretched_faces(0, 1, 22, 0.1)},
          {false, false, false}};
}

/// A box one cell wide.
grid::Grid slab()
{
  return {MPI_COMM_SELF,
          {test::stretched_faces(0, 1, 20, 0.0), test::stretched_faces(0, 1, 20, 0.0), std::vector{0.0, 0.05}},
          {false, false, true}};
}

struct Settled {
  std::vector<Crossing> hits;
  std::vector<double> covers;

  /// In faces.
  [[nodiscard]] double covered() const { return std::accumulate(covers.begin(), covers.end(), 0.0); }
};

Settled settled(const grid::Grid& grid, const TriangleMesh& mesh)
{
  const FadingSheets sheets(grid, mesh.vertices, mesh.triangles, free_edges(mesh.triangles));
  Settled result;
  if (grid.kind() == grid::Kind::Curvilinear)
    result.hits = make_link_tree(grid)->find_crossings(sheets.positions(), sheets.triangles());
  else
    result.hits = find_crossings(grid, sheets.positions(), sheets.triangles());
  result.covers = sheets.settle(result.hits);
  return result;
}

TEST(FreeEdges, AreTheOutlineOfASheet)
{
  const TriangleMesh mesh = surface::rectangle({.divisions = {5, 3}, .pattern = surface::Pattern::Irregular});
  const std::vector<FreeEdge> edges = free_edges(mesh.triangles);
  EXPECT_EQ(edges.size(), 2 * (5 + 3));
  double length = 0.0;
  for (const FreeEdge& edge : edges)
    length += (mesh.vertices[edge.to] - mesh.vertices[edge.from]).norm();
  EXPECT_NEAR(length, 4.0, 1e-12);
}

/// Across the x axis: the sheet covers the faces of the lines that cross it, and of those beyond as much as their
/// distance in their own cells leaves.
TEST(FreeEdges, FadeOutOverOneCell)
{
  const grid::Grid grid = stretched_box();
  const TriangleMesh mesh = surface::rectangle({.origin = {0.43, 0.21, 0.33},
                                                .a = {0.0, 0.52, 0.0},
                                                .b = {0.0, 0.0, 0.41},
                                                .divisions = {7, 5},
                                                .pattern = surface::Pattern::Irregular});
  const auto beyond = [&](int axis, int i, double low, double high) {
    return std::max({low - grid.centre(axis, i), grid.centre(axis, i) - high, 0.0}) / grid.width(axis, i);
  };
  const auto distance = [&](int j, int k) { return std::hypot(beyond(1, j, 0.21, 0.73), beyond(2, k, 0.33, 0.74)); };
  const Settled sheet = settled(grid, mesh);
  for (std::size_t q = 0; q < sheet.hits.size(); ++q) {
    const Crossing& hit = sheet.hits[q];
    ASSERT_EQ(hit.axis, 0);
    EXPECT_NEAR(sheet.covers[q], cover_beyond_edge(distance(hit.cell[1], hit.cell[2])), 1e-12);
    EXPECT_NEAR(grid.centre(0, hit.cell[0] - 1) + hit.theta * grid.distance(0, hit.cell[0]), 0.43, 1e-12);
    EXPECT_LT(hit.triangle, static_cast<int>(mesh.triangles.size()));
  }
  std::size_t expected = 0;
  for (int k = 0; k < grid.cells()[2]; ++k)
    for (int j = 0; j < grid.cells()[1]; ++j)
      expected += cover_beyond_edge(distance(j, k)) > 0.0 ? 1 : 0;
  EXPECT_EQ(sheet.hits.size(), expected);
  EXPECT_LT(sheet.covered(), static_cast<double>(expected) - 5.0);
}

/// A hit of a strip acts on the edge, so that it makes no force on vertices elsewhere.
TEST(FreeEdges, TakeHitsBeyondThemToTheNearestOfTheirPoints)
{
  const grid::Grid grid = slab();
  const TriangleMesh mesh = surface::rectangle(
      {.origin = {0.203, 0.313, 0.0}, .a = {0.5, 0.4, 0.0}, .b = {0.0, 0.0, 0.05}, .divisions = {17, 1}});
  const Settled sheet = settled(grid, mesh);
  const Vec3 along = Vec3(0.5, 0.4, 0.0).normalized();
  int before = 0;
  int after = 0;
  for (const Crossing& hit : sheet.hits) {
    Vec3 place = Vec3::Zero();
    for (int m = 0; m < 3; ++m)
      place += hit.weights[m] * mesh.vertices[mesh.triangles[hit.triangle][m]];
    Vec3 on_link = grid.centre(hit.cell);
    on_link[hit.axis] += (hit.theta - 1.0) * grid.distance(hit.axis, hit.cell[hit.axis]);
    const double length = std::hypot(0.5, 0.4);
    const double there = (on_link - Vec3(0.203, 0.313, 0.025)).dot(along);
    EXPECT_NEAR((place - Vec3(0.203, 0.313, place[2])).norm(), std::clamp(there, 0.0, length), 1e-12);
    before += there < 0.0 ? 1 : 0;
    after += there > length ? 1 : 0;
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(after, 0);
}

/// However a sheet slides through its own plane, what it covers changes by little at a time: no more than a face that
/// counts as covered from 0.95 on.
TEST(FreeEdges, CoverContinuouslyWhenTheSheetSlides)
{
  const grid::Grid grid = slab();
  for (const double degrees : {0.0, 5.0, 20.0, 45.0, 70.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
    double covered = 0.0;
    for (int step = 0; step <= 80; ++step) {
      const Vec3 origin = Vec3(0.31, 0.27, 0.0) + 0.0005 * step * along;  // a hundredth of a cell a step
      const Settled sheet = settled(
          grid, surface::rectangle({.origin = origin, .a = 0.4 * along, .b = {0.0, 0.0, 0.05}, .divisions = {11, 1}}));
      if (step > 0) {
        EXPECT_NEAR(sheet.covered(), covered, 0.08) << degrees << " degrees, step " << step;
      }
      covered = sheet.covered();
    }
  }
}

/// A strip as wide as the domain ends at its two ends only.
void expect_a_strip_to_fade_at_its_ends(const grid::Grid& grid)
{
  const TriangleMesh mesh = surface::rectangle(
      {.origin = {0.23, 0.32, 0.0}, .a = {0.5, 0.4, 0.0}, .b = {0.0, 0.0, 0.05}, .divisions = {17, 1}});
  const Settled sheet = settled(grid, mesh);
  const double length = std::hypot(0.5, 0.4);
  int at_start = 0;
  int at_end = 0;
  for (std::size_t q = 0; q < sheet.hits.size(); ++q) {
    if (sheet.covers[q] == 1.0)
      continue;
    const Vec3& x = mesh.vertices[mesh.triangles[sheet.hits[q].triangle][0]];
    const double along = (x - Vec3(0.23, 0.32, x[2])).norm();
    EXPECT_TRUE(along < 0.15 || along > length - 0.15);
    (along < 0.15 ? at_start : at_end) += 1;
  }
  EXPECT_GT(at_start, 0);
  EXPECT_GT(at_end, 0);
}

TEST(FreeEdges, AreNoneInASideOfTheDomain)
{
  expect_a_strip_to_fade_at_its_ends(slab());
}

/// Two sheets that meet edge to edge between two lines leave nothing open.
TEST(FreeEdges, OfSheetsThatMeetLeaveNothingOpen)
{
  const grid::Grid grid = stretched_box();
  for (const double part : {0.05, 0.3, 0.5, 0.9}) {
    const double seam = grid.face(1, 9) + part * grid.width(1, 9);
    TriangleMesh mesh = surface::rectangle(
        {.origin = {0.43, -0.3, -0.3}, .a = {0.0, seam + 0.3, 0.0}, .b = {0.0, 0.0, 1.6}, .divisions = {9, 9}});
    test::append(
        mesh,
        surface::rectangle(
            {.origin = {0.43, seam, -0.3}, .a = {0.0, 1.3 - seam, 0.0}, .b = {0.0, 0.0, 1.6}, .divisions = {8, 7}}));
    const Settled sheets = settled(grid, mesh);
    EXPECT_EQ(sheets.hits.size(), 18U * 22U);
    EXPECT_EQ(sheets.covered(), 18.0 * 22.0);
  }
}

/// Three sheets with corners, inside a box and up to its sides.
std::vector<TriangleMesh> sheets_in_a_box()
{
  return {surface::rectangle(
              {.origin = {0.203, 0.313, 0.21}, .a = {0.5, 0.4, 0.1}, .b = {0.0, 0.1, 0.43}, .divisions = {17, 13}}),
          surface::rectangle(
              {.origin = {0.43, 0.21, 0.0}, .a = {0.1, 0.52, 0.0}, .b = {0.0, 0.0, 1.0}, .divisions = {9, 15}}),
          surface::rectangle({.origin = {0.31, 0.27, 0.33},
                              .a = {0.43, 0.0, 0.12},
                              .b = {0.0, 0.41, 0.22},
                              .divisions = {11, 7},
                              .pattern = surface::Pattern::Irregular})};
}

TEST(FreeEdges, InABoxGivenByItsNodesCoverWhatTheyCoverOnTheCartesianGrid)
{
  const Index3 cells{20, 18, 22};
  std::array<std::vector<double>, 3> faces;
  for (int a = 0; a < 3; ++a)
    faces[a] = test::stretched_faces(0, 1, cells[a], 0.0);
  for (const bool periodic : {false, true}) {
    const std::array<bool, 3> wrap{false, false, periodic};
    const grid::Grid box(MPI_COMM_SELF, faces, wrap);
    const grid::Grid nodes(MPI_COMM_SELF, cells, test::mapped_nodes(cells, [](const Vec3& s) { return s; }), wrap);
    ASSERT_EQ(nodes.kind(), grid::Kind::Curvilinear);
    for (const TriangleMesh& mesh : sheets_in_a_box()) {
      const Settled expected = settled(box, mesh);
      const Settled sheet = settled(nodes, mesh);
      ASSERT_EQ(sheet.hits.size(), expected.hits.size());
      ASSERT_GT(sheet.covered(), 0.0);
      EXPECT_LT(sheet.covered(), static_cast<double>(sheet.hits.size()) - 5.0);
      for (std::size_t q = 0; q < sheet.hits.size(); ++q) {
        EXPECT_EQ(sheet.hits[q].axis, expected.hits[q].axis);
        EXPECT_EQ(sheet.hits[q].cell, expected.hits[q].cell);
        EXPECT_EQ(sheet.hits[q].triangle, expected.hits[q].triangle);
        EXPECT_NEAR(sheet.covers[q], expected.covers[q], 1e-12);
      }
    }
  }
}

/// All cells alike and oblique: the distance from the edge is that in index coordinates.
TEST(FreeEdges, FadeOutOverOneCellOfAnObliqueGrid)
{
  const Index3 cells{20, 18, 22};
  Mat3 map;
  map << 1.0, 0.5, 0.0, 0.2, 1.0, 0.3, -0.4, 0.0, 1.0;
  const auto oblique = [&](const Vec3& s) -> Vec3 { return map * s; };
  const grid::Grid grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, oblique), {});
  const Mat3 to_cells = Vec3(20.0, 18.0, 22.0).asDiagonal() * map.inverse();
  TriangleMesh mesh = surface::rectangle(
      {.origin = {0.203, 0.313, 0.31}, .a = {0.5, 0.4, 0.1}, .b = {0.0, 0.1, 0.43}, .divisions = {17, 13}});
  for (Vec3& x : mesh.vertices)
    x = map * x;
  const Settled sheet = settled(grid, mesh);
  int in_part = 0;
  for (std::size_t q = 0; q < sheet.hits.size(); ++q) {
    const Crossing& hit = sheet.hits[q];
    Vec3 place = Vec3::Zero();
    for (int m = 0; m < 3; ++m)
      place += hit.weights[m] * mesh.vertices[mesh.triangles[hit.triangle][m]];
    const Vec3 low = grid.centre(stepped(hit.cell, hit.axis, -1));
    const Vec3 on_link = low + hit.theta * (grid.centre(hit.cell) - low);
    EXPECT_NEAR(sheet.covers[q], cover_beyond_edge((to_cells * (on_link - place)).norm()), 1e-12);
    in_part += sheet.covers[q] < 1.0 ? 1 : 0;
  }
  EXPECT_GT(in_part, 50);
}

/// The sides along z are periodic.
TEST(FreeEdges, AreNoneInASideOfAWavedSlab)
{
  const Index3 cells{20, 20, 1};
  const auto waved = [](const Vec3& s) {
    const Vec3 x = test::Waved{.amplitude = 0.04}({s[0], s[1], 0.0});
    return Vec3(x[0], x[1], 0.05 * s[2]);
  };
  const grid::Grid grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, waved), {false, false, true});
  expect_a_strip_to_fade_at_its_ends(grid);
}

}  // namespace
}  // namespace luff::immersed
