// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "support/links.hpp"
#include "support/surfaces.hpp"

namespace luff::immersed {
namespace {

using test::Links;

constexpr Index3 cells{13, 12, 10};

/// A bent, sheared block that repeats along all axes.
Vec3 centre(const Index3& c)
{
  const Vec3 x((c[0] + 0.5) / cells[0], (c[1] + 0.5) / cells[1], (c[2] + 0.5) / cells[2]);
  const auto wave = [](double s) { return 0.05 * std::sin(2.0 * M_PI * s); };
  return {2.0 * x[0] + 0.5 * x[1] + wave(x[1]), x[1] + 0.2 * x[2] + wave(x[2] + x[0]), 1.5 * x[2] + wave(x[0])};
}
const std::array<Vec3, 3> periods{Vec3(2.0, 0.0, 0.0), Vec3(0.5, 1.0, 0.0), Vec3(0.0, 0.2, 1.5)};

TEST(LinkTreeOnRanks, FindsBitForBitWhatOneRankFindsThatHoldsTheWholeGrid)
{
  test::Chance chance(1);
  for (const std::array<bool, 3> periodic : {std::array{false, false, false}, std::array{true, true, true}}) {
    const Links whole(MPI_COMM_SELF, cells, periodic, centre, periods);
    const Links shared(MPI_COMM_WORLD, cells, periodic, centre, periods);
    for (int n = 0; n < 40; ++n) {
      const Mat3 turn = chance.turn();
      const Vec3 where = centre(n % 2 == 0 ? Index3{6, 6, 5} : Index3{n % 13, n % 12, n % 10});
      const auto mesh = test::mapped(n % 4 < 2 ? test::sphere(2) : test::sheet(5),
                                     [&](const Vec3& x) { return Vec3(where + 0.5 * (turn * x)); });
      auto expected = whole.crossings(mesh);
      ASSERT_FALSE(expected.empty());
      std::erase_if(expected,
                    [&](const Crossing& hit) { return !shared.ranks.owned().faces(hit.axis).contains(hit.cell); });
      EXPECT_TRUE(shared.crossings(mesh) == expected);
    }
  }
}

}  // namespace
}  // namespace luff::immersed
