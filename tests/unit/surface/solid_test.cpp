// SPDX-License-Identifier: BSD-3-Clause
// Volume, centroid and inertia of what a surface encloses.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/surfaces.hpp"
#include "surface/generators.hpp"
#include "surface/solid.hpp"

namespace luff::surface {
namespace {

TEST(Solid, OfATurnedAndMovedBoxIsExact)
{
  const Vec3 half(0.7, 1.1, 0.4);
  test::Chance chance(5);
  const Mat3 turn = chance.turn();
  const Vec3 where(3.0, -2.0, 5.0);
  const Solid box =
      solid(test::mapped(test::cube(), [&](const Vec3& x) { return Vec3(where + turn * half.cwiseProduct(x)); }));
  const double volume = 8.0 * half.prod();
  const Vec3 squares = half.cwiseAbs2();
  const Vec3 principal = volume / 3.0 * (squares.sum() * Vec3::Ones() - squares);
  EXPECT_NEAR(box.volume, volume, 1e-13 * volume);
  EXPECT_LE((box.centroid - where).norm(), 1e-13);
  EXPECT_LE((box.inertia - turn * principal.asDiagonal() * turn.transpose()).norm(), 1e-13 * principal.norm());
}

TEST(Solid, OfAnInsideOutSurfaceHasANegativeVolumeUntilItIsReversed)
{
  TriangleMesh ball = test::sphere(3);
  const double volume = solid(ball).volume;
  reverse(ball);
  EXPECT_NEAR(solid(ball).volume, -volume, 1e-14);
  EXPECT_LE((solid(ball).centroid).norm(), 1e-14);
}

TEST(Solid, BetweenASurfaceAndThePlanesThatItsEdgesLieOnNeedsNoLids)
{
  // A quarter of a tube between two planes across its axis and one along it: the other two axes each meet one plane.
  const int around = 64;
  const TriangleMesh quarter = cylinder({.frame = {.centre = {0, 0, 1}, .axis = Vec3::UnitZ()},
                                         .radius = 2,
                                         .length = 0.5,
                                         .angle = {0, 90},
                                         .divisions = {around, 1}});
  const double area = 0.5 * around * 4.0 * std::sin(0.5 * std::numbers::pi / around);
  for (int axis = 0; axis < 2; ++axis) {
    const Solid slice = solid(quarter, {axis, 0.0});
    EXPECT_NEAR(slice.volume, 0.5 * area, 1e-13);
    EXPECT_NEAR(slice.centroid[2], 1.25, 1e-13);
    EXPECT_NEAR(slice.centroid[0], slice.centroid[1], 1e-13);
    EXPECT_NEAR(slice.centroid[0], 8.0 / (3.0 * std::numbers::pi), 1e-3);  // of a true quarter circle
    EXPECT_NEAR(slice.inertia(0, 0), slice.inertia(1, 1), 1e-13);
  }
}

}  // namespace
}  // namespace luff::surface
