// SPDX-License-Identifier: BSD-3-Clause
// The ledger of the flow's energy.
#include <iostream>

#include <gtest/gtest.h>

#include "fluid/flow_energy.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/flow.hpp"

namespace luff::test {
namespace {

/// Over one step, as fractions of the dissipation.
struct LedgerErrors {
  double dissipation = 0.0;  ///< against the exact one
  double missing = 0.0;      ///< what the ledger lacks
};

/// Taylor-Green's vortices decay by 2 nu k^2 2 E and nothing else.
LedgerErrors taylor_green(int n)
{
  const TaylorGreen exact{.viscosity = 0.02, .stream = {0.3, -0.2, 0.0}};
  TestFlow flow(
      {stretched_faces(0.0, 1.0, n, 0.15), stretched_faces(0.0, 1.0, n, -0.15), stretched_faces(0.0, 0.1, 1, 0)},
      all_sides(fluid::SideKind::Periodic, exact.function()), {.density = 2.0, .viscosity = exact.viscosity});
  flow.solver.start(exact.function(), 0.0);
  const double dt = 0.2 / n;
  flow.advance(dt, n / 2);
  flow.solver.fill_halos();
  const fluid::FlowEnergy before = fluid::energy(flow.solver, flow.t);
  flow.advance(dt, 1);
  flow.solver.fill_halos();
  const fluid::FlowEnergy after = fluid::energy(flow.solver, flow.t);
  const double decay = std::exp(-4.0 * exact.viscosity * exact.k * exact.k * flow.t);
  const double dissipation = 2.0 * exact.viscosity * exact.k * exact.k * 0.5 * decay * 0.1 * 2.0;  // rho V <u'^2>
  EXPECT_EQ(after.sides, 0.0);
  EXPECT_EQ(after.body_force, 0.0);
  return {
      std::abs(after.dissipation / dissipation - 1.0),
      std::abs((after.kinetic - before.kinetic) / dt + 0.5 * (before.dissipation + after.dissipation)) / dissipation};
}

TEST(FlowEnergy, OfDecayingVorticesFallsByTheirDissipationToSecondOrder)
{
  const LedgerErrors coarse = taylor_green(24);
  const LedgerErrors fine = taylor_green(48);
  std::cout << "  dissipation " << coarse.dissipation << ", " << fine.dissipation << ", order "
            << observed_order(coarse.dissipation, fine.dissipation) << "; missing " << coarse.missing << ", "
            << fine.missing << ", order " << observed_order(coarse.missing, fine.missing) << '\n';
  EXPECT_GE(observed_order(coarse.dissipation, fine.dissipation), 1.8);
  EXPECT_GE(observed_order(coarse.missing, fine.missing), 1.8);
  EXPECT_LE(fine.missing, 0.1);
}

/// A fixed wall and one that drags the fluid along: the power of the wall is the dissipation, mu U^2 A/H.
TEST(FlowEnergy, OfCouettesFlowComesInAtTheMovingWall)
{
  constexpr double rho = 3.0;
  constexpr double nu = 0.2;
  const Vec3 lid(1.5, 0.0, -0.5);
  const fluid::SideBoundary periodic{.kind = fluid::SideKind::Periodic};
  const fluid::Boundaries sides{{{periodic, periodic},
                                 {fluid::SideBoundary{.kind = fluid::SideKind::Wall},
                                  fluid::SideBoundary{fluid::SideKind::Wall, fluid::VectorFunction::uniform(lid)}},
                                 {periodic, periodic}}};
  TestFlow flow(
      {stretched_faces(0.0, 3.0, 6, 0.3), stretched_faces(0.0, 2.0, 8, 0.4), stretched_faces(0.0, 1.0, 5, -0.2)}, sides,
      {.density = rho, .viscosity = nu});
  flow.solver.start({[&](const Vec3& x, double) -> Vec3 { return 0.5 * x[1] * lid; }, false}, 0.0);
  flow.solver.fill_halos();
  const fluid::FlowEnergy energy = fluid::energy(flow.solver, 0.0);
  const double power = rho * nu * lid.squaredNorm() * 3.0 / 2.0;
  EXPECT_NEAR(energy.dissipation, power, 1e-12 * power);
  EXPECT_NEAR(energy.sides, power, 1e-12 * power);
}

/// Power in less dissipation and growth of the flow that a moving lid drives in a box, over the power.
double missing_in_cavity(int n)
{
  fluid::Boundaries sides = all_sides(fluid::SideKind::Wall, fluid::VectorFunction::uniform(Vec3::Zero()));
  sides[2] = {fluid::SideBoundary{.kind = fluid::SideKind::Slip}, fluid::SideBoundary{.kind = fluid::SideKind::Slip}};
  // The lid's speed falls to zero at its ends: no jump of the velocity in the corners.
  sides[1][1].velocity = {[](const Vec3& x, double) -> Vec3 {
                            return {16.0 * std::pow(x[0] * (1.0 - x[0]), 2), 0.0, 0.0};
                          },
                          false};
  TestFlow flow({stretched_faces(0.0, 1.0, n, 0.3), stretched_faces(0.0, 1.0, n, 0.3), stretched_faces(0.0, 0.1, 1, 0)},
                sides, {.viscosity = 0.02});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  const double dt = 0.2 / n;
  flow.advance(dt, 5 * n);
  flow.solver.fill_halos();
  const fluid::FlowEnergy before = fluid::energy(flow.solver, flow.t);
  flow.advance(dt, 1);
  flow.solver.fill_halos();
  const fluid::FlowEnergy after = fluid::energy(flow.solver, flow.t);
  const double growth = (after.kinetic - before.kinetic) / dt;
  const double power = 0.5 * (before.sides + after.sides);
  return std::abs(power - 0.5 * (before.dissipation + after.dissipation) - growth) / power;
}

/// Its order rises with the resolution: 1.5 from 16 to 32 cells.
TEST(FlowEnergy, OfADrivenCavityIsWhatItsLidGives)
{
  const double coarse = missing_in_cavity(32);
  const double fine = missing_in_cavity(64);
  std::cout << "  missing " << coarse << ", " << fine << ", order " << observed_order(coarse, fine) << '\n';
  EXPECT_GE(observed_order(coarse, fine), 1.7);
  EXPECT_LE(fine, 0.01);
}

}  // namespace
}  // namespace luff::test
