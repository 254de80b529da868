// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/predicates.hpp"

#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace luff::immersed {
namespace {

__extension__ using Wide = __int128;

int sign_of(auto value)
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
    ASSERT_EQ(sign_of(computed), sign_of(exact));
    ASSERT_LE(std::abs(computed - double(exact)), 0x1p-45 * std::abs(double(exact)));
    const double plain = (points[0][0] - points[2][0]) * (points[1][1] - points[2][1]) -
                         (points[0][1] - points[2][1]) * (points[1][0] - points[2][0]);
    cancelled += sign_of(plain) != sign_of(exact);
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

/// Points with whole coordinates far from the origin, close to one plane and a line in it, so that the volume is all
/// cancellation.
struct NearlyCoplanar {
  std::array<std::array<std::int64_t, 3>, 4> whole;

  explicit NearlyCoplanar(std::mt19937_64& bits)
  {
    const auto number = [&](std::int64_t n) { return std::uniform_int_distribution<std::int64_t>(-n, n)(bits); };
    const std::array<std::int64_t, 3> s{number(1 << 10), number(1 << 10), number(1 << 10)};
    const std::array<std::int64_t, 3> t{s[0] + number(1), s[1] + number(1), s[2] + number(1)};
    for (auto& point : whole) {
      const std::int64_t along = number(1 << 30);
      const std::int64_t across = number(1 << 30);
      for (int d = 0; d < 3; ++d)
        point[d] = (1LL << 50) / (3 + d) + along * s[d] + across * t[d] + number(1);
    }
  }
  Vec3 operator[](int m) const { return {double(whole[m][0]), double(whole[m][1]), double(whole[m][2])}; }
  Wide volume() const
  {
    const auto u = [&](int m, int d) { return Wide(whole[m][d] - whole[3][d]); };
    Wide sum = 0;
    for (int d = 0; d < 3; ++d)
      sum += u(0, d) * (u(1, (d + 1) % 3) * u(2, (d + 2) % 3) - u(1, (d + 2) % 3) * u(2, (d + 1) % 3));
    return sum;
  }
};

TEST(Volume, HasTheSignOfWholeNumberArithmeticAndIsRightToRoundOff)
{
  std::mt19937_64 bits(2);
  int cancelled = 0;
  for (int n = 0; n < 20000; ++n) {
    const NearlyCoplanar points(bits);
    const Wide exact = points.volume();
    const PlainVolume plain(points[0], points[1], points[2], points[3]);
    ASSERT_EQ(sign_of_volume(points[0], points[1], points[2], points[3]), sign_of(exact));
    ASSERT_LE(std::abs(plain.value - double(exact)), plain.error());
    ASSERT_DOUBLE_EQ(volume(points[0], points[1], points[2], points[3], 0.0), double(exact));
    cancelled += sign_of(plain.value) != sign_of(exact);
  }
  EXPECT_GT(cancelled, 100);  // plain arithmetic would have failed
}

TEST(Volume, IsExactWhereDifferencesOfCoordinatesAreNotRepresentable)
{
  // a - d, b - d and c - d are in one plane but for the last bit of 1 + 2^-52, which their rounded differences lose.
  const Vec3 d = Vec3::Constant(0x1p-60);
  const Vec3 b(2.0, 2.0, 5.0);
  const Vec3 c(-1.0, -1.0, 3.0);
  EXPECT_EQ(sign_of_volume({1.0 + 0x1p-52, 1.0, 7.0}, b, c, d), 1);
  EXPECT_EQ(sign_of_volume({1.0, 1.0 + 0x1p-52, 7.0}, b, c, d), -1);
  EXPECT_EQ(sign_of_volume({1.0, 1.0, 7.0}, b, c, d), 0);
}

TEST(SignOfCross, SeesTheLastBit)
{
  const Vec3 from(1.0, 2.0, 3.0);
  const Vec3 to(2.0, 4.0, 6.0);
  const Vec3 p = Vec3(0x1p-60, 0x1p-60, 0.0);
  EXPECT_EQ(sign_of_cross(from, to, {0.5, 1.0, 1.5}, {1.0, 2.0, 3.0}, 2), 0);
  EXPECT_EQ(sign_of_cross(from, to, p, {1.0, 2.0, 0.0}, 2), 1);  // 1 (2 - 2^-60) - 2 (1 - 2^-60) = 2^-60
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
