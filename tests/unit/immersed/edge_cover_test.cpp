// SPDX-License-Identifier: BSD-3-Clause
// How much of a face the end of a sheet covers.
#include "immersed/edge_cover.hpp"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "support/faces.hpp"
#include "surface/generators.hpp"

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

std::vector<EdgeCover> covers_of(const grid::Grid& grid, const TriangleMesh& mesh)
{
  return edge_covers(grid, mesh.vertices, mesh.triangles, free_edges(mesh.triangles));
}

/// Covered area of all faces normal to an axis; a face that a sheet crosses is covered whole unless it is one of
/// `covers`.
double covered_area(const grid::Grid& grid, const TriangleMesh& mesh, std::span<const EdgeCover> covers, int axis)
{
  std::map<Index3, double> part;
  for (const Crossing& hit : find_crossings(grid, mesh.vertices, mesh.triangles))
    if (hit.axis == axis)
      part[hit.cell] = 1.0;
  for (const EdgeCover& cover : covers)
    if (cover.hit.axis == axis)
      part[cover.hit.cell] = cover.part;
  double area = 0.0;
  for (const auto& [cell, covered] : part)
    area += covered * grid.area(axis, cell[0], cell[1], cell[2]);
  return area;
}

double projected_area(const TriangleMesh& mesh, int axis)
{
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += std::abs(surface::area_vector(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])[axis]);
  return area;
}

TEST(EdgeCover, KnowsTheOutlineOfASheet)
{
  const TriangleMesh mesh = surface::rectangle({.divisions = {5, 3}, .pattern = surface::Pattern::Irregular});
  const std::vector<FreeEdge> edges = free_edges(mesh.triangles);
  EXPECT_EQ(edges.size(), 2 * (5 + 3));
  double length = 0.0;
  for (const FreeEdge& edge : edges)
    length += (mesh.vertices[edge.to] - mesh.vertices[edge.from]).norm();
  EXPECT_NEAR(length, 4.0, 1e-12);
}

/// Across the x axis: every face is covered by the overlap of two rectangles.
TEST(EdgeCover, IsTheOverlapOfAFaceWithASheetAcross)
{
  const grid::Grid grid = stretched_box();
  const TriangleMesh mesh = surface::rectangle({.origin = {0.43, 0.21, 0.33},
                                                .a = {0.0, 0.52, 0.0},
                                                .b = {0.0, 0.0, 0.41},
                                                .divisions = {7, 5},
                                                .pattern = surface::Pattern::Irregular});
  const auto overlap = [&](int axis, int i, double low, double high) {
    return std::max(0.0, std::min(high, grid.face(axis, i + 1)) - std::max(low, grid.face(axis, i)));
  };
  const auto exact = [&](int j, int k) {
    return overlap(1, j, 0.21, 0.73) * overlap(2, k, 0.33, 0.74) / (grid.width(1, j) * grid.width(2, k));
  };
  int in_part = 0;
  for (const EdgeCover& cover : covers_of(grid, mesh)) {
    if (cover.hit.axis != 0)
      continue;
    const auto [i, j, k] = cover.hit.cell;
    EXPECT_NEAR(cover.part, exact(j, k), 1e-12);
    EXPECT_NEAR(grid.centre(0, i - 1) + cover.hit.theta * grid.distance(0, i), 0.43, 1e-12);
    ++in_part;
  }
  int expected = 0;
  for (int k = 0; k < grid.cells()[2]; ++k)
    for (int j = 0; j < grid.cells()[1]; ++j)
      expected += exact(j, k) > 0.001 && exact(j, k) < 0.95 ? 1 : 0;
  EXPECT_GT(expected, 20);
  EXPECT_EQ(in_part, expected);
}

/// However a flat sheet lies, what it covers of faces is its projected area.
TEST(EdgeCover, AddsUpToTheProjectedAreaOfATiltedSheet)
{
  const grid::Grid grid = stretched_box();
  for (const double degrees : {5.0, 20.0, 45.0, 70.0}) {
    TriangleMesh mesh = surface::rectangle({.origin = {-0.26, -0.21, 0.0},
                                            .a = {0.52, 0.0, 0.0},
                                            .b = {0.0, 0.42, 0.0},
                                            .divisions = {31, 23},
                                            .pattern = surface::Pattern::Irregular});
    surface::rotate(mesh, Vec3(1.0, 0.7, 0.2).normalized(), degrees);
    surface::translate(mesh, {0.51, 0.48, 0.47});
    const std::vector<EdgeCover> covers = covers_of(grid, mesh);
    double area = 0.0;
    double error = 0.0;
    double error_without = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double exact = projected_area(mesh, axis);
      area += exact;
      error += std::abs(covered_area(grid, mesh, covers, axis) - exact);
      error_without += std::abs(covered_area(grid, mesh, {}, axis) - exact);
    }
    std::cout << "  " << degrees << " degrees: projected areas " << 100.0 * error / area
              << " % off, counted by crossings " << 100.0 * error_without / area << " %\n";
    EXPECT_LE(error, 0.01 * area);
  }
}

/// A strip as wide as the domain ends at its two ends only.
TEST(EdgeCover, CountsNoEdgeThatLiesInASideOfTheDomain)
{
  const grid::Grid grid(
      MPI_COMM_SELF,
      {test::stretched_faces(0, 1, 20, 0.0), test::stretched_faces(0, 1, 20, 0.0), std::vector{0.0, 0.05}},
      {false, false, true});
  TriangleMesh mesh = surface::rectangle(
      {.origin = {0.217, 0.313, 0.0}, .a = {0.5, 0.4, 0.0}, .b = {0.0, 0.0, 0.05}, .divisions = {17, 1}});
  const std::vector<EdgeCover> covers = covers_of(grid, mesh);
  ASSERT_FALSE(covers.empty());
  for (const EdgeCover& cover : covers) {
    const auto& [a, b, c] = mesh.triangles[cover.hit.triangle];
    const double along = (mesh.vertices[a][0] + mesh.vertices[b][0] + mesh.vertices[c][0]) / 3.0;
    EXPECT_TRUE(along < 0.3 || along > 0.6);
  }
  EXPECT_NEAR(covered_area(grid, mesh, covers, 0), projected_area(mesh, 0), 0.05 * 0.05 * 0.05);
  EXPECT_NEAR(covered_area(grid, mesh, covers, 1), projected_area(mesh, 1), 0.05 * 0.05 * 0.05);
}

/// A closed surface has no edge, and two sheets that meet edge to edge between two lines leave nothing open.
TEST(EdgeCover, OfSheetsThatMeetAddsUp)
{
  const grid::Grid grid = stretched_box();
  const double seam = grid.face(1, 9) + 0.3 * grid.width(1, 9);
  TriangleMesh mesh = surface::rectangle(
      {.origin = {0.43, -0.1, -0.1}, .a = {0.0, seam + 0.1, 0.0}, .b = {0.0, 0.0, 1.2}, .divisions = {9, 9}});
  const TriangleMesh other = surface::rectangle(
      {.origin = {0.43, seam, -0.1}, .a = {0.0, 1.1 - seam, 0.0}, .b = {0.0, 0.0, 1.2}, .divisions = {8, 7}});
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
  for (const EdgeCover& cover : covers_of(grid, mesh))
    EXPECT_EQ(cover.part, 1.0);
}

}  // namespace
}  // namespace luff::immersed
