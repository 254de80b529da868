// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/passages.hpp"

#include <gtest/gtest.h>

namespace luff::poisson::test {
namespace {

/// Eight cells, 1 apart in x, 2 in y, 4 in z, with a sheet between x = 0 and 1 that is open in `open` of four faces.
Passages cube(int open)
{
  Passages passages;
  passages.reset(8);
  for (int a = 0; a < 8; ++a) {
    passages.lead_out(a, 1.5);
    for (const int step : {1, 2, 4})
      if ((a & step) == 0) {
        if (step > 1 || open-- > 0)
          passages.join(a, a + step, 1.0);
        else
          passages.part(a, a + step);
      }
  }
  return passages;
}

using Parts = std::vector<int>;

TEST(Passages, PartTheSidesOfASheetThatIsAllClosed)
{
  EXPECT_EQ(cube(0).parts(), (Parts{0, 1, 0, 1, 0, 1, 0, 1}));
}

TEST(Passages, JoinWhereThereIsNoSheet)
{
  EXPECT_FALSE(cube(4).has_sides());
  EXPECT_EQ(cube(4).parts(), Parts(8, 0));
}

TEST(Passages, PartSidesThatANarrowOneJoins)
{
  EXPECT_EQ(cube(1).parts(), (Parts{0, 1, 0, 1, 0, 1, 0, 1}));
}

// A side from which nothing leads out is no unknown of its own: only the passage tells its value.
TEST(Passages, JoinADeadEnd)
{
  Passages passages;
  passages.reset(3);
  passages.join(0, 1, 1e-3);
  passages.join(1, 2, 1.0);
  passages.part(0, 2);
  passages.lead_out(0, 1.0);
  EXPECT_EQ(passages.parts(), Parts(3, 0));
  passages.lead_out(2, 1.0);
  EXPECT_EQ(passages.parts(), (Parts{0, 1, 1}));
}

// The cut goes through the narrowest place of a chain, wherever its ends lie.
TEST(Passages, PartAtTheNarrowestPlace)
{
  Passages passages;
  passages.reset(4);
  passages.join(0, 1, 3.0);
  passages.join(1, 2, 0.5);
  passages.join(2, 3, 2.0);
  passages.part(0, 3);
  for (const int a : {0, 3})
    passages.lead_out(a, 1.0);
  EXPECT_EQ(passages.parts(), (Parts{0, 0, 2, 2}));
}

}  // namespace
}  // namespace luff::poisson::test
