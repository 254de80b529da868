// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "immersed/crossings.hpp"
#include "support/surfaces.hpp"

namespace luff::immersed {
namespace {

using grid::Grid;
using test::TriangleMesh;

std::array<std::vector<double>, 3> stretched_faces()
{
  constexpr std::array<int, 3> cells{13, 12, 10};
  std::array<std::vector<double>, 3> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= cells[axis]; ++i)
      faces[axis].push_back(std::sinh(1.5 * (2.0 * i / cells[axis] - 1.1 + 0.1 * axis)));
  return faces;
}

/// Spheres and sheets, some with vertices on the centre lines where blocks meet.
std::vector<TriangleMesh> surfaces(const Grid& grid)
{
  std::vector<TriangleMesh> meshes;
  test::Chance chance(1);
  for (int n = 0; n < 20; ++n) {
    const Mat3 turn = chance.turn();
    const Vec3 where = n % 2 == 0 ? grid.centre(6, 6, 5) : Vec3(0.3 * chance.vector());
    const auto place = [&](const Vec3& x) { return Vec3(where + turn * x); };
    meshes.push_back(test::mapped(test::sphere(2), place));
    meshes.push_back(test::mapped(test::sheet(5), place));
  }
  return meshes;
}

TEST(CrossingsOnRanks, AreBitForBitThoseOfOneRankThatHoldsTheWholeGrid)
{
  for (const std::array<bool, 3> periodic : {std::array{false, false, false}, std::array{true, true, true}}) {
    const Grid whole(MPI_COMM_SELF, stretched_faces(), periodic);
    const Grid shared(MPI_COMM_WORLD, stretched_faces(), periodic);
    for (const TriangleMesh& mesh : surfaces(whole)) {
      // Every rank expects, in the same order, the hits on its faces; those between two blocks belong to both.
      auto expected = find_crossings(whole, mesh.vertices, mesh.triangles);
      ASSERT_FALSE(expected.empty());
      std::erase_if(expected, [&](const Crossing& hit) { return !shared.owned().faces(hit.axis).contains(hit.cell); });
      EXPECT_TRUE(find_crossings(shared, mesh.vertices, mesh.triangles) == expected);
    }
  }
}

}  // namespace
}  // namespace luff::immersed
