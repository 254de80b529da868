// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/predicates.hpp"

#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace luff::immersed {
namespace {

__extension__ using Wide = __int128;

int sign(auto value)
{
  return (value > 0) - (value < 0);
}

/// Points with whole coordinates far from the origin, close to one line, so that the area is all cancellation.
struct NearlyCollinear {
  std::array<std::array<std::int64_t, 2>, 3> whole;

  explicit NearlyCollinear(std::mt19937_64& bits)
  {
    const auto number = [&](std::int64_t n) { return std::uniform_int_distribution<std::int64_t>(-n, n)(bits); };
    const std::int64_t dx = number(1 << 20);
    const std::int64_t dy = number(1 << 20);
    for (auto& point : whole) {
      const std::int64_t along = number(1LL << 30);
      point = {(1LL << 52) / 3 + along * dx + number(1), (1LL << 51) / 7 + along * dy + number(1)};
    }
  }
  Point2 operator[](int m) const { return {double(whole[m][0]), double(whole[m][1])}; }
  Wide area() const
  {
    const auto& [a, b, q] = whole;
    return Wide(a[0] - q[0]) * (b[1] - q[1]) - Wide(a[1] - q[1]) * (b[0] - q[0]);
  }
};

TEST(Area, HasTheSignOfWholeNumberArithmeticAndIsRightToRoundOff)
{
  std::mt19937_64 bits(1);
  int cancelled = 0;
  for (int n = 0; n < 20000; ++n) {
    const NearlyCollinear points(bits);
    const Wide exact = points.area();
    const double computed = area(points[0], points[1], points[2]);
    ASSERT_EQ(sign(computed), sign(exact));
    ASSERT_LE(std::abs(computed - double(exact)), 0x1p-45 * std::abs(double(exact)));
    const double plain = (points[0][0] - points[2][0]) * (points[1][1] - points[2][1]) -
                         (points[0][1] - points[2][1]) * (points[1][0] - points[2][0]);
    cancelled += sign(plain) != sign(exact);
  }
  EXPECT_GT(cancelled, 100);  // plain arithmetic would have failed
}

TEST(Area, IsExactWhereDifferencesOfCoordinatesAreNotRepresentable)
{
  // from - q and to - q are parallel but for the last bit of 1 + 2^-52, which their rounded differences lose.
  const double tiny = 0x1p-60;
  const Point2 q{tiny, tiny};
  EXPECT_GT(area({1.0 + 0x1p-52, 1.0}, {2.0, 2.0}, q), 0.0);
  EXPECT_LT(area({1.0, 1.0 + 0x1p-52}, {2.0, 2.0}, q), 0.0);
  EXPECT_EQ(area({1.0, 1.0}, {2.0, 2.0}, q), 0.0);
  // (1 - t)(3 - 2 t) - (2 - 2 t)(1 - t) = 1 - t.
  const auto sum = exact_area({1.0, 2.0}, {1.0, 3.0}, {tiny, 2.0 * tiny});
  ASSERT_EQ(sum.count(), 2);
  EXPECT_EQ(sum.term(0), -tiny);
  EXPECT_EQ(sum.term(1), 1.0);
}

TEST(ExactSum, KeepsEveryBit)
{
  ExactSum<8> sum;
  for (const double term : {1.0, 0x1p-200, 0x1p+100, -1.0, -0x1p+100, 0x1p-300})
    sum.add(term);
  EXPECT_EQ(sum.count(), 2);
  EXPECT_EQ(sum.term(0), 0x1p-300);
  EXPECT_EQ(sum.term(1), 0x1p-200);
  sum.add_product(-0x1p-100, 0x1p-100);
  EXPECT_EQ(sum.value(), 0x1p-300);
}

}  // namespace
}  // namespace luff::immersed
