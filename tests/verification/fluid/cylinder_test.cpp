// SPDX-License-Identifier: BSD-3-Clause
// Cylinders, closed bodies: the forces on them against the momentum that the fluid loses.
#include <iostream>

#include <gtest/gtest.h>

#include "support/control_volume.hpp"
#include "support/cylinders.hpp"

namespace luff::test {
namespace {

Slab slab_around_cylinder(double h, double reach, double stream, double viscosity)
{
  const int cells = static_cast<int>(std::lround(2.4 / h));
  return {.x = {.from = -reach, .to = reach, .cells = cells + 44, .refine = {{-1.2, 1.2, h}}},
          .y = {.from = -reach, .to = reach, .cells = cells + 44, .refine = {{-1.2, 1.2, h}}},
          .depth = h,
          .stream = stream,
          .viscosity = viscosity};
}

class CylinderInAStream : public ::testing::TestWithParam<fluid::ImmersedScheme> {};
class CylinderThatSwings : public ::testing::TestWithParam<fluid::ImmersedScheme> {};

const auto both_schemes = ::testing::Values(fluid::ImmersedScheme::CutLink, fluid::ImmersedScheme::Curvib);
INSTANTIATE_TEST_SUITE_P(Schemes, CylinderInAStream, both_schemes);
INSTANTIATE_TEST_SUITE_P(Schemes, CylinderThatSwings, both_schemes);

TEST_P(CylinderInAStream, FeelsWhatTheFluidLosesWhileItsWakeGrows)
{
  const Slab slab = slab_around_cylinder(0.06, 6.0, 1.0, 1.0 / 40.0);
  const auto flow = make_flow(slab, MPI_COMM_WORLD, {.immersed = GetParam(), .viscosity = slab.viscosity});
  const SlabCylinder cylinder{.centre = {0.003, 0.007, 0.0}};
  ControlVolume volume(*flow, cylinder.centre, 1.0);
  for (int n = 0; n < 200; ++n) {
    flow->step(0.02, cylinder.motion(slab.depth));
    flow->solver.accept();
    volume.record(0.02);
  }
  const double drag = coefficients(total_force(flow->solver.loads()), slab.depth)[0];
  const double lost = coefficients(volume.force(), slab.depth)[0];
  std::cout << "  cylinder, Re = 40, t = 4, h = 0.06: C_d " << drag << ", by momentum " << lost << "\n";
  EXPECT_NEAR(drag, lost, 0.03 * lost);
  EXPECT_LE(flow->largest_divergence, 1e-13);
}

TEST_P(CylinderThatSwings, FeelsWhatTheFluidLosesWithoutTheFluidThatIsNotInside)
{
  // KC = 5, Re = 100, half a period.  The box's momentum holds that of the cells inside, which move with the cylinder.
  const Slab slab = slab_around_cylinder(0.06, 6.0, 0.0, 0.01);
  const auto flow = make_flow(slab, MPI_COMM_WORLD, {.immersed = GetParam(), .viscosity = slab.viscosity});
  const double frequency = 2.0 * std::numbers::pi / 5.0;
  const double amplitude = 1.0 / frequency;
  const auto at = [&](double t) {
    const double phase = frequency * t;
    return SlabCylinder{.centre = {-amplitude * std::sin(phase), 0.007, 0.0},
                        .velocity = {-std::cos(phase), 0.0, 0.0},
                        .acceleration = {frequency * std::sin(phase), 0.0, 0.0}};
  };
  const double dt = 0.0125;
  ControlVolume volume(*flow, Vec3::Zero(), 1.9);
  double sum = 0.0;
  double squares = 0.0;
  double largest = 0.0;
  for (int n = 1; n <= 200; ++n) {
    const SlabCylinder now = at(n * dt);
    flow->step(dt, now.motion(slab.depth));
    flow->solver.accept();
    volume.record(dt);
    if (n < 40)
      continue;
    const double drag = coefficients(total_force(flow->solver.loads()), slab.depth)[0];
    const Vec3 solid = SlabCylinder::volume(slab.depth) * now.acceleration;
    const double lost = coefficients(volume.force() + solid, slab.depth)[0];
    sum += drag - lost;
    squares += (drag - lost) * (drag - lost);
    largest = std::max(largest, std::abs(drag));
  }
  std::cout << "  swinging cylinder, h = 0.06: peak " << largest << ", force against momentum: mean difference "
            << sum / 161 << ", rms " << std::sqrt(squares / 161) << "\n";
  // 2.8 and 3.9 % here; it falls with h (docs/numerics/bodies.md).
  EXPECT_LE(std::abs(sum / 161), 0.04 * largest);
  EXPECT_LE(std::sqrt(squares / 161), 0.05 * largest);
  EXPECT_LE(flow->largest_divergence, 1e-13);
}

}  // namespace
}  // namespace luff::test
