// SPDX-License-Identifier: BSD-3-Clause
// Forces on vertices that are closer to each other than cells.
#include <random>

#include <gtest/gtest.h>

#include "immersed/vertex_patches.hpp"
#include "support/curvilinear.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

grid::Grid box_of(const Index3& cells)
{
  std::array<std::vector<double>, 3> faces;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i <= cells[a]; ++i)
      faces[a].push_back(-1.0 + 2.0 * i / cells[a]);
  return {MPI_COMM_SELF, std::move(faces), {false, false, false}};
}

/// The same box, its inside waved.
grid::Grid waved_box_of(const Index3& cells)
{
  const auto map = [](const Vec3& s) -> Vec3 { return 2.0 * test::Waved{.amplitude = 0.1}(s)-Vec3::Ones(); };
  return {MPI_COMM_SELF, cells, test::mapped_nodes(cells, map), {false, false, false}};
}

/// A bowl, finer than the grid, and not evenly so.
surface::TriangleMesh bowl(int divisions)
{
  surface::TriangleMesh mesh = surface::rectangle({.origin = Vec3(-0.6, -0.6, 0.0),
                                                   .a = Vec3(1.2, 0.0, 0.0),
                                                   .b = Vec3(0.0, 1.2, 0.0),
                                                   .divisions = {divisions, divisions}});
  for (Vec3& x : mesh.vertices)
    x = Vec3(x[0] + 0.1 * x[0] * x[0], x[1] + 0.05 * x[0], 0.5 * x.squaredNorm());
  return mesh;
}

std::vector<Vec3> random_vectors(std::size_t count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Vec3> all(count);
  for (Vec3& v : all)
    v = Vec3(number(random), number(random), number(random));
  return all;
}

VertexPatches patches_of(const grid::Grid& grid, const surface::TriangleMesh& mesh)
{
  VertexPatches patches(mesh.triangles, mesh.n_vertices());
  patches.update(grid, mesh.vertices);
  return patches;
}

void expect_force_moment_and_work_kept(const grid::Grid& grid)
{
  const surface::TriangleMesh mesh = bowl(23);
  const VertexPatches patches = patches_of(grid, mesh);
  ASSERT_TRUE(patches.any());
  const std::vector<Vec3> force = random_vectors(mesh.vertices.size());
  const std::vector<Vec3> none(force.size(), Vec3::Zero());
  const SheetLoads spread = patches.spread({force, none});
  const std::vector<Vec3> velocity = random_vectors(2 * force.size());
  const std::vector<Vec3> u(velocity.begin() + static_cast<std::ptrdiff_t>(force.size()), velocity.end());
  const std::vector<Vec3> seen = patches.seen(u);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  double work = 0.0;
  for (std::size_t v = 0; v < force.size(); ++v) {
    EXPECT_EQ(spread.plus[v], Vec3(Vec3::Zero()));
    sum += spread.minus[v] - force[v];
    moment += mesh.vertices[v].cross(spread.minus[v] - force[v]);
    work += spread.minus[v].dot(u[v]) - force[v].dot(seen[v]);
  }
  const auto size = static_cast<double>(force.size());
  EXPECT_LE(sum.norm(), 1e-15 * size);
  EXPECT_LE(moment.norm(), 1e-15 * size);
  EXPECT_LE(std::abs(work), 1e-15 * size);
}

TEST(VertexPatches, KeepForceMomentAndWork)
{
  expect_force_moment_and_work_kept(box_of({10, 12, 8}));
  expect_force_moment_and_work_kept(waved_box_of({10, 12, 8}));
}

/// Where no vertex lies on the edge of what another reaches.
TEST(VertexPatches, InABoxGivenByItsNodesAreThoseOfTheCartesianGrid)
{
  const Index3 cells{10, 12, 8};
  const auto map = [](const Vec3& s) -> Vec3 { return 2.0 * s - Vec3::Ones(); };
  const grid::Grid nodes(MPI_COMM_SELF, cells, test::mapped_nodes(cells, map), {false, false, false});
  ASSERT_EQ(nodes.kind(), grid::Kind::Curvilinear);
  surface::TriangleMesh mesh = bowl(23);
  mesh.vertices[7] += Vec3(-0.9, 0.0, 0.0);  // outside: the nearest cell counts
  const std::vector<Vec3> force = random_vectors(mesh.vertices.size());
  const std::vector<Vec3> expected = patches_of(box_of(cells), mesh).spread({force, force}).minus;
  const std::vector<Vec3> spread = patches_of(nodes, mesh).spread({force, force}).minus;
  for (std::size_t v = 0; v < force.size(); ++v)
    EXPECT_LE((spread[v] - expected[v]).norm(), 1e-12) << v;
}

/// Patches are found anew where the vertices have moved to.
TEST(VertexPatches, FollowTheVertices)
{
  const grid::Grid grid = waved_box_of({10, 12, 8});
  surface::TriangleMesh mesh = bowl(23);
  VertexPatches patches = patches_of(grid, mesh);
  for (Vec3& x : mesh.vertices)
    x += Vec3(0.11, -0.07, 0.05);
  patches.update(grid, mesh.vertices);
  const std::vector<Vec3> force = random_vectors(mesh.vertices.size());
  EXPECT_EQ(patches.spread({force, force}).plus, patches_of(grid, mesh).spread({force, force}).plus);
}

void expect_rigid_motions_seen(const grid::Grid& grid)
{
  // The second is a strip one triangle wide whose rims are further apart than cells: its patches are lines.
  for (const surface::TriangleMesh& mesh : {bowl(23), surface::rectangle({.origin = Vec3(-0.8, 0.1, -0.5),
                                                      .a = Vec3(1.5, 0.2, 0.0),
                                                      .b = Vec3(0.0, 0.0, 0.9),
                                                      .divisions = {31, 1}})}) {
    const VertexPatches patches = patches_of(grid, mesh);
    ASSERT_TRUE(patches.any());
    std::vector<Vec3> u;
    for (const Vec3& x : mesh.vertices)
      u.push_back(Vec3(0.3, -0.2, 1.0) + Vec3(2.0, 1.0, -0.5).cross(x));
    const std::vector<Vec3> seen = patches.seen(u);
    for (std::size_t v = 0; v < u.size(); ++v)
      EXPECT_LE((seen[v] - u[v]).norm(), 2e-14) << v;
  }
}

TEST(VertexPatches, LetTheFlowSeeRigidMotionsAsTheyAre)
{
  expect_rigid_motions_seen(box_of({10, 12, 8}));
  expect_rigid_motions_seen(waved_box_of({10, 12, 8}));
}

TEST(VertexPatches, AreNoneWhereTheMeshIsNoFinerThanTheGrid)
{
  const grid::Grid grid = box_of({10, 12, 8});
  const surface::TriangleMesh coarse = surface::rectangle(
      {.origin = Vec3(-0.5, -0.5, 0.0), .a = Vec3(1.0, 0.0, 0.0), .b = Vec3(0.0, 1.0, 0.0), .divisions = {5, 6}});
  const VertexPatches patches = patches_of(grid, coarse);
  EXPECT_FALSE(patches.any());
  const std::vector<Vec3> force = random_vectors(coarse.vertices.size());
  EXPECT_EQ(patches.spread({force, force}).minus, force);
  EXPECT_EQ(patches.seen(force), force);
}

/// Hits along z bring a force for each cell, to the vertex in its middle.
TEST(VertexPatches, MakeAnEvenLoadOfHitsThatComeOncePerCell)
{
  const grid::Grid grid = box_of({10, 10, 10});
  constexpr double spacing = 0.04;  // a fifth of a cell
  const surface::TriangleMesh mesh = surface::rectangle({.origin = Vec3(-0.78, -0.78, 0.0),
                                                         .a = Vec3(39 * spacing, 0.0, 0.0),
                                                         .b = Vec3(0.0, 39 * spacing, 0.0),
                                                         .divisions = {39, 39}});
  std::vector<Vec3> force;
  for (const Vec3& x : mesh.vertices) {
    const Vec3 cells = (x + Vec3::Ones()) / 0.2 - Vec3(0.5, 0.5, 0.0);
    const bool hit =
        std::abs(cells[0] - std::round(cells[0])) < 0.01 && std::abs(cells[1] - std::round(cells[1])) < 0.01;
    force.push_back((hit ? 0.04 : 0.0) * Vec3::UnitZ());
  }
  const std::vector<Vec3> spread = patches_of(grid, mesh).spread({force, force}).minus;
  double largest = 0.0;
  double least = 100.0;
  for (std::size_t v = 0; v < force.size(); ++v)
    if (mesh.vertices[v].cwiseAbs().maxCoeff() < 0.5) {
      largest = std::max(largest, spread[v][2] / (spacing * spacing));
      least = std::min(least, spread[v][2] / (spacing * spacing));
    }
  std::cout << "  force per area between " << least << " and " << largest << " of the mean, before between 0 and 25\n";
  EXPECT_GE(least, 0.9);
  EXPECT_LE(largest, 1.2);
}

}  // namespace
}  // namespace luff::immersed
