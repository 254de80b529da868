// SPDX-License-Identifier: BSD-3-Clause
// Shear over time: how large it is, and how much it turns round.
#include <gtest/gtest.h>

#include "simulation/shear_history.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {
namespace {

TEST(ShearHistory, OfASteadyShearIsItsSizeAndDoesNotOscillate)
{
  ShearHistory history;
  for (const double dt : {0.1, 0.3, 0.05})
    history.add(std::vector<Vec3>{{3.0, 0.0, -4.0}, Vec3::Zero()}, dt);
  EXPECT_DOUBLE_EQ(history.mean_magnitude(0), 5.0);
  EXPECT_NEAR(history.oscillation(0), 0.0, 1e-15);
  EXPECT_EQ(history.mean_magnitude(1), 0.0);
  EXPECT_EQ(history.oscillation(1), 0.0);
}

TEST(ShearHistory, OfAShearThatReversesOscillatesByAHalf)
{
  ShearHistory history;
  history.add(std::vector<Vec3>{{0.0, 2.0, 0.0}}, 0.3);
  history.add(std::vector<Vec3>{{0.0, -6.0, 0.0}}, 0.1);
  EXPECT_DOUBLE_EQ(history.mean_magnitude(0), 3.0);
  EXPECT_NEAR(history.oscillation(0), 0.5, 1e-15);
  // Three quarters of it one way: (1 - 1/2)/2.
  ShearHistory mostly;
  mostly.add(std::vector<Vec3>{{1.0, 0.0, 0.0}}, 0.3);
  mostly.add(std::vector<Vec3>{{-1.0, 0.0, 0.0}}, 0.1);
  EXPECT_NEAR(mostly.oscillation(0), 0.25, 1e-15);
}

TEST(ShearHistory, IsEmptyBeforeAnythingWasAdded)
{
  EXPECT_EQ(ShearHistory{}.mean_magnitude(7), 0.0);
  EXPECT_EQ(ShearHistory{}.oscillation(7), 0.0);
}

/// A triangle that turns about an axis out of its plane.
Structure turning_triangle()
{
  RigidSheet sheet{.name = "vane",
                   .mesh = {{{0.0, 0.0, 0.0}, {1.0, 0.2, 0.0}, {0.3, 0.9, 0.4}}, {{0, 1, 2}}},
                   .motion = {},
                   .moves = true};
  sheet.motion.rotation = shell::Motion::Rotation{.axis = {1.0, 2.0, -0.5}, .angle = [](double t) { return 2.0 * t; }};
  return Structure(Shells{}, {sheet});
}

TEST(ShearHistory, OfASurfaceThatTurnsWithItsShearDoesNotOscillate)
{
  const Structure structure = turning_triangle();
  ShearHistory history;
  Vec3 normal_part = Vec3::Zero();
  for (int n = 0; n < 8; ++n) {
    const double t = 0.7 * n;
    const std::vector<Vec3> x = structure.accepted_positions(t);
    const Vec3 along = (x[1] - x[0]).normalized();
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    // What is normal to the surface is no shear.
    immersed::SideTraction traction;
    traction.shear = {2.0 * along + 0.3 * n * normal, -1.5 * normal.cross(along)};
    history.add(shear_in_surface(std::array{traction}, structure, t), 0.1);
    normal_part += 0.3 * n * normal;
  }
  EXPECT_GT(normal_part.norm(), 0.1);
  EXPECT_NEAR(history.mean_magnitude(0), 2.0, 1e-14);
  EXPECT_NEAR(history.mean_magnitude(1), 1.5, 1e-14);
  EXPECT_NEAR(history.oscillation(0), 0.0, 1e-14);
  EXPECT_NEAR(history.oscillation(1), 0.0, 1e-14);
}

}  // namespace
}  // namespace luff::simulation
