// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "parallel/decomposition.hpp"
#include "parallel/halo.hpp"

namespace luff {
namespace {

using Periodic = std::array<bool, 3>;

double value_of(const Index3& c)
{
  return c[0] + 100.0 * c[1] + 10000.0 * c[2];
}

/// The cell that a halo cell repeats; false when the halo lies beyond a side of the domain.
bool wrap(const Decomposition& ranks, Index3& c)
{
  for (int a = 0; a < 3; ++a) {
    const int n = ranks.cells()[a];
    if (c[a] >= 0 && c[a] < n)
      continue;
    if (!ranks.periodic(a))
      return false;
    c[a] = (c[a] + n) % n;
  }
  return true;
}

template <class T>
void expect_exact_halo(const Index3& cells, const Periodic& periodic)
{
  const Decomposition ranks(MPI_COMM_WORLD, cells, periodic);
  constexpr T untouched = T{-7};
  Field<T> field(ranks.owned(), untouched);
  const IndexBox& box = ranks.owned();
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        field(i, j, k) = static_cast<T>(value_of({i, j, k}));
  HaloExchange halo(ranks);
  halo.exchange({field.view()});
  const IndexBox with_halo = box.grown(1);
  for (int k = with_halo.lo[2]; k < with_halo.hi[2]; ++k)
    for (int j = with_halo.lo[1]; j < with_halo.hi[1]; ++j)
      for (int i = with_halo.lo[0]; i < with_halo.hi[0]; ++i) {
        Index3 c{i, j, k};
        const T expected = wrap(ranks, c) ? static_cast<T>(value_of(c)) : untouched;
        ASSERT_EQ(field(i, j, k), expected) << i << ' ' << j << ' ' << k << " on rank " << ranks.rank();
      }
}

TEST(HaloExchange, FillsFacesEdgesAndCornersBetweenBlocks)
{
  expect_exact_halo<double>({5, 9, 7}, {false, false, false});
}

TEST(HaloExchange, WrapsEveryCombinationOfPeriodicAxes)
{
  for (int bits = 1; bits < 8; ++bits)
    expect_exact_halo<double>({4, 6, 9}, {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
}

TEST(HaloExchange, TellsTheLowNeighbourFromTheHighOneWhenTwoBlocksWrapOntoEachOther)
{
  // Two blocks in line along a periodic axis: the same rank lies below and above.
  expect_exact_halo<double>({3, 8, 1}, {false, true, false});
  expect_exact_halo<double>({3, 1, 8}, {false, false, true});
  expect_exact_halo<float>({3, 8, 8}, {true, true, true});
}

TEST(HaloExchange, CarriesIntegers)
{
  expect_exact_halo<int>({4, 5, 6}, {true, false, true});
}

TEST(HaloExchange, SendsSeveralFieldsInOneMessage)
{
  const Decomposition ranks(MPI_COMM_WORLD, {4, 6, 6}, {true, true, true});
  Field<double> a(ranks.owned(), ranks.rank());
  Field<double> b(ranks.owned(), 10.0 + ranks.rank());
  HaloExchange halo(ranks);
  halo.exchange({a.view(), b.view()});
  const IndexBox box = ranks.owned();
  EXPECT_EQ(a(box.lo[0], box.lo[1] - 1, box.lo[2]), ranks.neighbours(1)[0]);
  EXPECT_EQ(b(box.lo[0], box.lo[1] - 1, box.lo[2]), 10.0 + ranks.neighbours(1)[0]);
  EXPECT_EQ(b(box.lo[0], box.lo[1], box.hi[2]), 10.0 + ranks.neighbours(2)[1]);
}

TEST(Decomposition, GivesEveryCellToExactlyOneRank)
{
  const Decomposition ranks(MPI_COMM_WORLD, {3, 7, 10}, {false, false, false});
  EXPECT_EQ(ranks.sum(static_cast<double>(ranks.owned().volume())), 3.0 * 7.0 * 10.0);
  EXPECT_EQ(ranks.owned().lo[0], 0);
  EXPECT_EQ(ranks.owned().hi[0], 3);
  EXPECT_EQ(ranks.blocks(1) * ranks.blocks(2), ranks.size());
}

TEST(Decomposition, LetsNoRankSwallowTheNotANumberOfAnother)
{
  const Decomposition ranks(MPI_COMM_WORLD, {3, 8, 8}, {false, false, false});
  EXPECT_EQ(ranks.max(ranks.rank()), ranks.size() - 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(ranks.max(ranks.rank() == 0 ? nan : 5.0)));
}

TEST(Decomposition, RefusesMoreRanksThanRows)
{
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size > 1) {
    EXPECT_THROW(Decomposition(MPI_COMM_WORLD, {8, 1, 1}, {false, false, false}), InputError);
  } else {
    EXPECT_NO_THROW(Decomposition(MPI_COMM_WORLD, {8, 1, 1}, {false, false, false}));
  }
}

}  // namespace
}  // namespace luff
