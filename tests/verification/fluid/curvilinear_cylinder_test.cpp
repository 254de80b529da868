// SPDX-License-Identifier: BSD-3-Clause
// A closed body in a skewed grid: against the same in a Cartesian one, and against the momentum that the fluid loses.
#include <iostream>

#include <gtest/gtest.h>

#include "support/control_volume.hpp"
#include "support/curvilinear_plates.hpp"
#include "support/cylinders.hpp"

namespace luff::test {
namespace {

struct Drag {
  Vec3 crossings = Vec3::Zero();
  Vec3 momentum = Vec3::Zero();
  std::size_t inside = 0;  ///< cells
};

/// Re = 40 at t = 2, in cells of size 0.06 deformed.
Drag drag_on_cylinder(Deformation deformed)
{
  constexpr double h = 0.06;
  const Slab slab{.x = {.from = -5.0, .to = 5.0, .cells = 80, .refine = {{-1.2, 1.2, h}}},
                  .y = {.from = -5.0, .to = 5.0, .cells = 80, .refine = {{-1.2, 1.2, h}}},
                  .depth = h,
                  .stream = 1.0,
                  .viscosity = 1.0 / 40.0};
  const auto flow = make_curvilinear_flow(slab, deformed, {.viscosity = slab.viscosity});
  const SlabCylinder cylinder{.centre = {0.003, 0.007, 0.0}};
  IndexBox box = flow->grid.owned();
  for (int axis = 0; axis < 2; ++axis) {
    box.lo[axis] += 22;
    box.hi[axis] -= 22;
  }
  ControlVolume volume(*flow, box);
  Drag drag;
  constexpr double dt = 0.0125;
  for (int n = 0; n < 160; ++n) {
    flow->step(dt, cylinder.motion(slab.depth));
    drag.crossings = coefficients(total_force(flow->solver.loads()), slab.depth);
    flow->solver.accept();
    volume.record(dt);
  }
  drag.momentum = coefficients(volume.force(), slab.depth);
  drag.inside = flow->solver.links().inside().size();
  std::cout << "  drag " << drag.crossings[0] << ", by momentum " << drag.momentum[0] << ", lift " << drag.crossings[1]
            << "; divergence " << flow->largest_divergence << '\n';
  EXPECT_LE(flow->largest_divergence, 1e-13);
  return drag;
}

TEST(CylinderInASkewedGrid, FeelsTheDragOfTheCartesianOneAndWhatTheFluidLoses)
{
  const Drag straight = drag_on_cylinder(undeformed);
  const Drag skewed = drag_on_cylinder(skewed_around_origin);
  EXPECT_GT(skewed.inside, 0.9 * straight.inside);
  EXPECT_LE((skewed.crossings - skewed.momentum).norm(), 0.03 * skewed.momentum.norm());
  EXPECT_LE((skewed.crossings - straight.crossings).norm(), 0.03 * straight.crossings.norm());
}

}  // namespace
}  // namespace luff::test
