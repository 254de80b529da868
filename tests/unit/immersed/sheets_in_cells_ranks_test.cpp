// SPDX-License-Identifier: BSD-3-Clause
// What depends on the cells around vertices and edges, which no rank of a curvilinear grid knows all.
#include <gtest/gtest.h>

#include "immersed/free_edges.hpp"
#include "immersed/link_tree.hpp"
#include "immersed/vertex_patches.hpp"
#include "support/curvilinear.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

grid::Grid waved_grid(MPI_Comm comm)
{
  const Index3 cells{13, 12, 10};
  return {comm, cells, test::mapped_nodes(cells, test::Waved{.amplitude = 0.1}), {false, false, true}};
}

/// From one side along z to the other; its last vertices lie outside.
surface::TriangleMesh sheet()
{
  return surface::rectangle(
      {.origin = {0.221, 0.313, 0.0}, .a = {0.87, 0.41, 0.0}, .b = {0.0, 0.0, 1.0}, .divisions = {31, 29}});
}

TEST(FreeEdgesOnRanks, CoverWhatTheyCoverOnOneRank)
{
  const surface::TriangleMesh mesh = sheet();
  const auto settled = [&](const grid::Grid& grid) {
    const FadingSheets sheets(grid, mesh.vertices, mesh.triangles, free_edges(mesh.triangles));
    auto hits = make_link_tree(grid)->find_crossings(sheets.positions(), sheets.triangles());
    const auto covers = sheets.settle(hits);
    return std::pair(hits, covers);
  };
  const grid::Grid shared = waved_grid(MPI_COMM_WORLD);
  const auto [hits, covers] = settled(shared);
  const auto [expected_hits, expected] = settled(waved_grid(MPI_COMM_SELF));
  std::size_t q = 0;
  int in_part = 0;
  for (std::size_t e = 0; e < expected.size(); ++e) {
    if (!shared.owned().faces(expected_hits[e].axis).contains(expected_hits[e].cell))
      continue;
    ASSERT_LT(q, hits.size());
    EXPECT_EQ(hits[q].axis, expected_hits[e].axis);
    EXPECT_EQ(hits[q].cell, expected_hits[e].cell);
    EXPECT_EQ(hits[q].triangle, expected_hits[e].triangle);
    EXPECT_NEAR(covers[q], expected[e], 1e-12);
    in_part += expected[e] < 1.0 ? 1 : 0;
    ++q;
  }
  EXPECT_EQ(q, hits.size());
  EXPECT_GT(shared.ranks().sum(in_part), 5.0);
}

TEST(VertexPatchesOnRanks, AreThoseOfOneRank)
{
  const surface::TriangleMesh mesh = sheet();
  std::vector<Vec3> force;
  for (const Vec3& x : mesh.vertices)
    force.push_back({std::sin(9.0 * x[0]), std::cos(7.0 * x[1]), std::sin(5.0 * x[2])});
  const auto spread = [&](const grid::Grid& grid) {
    VertexPatches patches(mesh.triangles, mesh.n_vertices());
    patches.update(grid, mesh.vertices);
    EXPECT_TRUE(patches.any());
    return patches.spread({force, force}).plus;
  };
  const std::vector<Vec3> shared = spread(waved_grid(MPI_COMM_WORLD));
  const std::vector<Vec3> expected = spread(waved_grid(MPI_COMM_SELF));
  std::vector<Vec3> of_first = shared;
  MPI_Bcast(of_first.data(), static_cast<int>(3 * of_first.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  EXPECT_EQ(shared, of_first);  // to the last bit
  for (std::size_t v = 0; v < force.size(); ++v)
    EXPECT_LE((shared[v] - expected[v]).norm(), 1e-12) << v;
}

}  // namespace
}  // namespace luff::immersed
