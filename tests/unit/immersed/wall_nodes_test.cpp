// SPDX-License-Identifier: BSD-3-Clause
// Nodes beside a sheet: linear flows exact on either side, donors on the node's own side, the closest point found.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "immersed/wall_nodes.hpp"
#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"
#include "support/surfaces.hpp"
#include "surface/closest_points.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

using grid::Grid;

constexpr Index3 cells{10, 11, 12};
constexpr std::array<bool, 3> no_wrap{false, false, false};

const surface::Rectangle tilted{
    .origin = {0.25, 0.3, 0.2}, .a = {0.5, 0.21, 0.1}, .b = {-0.1, 0.3, 0.4}, .divisions = {6, 6}};
/// It spans the grids below.
const surface::Rectangle wide{.origin = tilted.origin - 3.0 * (tilted.a + tilted.b),
                              .a = 7.0 * tilted.a,
                              .b = 7.0 * tilted.b,
                              .divisions = {20, 20}};

template <class Velocity>
SheetMotion moving(const surface::TriangleMesh& mesh, Velocity velocity)
{
  SheetMotion sheet{mesh.vertices, {}, std::vector<Vec3>(mesh.vertices.size(), Vec3::Zero()), mesh.triangles};
  for (const Vec3& x : mesh.vertices)
    sheet.velocity.push_back(velocity(x));
  return sheet;
}

/// Nodes of a sheet in a grid, and a velocity field that they have not touched yet.
struct Nodes {
  template <class Velocity>
  Nodes(const Grid& g, const SheetMotion& sheet, Velocity velocity)
      : grid(g), links(g), nodes(g), u(make_field3<double>(g.owned()))
  {
    auto U = make_field3<double>(g.owned());
    links.freeze(sheet, 0.1, 1.0, {views(std::as_const(U)), views(std::as_const(U)), 0.0});
    nodes.freeze(links);
    for_each_cell_in_order(g.owned().grown(1), [&](int i, int j, int k) {
      const Vec3 v = velocity(g.centre(i, j, k));
      for (int d = 0; d < 3; ++d)
        u[d](i, j, k) = v[d];
    });
    for (const CutCell& cut : links.cells())
      for (int d = 0; d < 3; ++d)
        u[d].view()(cut.cell) = NAN;
    nodes.reconstruct(links, {1.0}, views(u));
  }
  [[nodiscard]] Vec3 centre(std::size_t n) const
  {
    const auto [i, j, k] = links.cells()[n].cell;
    return grid.centre(i, j, k);
  }

  const Grid& grid;
  CutLinks links;
  WallNodes nodes;
  Field3<double> u;
};

/// Two linear flows that meet on the sheet, which follows them.
Vec3 kinked(const Vec3& x)
{
  const Vec3 normal = tilted.a.cross(tilted.b).normalized();
  Mat3 gradient;
  gradient << 0.3, -1.0, 0.2, 0.5, 0.1, -0.7, 0.4, 0.9, -0.4;
  return Vec3(1.0, -0.5, 0.2) + gradient * x + std::max(normal.dot(x - tilted.origin), 0.0) * Vec3(2.0, -3.0, 1.0);
}

void expect_kinked_flow_exact(const Grid& grid)
{
  const Nodes found(grid, moving(surface::rectangle(wide), kinked), kinked);
  ASSERT_GT(found.nodes.nodes().size(), 100u);
  const Vec3 normal = tilted.a.cross(tilted.b).normalized();
  int compared = 0;
  for (std::size_t n = 0; n < found.nodes.nodes().size(); ++n) {
    const WallNode& node = found.nodes.nodes()[n];
    const Index3& cell = found.links.cells()[n].cell;
    const double height = normal.dot(found.centre(n) - tilted.origin);
    EXPECT_NEAR(node.distance, std::abs(height), 1e-12);
    EXPECT_EQ(node.plus, height > 0.0);
    bool inner = true;  // neither does it take from beyond the sides, nor does a node that it takes from
    for (int axis = 0; axis < 3; ++axis)
      inner = inner && cell[axis] > 1 && cell[axis] < cells[axis] - 2;
    if (!inner)
      continue;
    EXPECT_TRUE(node.on_patch);
    for (int k = 0; k < node.donors; ++k) {
      const auto [i, j, l] = node.donor[k];
      EXPECT_GT(height * normal.dot(grid.centre(i, j, l) - tilted.origin), 0.0) << "a donor across the sheet";
    }
    EXPECT_LE((at(views(found.u), cell) - kinked(found.centre(n))).norm(), 1e-12);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(WallNodes, HaveTheExactVelocityOfLinearFlowsOnBothSidesOfASheetInAStretchedGrid)
{
  expect_kinked_flow_exact(
      Grid(MPI_COMM_SELF,
           {test::stretched_faces(0, 1, cells[0], 0.3), test::stretched_faces(0, 1, cells[1], -0.2),
            test::stretched_faces(0, 1, cells[2], 0.2)},
           no_wrap));
}

TEST(WallNodes, HaveItOnSkewedCellsOfBothHands)
{
  const test::Waved map{};
  expect_kinked_flow_exact(Grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, map), no_wrap));
  const auto mirrored = [map](const Vec3& s) { return map({s[1], s[0], s[2]}); };
  expect_kinked_flow_exact(Grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, mirrored), no_wrap));
}

TEST(WallNodes, BetweenTwoSheetsInOneRowOfCellsHaveTheVelocityOfBoth)
{
  const auto faces = test::stretched_faces(0, 1, 10, 0.0);
  const Grid grid(MPI_COMM_SELF, {faces, faces, faces}, no_wrap);
  const auto sheet_at = [](double y) {
    return surface::rectangle(
        {.origin = {-1, y, -1}, .a = 3 * Vec3::UnitX(), .b = 3 * Vec3::UnitZ(), .divisions = {4, 4}});
  };
  // Couette flow between y = 0.42 and 0.48; the row in between has its centres at 0.45.
  SheetMotion sheets = moving(sheet_at(0.42), [](const Vec3&) -> Vec3 { return Vec3::Zero(); });
  const SheetMotion upper = moving(sheet_at(0.48), [](const Vec3&) -> Vec3 { return Vec3::UnitX(); });
  const int vertices = static_cast<int>(sheets.position.size());
  for (std::size_t v = 0; v < upper.position.size(); ++v) {
    sheets.position.push_back(upper.position[v]);
    sheets.velocity.push_back(upper.velocity[v]);
    sheets.acceleration.push_back(upper.acceleration[v]);
  }
  for (const auto& [a, b, c] : upper.triangles)
    sheets.triangles.push_back({a + vertices, b + vertices, c + vertices});
  const Nodes found(grid, sheets, [](const Vec3&) -> Vec3 { return {7.0, 7.0, 7.0}; });
  EXPECT_EQ(found.nodes.counts().none, 100);
  const auto u = views(found.u);
  EXPECT_NEAR(u[0](5, 4, 5), 0.5, 1e-12);
  EXPECT_NEAR(u[1](5, 4, 5), 0.0, 1e-12);
}

TEST(WallNodes, StartWithTheVelocityTheyHadAndForgetItWithTheSpeedOfTheFlow)
{
  const auto faces = test::stretched_faces(0, 1, 10, 0.0);
  const Grid grid(MPI_COMM_SELF, {faces, faces, faces}, no_wrap);
  const SheetMotion still = moving(surface::rectangle(wide), [](const Vec3&) -> Vec3 { return Vec3::Zero(); });
  const Vec3 stream(1.0, 0.5, -0.3);
  Nodes found(grid, still, [&](const Vec3&) { return stream; });
  auto old = make_field3<double>(grid.owned());
  for (int d = 0; d < 3; ++d)
    old[d].fill(stream[d]);
  found.nodes.start_offsets(found.links, views(std::as_const(old)));
  found.nodes.reconstruct(found.links, {0.0}, views(found.u));
  for (const CutCell& cut : found.links.cells())
    EXPECT_LE((at(views(found.u), cut.cell) - stream).norm(), 1e-14);
  const WallNode& node = found.nodes.nodes()[0];
  EXPECT_NEAR(node.decay_time, 0.1, 1e-12) << "a cell's width over the speed";
  found.nodes.reconstruct(found.links, {1.0}, views(found.u));
  const Vec3 offset = (1.0 - node.distance / node.reach) * stream;
  EXPECT_LE((at(views(found.u), found.links.cells()[0].cell) - (stream - (1.0 - std::exp(-1.0)) * offset)).norm(),
            1e-14);
}

TEST(SurfaceWalk, FindsTheClosestPointOfAllTriangles)
{
  const surface::TriangleMesh mesh = test::sphere(3);
  const SurfaceWalk walk(mesh.vertices, mesh.triangles);
  std::mt19937 engine(7);
  std::normal_distribution<double> component;
  for (int n = 0; n < 50; ++n) {
    const Vec3 x = (0.9 + 0.004 * n) * Vec3(component(engine), component(engine), component(engine)).normalized();
    double least = 1e300;
    for (const auto& [a, b, c] : mesh.triangles)
      least =
          std::min(least, surface::point_triangle({x, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}).distance);
    const SurfacePoint found = walk.closest(x, (37 * n) % mesh.n_triangles());
    EXPECT_NEAR((x - found.place).norm(), least, 1e-14);
    const auto& [a, b, c] = mesh.triangles[found.triangle];
    EXPECT_LE((found.weights[0] * mesh.vertices[a] + found.weights[1] * mesh.vertices[b] +
               found.weights[2] * mesh.vertices[c] - found.place)
                  .norm(),
              1e-14);
  }
}

// Which of them a point on an edge is first found on is left to round-off.
TEST(SurfaceWalk, KnowsAllTrianglesThatAPointLiesOn)
{
  const surface::TriangleMesh mesh = test::sphere(2);
  const SurfaceWalk walk(mesh.vertices, mesh.triangles);
  const auto holding = [&](const std::vector<int>& vertices) {
    std::vector<int> found;
    for (int e = 0; e < mesh.n_triangles(); ++e)
      if (std::all_of(vertices.begin(), vertices.end(), [&](int v) {
            return std::find(mesh.triangles[e].begin(), mesh.triangles[e].end(), v) != mesh.triangles[e].end();
          }))
        found.push_back(e);
    return found;
  };
  for (int e = 0; e < mesh.n_triangles(); ++e) {
    const auto& [a, b, c] = mesh.triangles[e];
    const Vec3 corner = 1.1 * mesh.vertices[a];
    const Vec3 edge = 0.55 * (mesh.vertices[a] + mesh.vertices[b]);
    const Vec3 middle = 0.36 * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]);
    EXPECT_EQ(walk.triangles_at(walk.closest(corner, e)), holding({a}));
    EXPECT_EQ(walk.triangles_at(walk.closest(edge, e)), holding({a, b}));
    EXPECT_EQ(walk.triangles_at(walk.closest(middle, e)), std::vector<int>{e});
  }
}

}  // namespace
}  // namespace luff::immersed
