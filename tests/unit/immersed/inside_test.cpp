// SPDX-License-Identifier: BSD-3-Clause
// Which cells lie inside closed bodies, and how rigid motions are found.
#include <map>

#include <gtest/gtest.h>

#include "immersed/inside.hpp"
#include "immersed/rigid_velocity.hpp"
#include "support/faces.hpp"
#include "support/surfaces.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

using test::TriangleMesh;

grid::Grid stretched_grid(const std::array<bool, 3>& periodic = {false, false, false})
{
  return {MPI_COMM_SELF,
          {test::stretched_faces(-2, 2, 16, 0.3), test::stretched_faces(-2, 2, 14, -0.2),
           test::stretched_faces(-2, 2, 12, 0.1)},
          periodic};
}

/// Surfaces together, each a body.
struct Bodies {
  explicit Bodies(const std::vector<TriangleMesh>& meshes)
  {
    for (const TriangleMesh& mesh : meshes) {
      surfaces.push_back({all.n_vertices(), mesh.n_vertices(), all.n_triangles(), mesh.n_triangles()});
      test::append(all, mesh);
    }
  }
  [[nodiscard]] std::vector<Crossing> crossings(const grid::Grid& grid) const
  {
    return find_crossings(grid, all.vertices, all.triangles);
  }
  [[nodiscard]] std::vector<InsideCell> inside(const grid::Grid& grid) const
  {
    return find_inside(grid, crossings(grid), surfaces);
  }

  TriangleMesh all;
  std::vector<ClosedSurface> surfaces;
};

/// Neighbours are on different sides exactly where the link between them is crossed an odd number of times.
void expect_sides_change_at_crossings_only(const grid::Grid& grid, const Bodies& bodies)
{
  Field<char> inside(grid.owned(), 0);
  for (const InsideCell& c : bodies.inside(grid))
    inside.view()(c.cell) = 1;
  std::map<std::array<int, 4>, int> hits;
  for (const Crossing& hit : bodies.crossings(grid))
    ++hits[{hit.axis, hit.cell[0], hit.cell[1], hit.cell[2]}];
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    for (int axis = 0; axis < 3; ++axis) {
      const Index3 next = stepped({i, j, k}, axis, 1);
      if (!grid.owned().contains(next))
        continue;
      const bool crossed = hits[{axis, next[0], next[1], next[2]}] % 2 == 1;
      EXPECT_EQ(inside(i, j, k) != inside.view()(next), crossed) << i << " " << j << " " << k << " axis " << axis;
    }
  });
}

TEST(Inside, HoldsTheCellsWhoseCentresLieWithinASphere)
{
  const grid::Grid grid = stretched_grid();
  const Vec3 centre(0.13, -0.21, 0.08);
  const Bodies ball({test::mapped(test::sphere(4), [&](const Vec3& x) { return Vec3(centre + 1.2 * x); })});
  Field<char> inside(grid.owned(), 0);
  for (const InsideCell& c : ball.inside(grid))
    inside.view()(c.cell) = 1;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const double r = (grid.centre(i, j, k) - centre).norm();
    if (std::abs(r - 1.2) > 0.02) {  // the sagitta of the triangles
      EXPECT_EQ(inside(i, j, k) == 1, r < 1.2);
    }
  });
}

TEST(Inside, ChangesAtCrossingsOnlyOnGrazedCubesAndTurnedSpheres)
{
  const grid::Grid grid = stretched_grid();
  // Faces, edges and corners in planes, lines and points of centres.
  const Vec3 low = grid.centre(4, 3, 3);
  const Vec3 high = grid.centre(11, 9, 8);
  const Bodies cube(
      {test::mapped(test::cube(), [&](const Vec3& x) { return Vec3((x.array() > 0.0).select(high, low)); })});
  expect_sides_change_at_crossings_only(grid, cube);
  EXPECT_EQ(cube.inside(grid).size(), 7u * 6u * 5u) << "of each pair of opposite faces one counts as inside";
  test::Chance chance(3);
  for (int n = 0; n < 20; ++n) {
    const Mat3 turn = chance.turn();
    const Vec3 where = grid.centre(8, 7, 6);
    expect_sides_change_at_crossings_only(
        grid, Bodies({test::mapped(test::sphere(1), [&](const Vec3& x) { return Vec3(where + turn * x); })}));
  }
}

TEST(Inside, KnowsRowsThatLieInsideAsAWholeFromTheirNeighbours)
{
  // A rod along x from side to side, without ends: no row is crossed along x.
  const grid::Grid grid = stretched_grid();
  const TriangleMesh rod = surface::cylinder(
      {.frame = {.centre = {-2, 0, 0}, .axis = Vec3::UnitX()}, .radius = 1.3, .length = 4, .divisions = {48, 2}});
  const Bodies bodies({rod});
  expect_sides_change_at_crossings_only(grid, bodies);
  const auto inside = bodies.inside(grid);
  std::size_t expected = 0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const Vec3 x = grid.centre(i, j, k);
    expected += std::hypot(x[1], x[2]) < 1.3 ? 1 : 0;
  });
  EXPECT_NEAR(double(inside.size()), double(expected), 16.0) << "but for one row that the flat sides may leave out";
}

TEST(Inside, HoldsTheUnionOfBodiesThatOverlapAndTheFirstOneClaimsACell)
{
  const grid::Grid grid = stretched_grid();
  const auto ball = [](double x) {
    return test::mapped(test::sphere(3), [x](const Vec3& X) { return Vec3(X + x * Vec3::UnitX()); });
  };
  const Bodies two({ball(-0.4), ball(0.43)});
  std::vector<std::size_t> alone;
  for (const double x : {-0.4, 0.43})
    alone.push_back(Bodies({ball(x)}).inside(grid).size());
  const auto inside = two.inside(grid);
  EXPECT_LT(inside.size(), alone[0] + alone[1]);
  EXPECT_GT(inside.size(), std::max(alone[0], alone[1]));
  EXPECT_EQ(std::count_if(inside.begin(), inside.end(), [](const InsideCell& c) { return c.body == 0; }),
            std::ptrdiff_t(alone[0]));
}

TEST(Inside, WrapsAroundPeriodicRows)
{
  const grid::Grid grid = stretched_grid({true, false, false});
  // Cut in two by the periodic side: the part beyond x = 2 comes back at x = -2.
  const auto half = [](double x) {
    return test::mapped(test::sphere(3), [x](const Vec3& X) { return Vec3(X + x * Vec3::UnitX()); });
  };
  const std::size_t whole = Bodies({half(0.05)}).inside(grid).size();
  TriangleMesh split = half(1.95);
  for (Vec3& x : split.vertices)
    x[0] = std::min(x[0], 2.0);
  const Bodies left({split});
  EXPECT_LT(left.inside(grid).size(), whole);
  expect_sides_change_at_crossings_only(grid, left);
}

TEST(RigidVelocity, IsFoundFromTheVelocitiesOfPoints)
{
  const TriangleMesh ball = test::sphere(2);
  const RigidVelocity exact{{0.3, 0.2, -0.1}, {1.0, -2.0, 0.5}, {0.4, 0.7, -1.1}};
  std::vector<Vec3> velocities;
  for (const Vec3& x : ball.vertices)
    velocities.push_back(exact.at(x));
  const RigidVelocity found = nearest_rigid_velocity(ball.vertices, velocities);
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(3, 1, 2), Vec3(-1, 0.5, 0.2)})
    EXPECT_LE((found.at(x) - exact.at(x)).norm(), 1e-13);
}

TEST(RigidVelocity, LeavesOutWhatPullsTowardsTheAxisOfAnAcceleration)
{
  const TriangleMesh ball = test::sphere(2);
  const Vec3 spin(0.0, 0.0, 2.0);
  const Vec3 spin_rate(0.0, 0.0, 0.7);
  std::vector<Vec3> accelerations;
  for (const Vec3& x : ball.vertices)
    accelerations.push_back(Vec3(1, 0, 0) + spin_rate.cross(x) + spin.cross(spin.cross(x)));
  const RigidVelocity found = nearest_rigid_velocity(ball.vertices, accelerations);
  EXPECT_LE((found.spin - spin_rate).norm(), 1e-13);
  EXPECT_LE((found.at(Vec3::Zero()) - Vec3(1, 0, 0)).norm(), 1e-13);
}

}  // namespace
}  // namespace luff::immersed
