// SPDX-License-Identifier: BSD-3-Clause
// The implicit scheme in steps far beyond those of the explicit one.
#include <iostream>

#include <gtest/gtest.h>

#include "support/plates.hpp"

namespace luff::test {
namespace {

/// Flow between walls at y = 0 and 1, set in motion at t = 0 by a force per mass along x.
struct StartingChannel {
  double viscosity = 0.1;
  double force = 1.0;

  [[nodiscard]] double velocity(double y, double t) const
  {
    double u = 0.5 * force / viscosity * y * (1.0 - y);
    for (int n = 1; n < 200; n += 2) {
      const double k = n * std::numbers::pi;
      u -= 4.0 * force / (viscosity * k * k * k) * std::exp(-viscosity * k * k * t) * std::sin(k * y);
    }
    return u;
  }
};

TEST(ImplicitScheme, StartsAChannelWithThinCellsAtItsWallsWithoutOscillation)
{
  const StartingChannel exact;
  fluid::Boundaries sides = all_sides(fluid::SideKind::Periodic, fluid::VectorFunction::uniform(Vec3::Zero()));
  sides[1] = {fluid::SideBoundary{.kind = fluid::SideKind::Wall}, fluid::SideBoundary{.kind = fluid::SideKind::Wall}};
  TestFlow flow({stretched_faces(0, 1, 4, 0), stretched_faces(0, 1, 48, -0.95), stretched_faces(0, 1, 4, 0)}, sides,
                {.scheme = fluid::TimeScheme::NewtonKrylov,
                 .viscosity = exact.viscosity,
                 .acceleration = fluid::VectorFunction::uniform(exact.force * Vec3::UnitX())});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  const double dt = 0.0025;
  double worst = 0.0;
  int iterations = 0;
  for (int n = 0; n < 40; ++n) {
    flow.advance(dt, 1);
    iterations = std::max(iterations, flow.solver.newton().krylov_iterations);
    if (n < 2)
      continue;  // the layer at the walls is thinner than a step resolves
    for (int j = 0; j < 48; ++j) {
      const double u = flow.solver.state().u[0](1, j, 2);
      worst = std::max(
          worst, std::abs(u - exact.velocity(flow.grid.centre(1, j, 2)[1], flow.t)) / exact.velocity(0.5, flow.t));
    }
  }
  std::cout << "  diffusion number " << dt * flow.solver.diffusive_rate() << ", largest error " << 100.0 * worst
            << " % of the velocity in the middle, " << iterations << " Krylov iterations at most in a step\n";
  EXPECT_GE(dt * flow.solver.diffusive_rate(), 50.0);
  EXPECT_LE(worst, 0.01);
  EXPECT_LE(iterations, 15);
}

/// Force coefficients on a plate at 70 degrees, Re = 100, at t = 1.5.
Vec3 force_on_plate(fluid::TimeScheme scheme, int steps, double& cfl)
{
  const double h = 0.05;
  const Slab slab{.x = {-4.0, 5.0, 100 + 12, grid::Refinement{-0.8, 1.2, h}},
                  .y = {-3.0, 3.0, 32 + 28, grid::Refinement{-0.8, 0.8, h}},
                  .depth = h,
                  .stream = 1.0,
                  .viscosity = 0.01};
  const Plate plate{.degrees = 70.0, .centre = {0.007, 0.003, 0.0}};
  const auto flow = make_flow(slab, MPI_COMM_WORLD, {.scheme = scheme, .viscosity = slab.viscosity});
  const double dt = 1.5 / steps;
  flow->advance(dt, steps - 1, plate.at(0.0, slab.depth));
  cfl = dt * flow->solver.convective_rate();
  flow->step(dt, plate.at(0.0, slab.depth));
  EXPECT_LE(flow->largest_divergence, 1e-13);
  return coefficients(total_force(flow->solver.loads()), slab.depth);
}

TEST(ImplicitScheme, GivesThePlateOfTheExplicitOneInStepsEightTimesAsLong)
{
  double cfl = 0.0;
  const Vec3 fine = force_on_plate(fluid::TimeScheme::Rk3, 120, cfl);
  const Vec3 coarse = force_on_plate(fluid::TimeScheme::NewtonKrylov, 15, cfl);
  std::cout << "  explicit (" << fine[0] << ", " << fine[1] << "), implicit at CFL " << cfl << " (" << coarse[0] << ", "
            << coarse[1] << ")\n";
  EXPECT_GE(cfl, 4.0);
  EXPECT_LE((coarse - fine).norm(), 0.02 * fine.norm());
}

}  // namespace
}  // namespace luff::test
