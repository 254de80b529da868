// SPDX-License-Identifier: BSD-3-Clause
// Forces by the momentum of the fluid around surfaces.
#include <iostream>

#include <gtest/gtest.h>

#include "fluid/momentum_balance.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/plates.hpp"

namespace luff::test {
namespace {

/// |What a box in Ethier and Steinman's flow, with nothing in it, is said to lose| over the momentum that goes through.
double balance_error(int n, fluid::TimeScheme scheme)
{
  const EthierSteinman exact{.viscosity = 0.05};
  const auto map = [wave = Waved{}](const Vec3& s) -> Vec3 { return 2.0 * wave(s) - Vec3::Ones(); };
  TestFlow flow({n, n, n}, mapped_nodes({n, n, n}, map),
                sides_of({false, false, false}, {fluid::SideKind::Velocity, exact.function()}),
                {.scheme = scheme, .viscosity = exact.viscosity});
  flow.solver.start(exact.function(), 0.0);
  flow.advance(0.16 / n, n / 4);
  const IndexBox box{{n / 4, n / 4, n / 8}, {3 * n / 4, 7 * n / 8, 5 * n / 8}};
  const double area = std::pow(flow.grid.volume(n / 2, n / 2, n / 2), 2.0 / 3.0) * box.extent(1) * box.extent(2);
  return flow.solver.force_by_momentum(flow.solver.accepted_step(), box).norm() / area;
}

TEST(MomentumBalance, OfABoxWithNothingInItIsZeroToSecondOrderOnASkewedGrid)
{
  for (const auto scheme : {fluid::TimeScheme::Rk3, fluid::TimeScheme::NewtonKrylov}) {
    const double coarse = balance_error(16, scheme);
    const double fine = balance_error(32, scheme);
    std::cout << "  error " << coarse << ", " << fine << ", order " << observed_order(coarse, fine) << '\n';
    EXPECT_GE(observed_order(coarse, fine), 1.8);
    EXPECT_LE(fine, 0.01);
  }
}

TEST(MomentumBalance, HasTheBodyForceInIt)
{
  // Fluid that a force sets in motion as a whole loses nothing.
  fluid::Boundaries sides = all_sides(fluid::SideKind::Periodic, fluid::VectorFunction::uniform(Vec3::Zero()));
  TestFlow flow({stretched_faces(0, 1, 8, 0.2), stretched_faces(0, 1, 6, -0.3), stretched_faces(0, 2, 5, 0)}, sides,
                {.density = 3.0, .viscosity = 0.1, .acceleration = fluid::VectorFunction::uniform({0.7, -0.2, 0.4})});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow.advance(0.05, 2);
  EXPECT_LE(flow.solver.force_by_momentum(flow.solver.accepted_step(), {{1, 0, 2}, {6, 6, 4}}).norm(), 1e-12);
}

TEST(MomentumBalance, OfAPlateAgreesWithItsTraction)
{
  const double h = 0.05;
  const Slab slab{.x = {-4.0, 5.0, 100 + 12, grid::Refinement{-0.8, 1.2, h}},
                  .y = {-3.0, 3.0, 32 + 28, grid::Refinement{-0.8, 0.8, h}},
                  .depth = h,
                  .stream = 1.0,
                  .viscosity = 0.01};
  const Plate plate{.degrees = 70.0, .centre = {0.007, 0.003, 0.0}};
  const auto flow = make_flow(slab);
  const immersed::SheetMotion sheet = plate.at(0.0, slab.depth);
  flow->advance(0.0125, 119, sheet);
  const Vec3 before = total_force(flow->solver.loads());
  flow->advance(0.0125, 1, sheet);
  const Vec3 traction = 0.5 * (before + total_force(flow->solver.loads()));
  const IndexBox box = flow->solver.cells_around(0, static_cast<int>(sheet.triangles.size()), 4);
  EXPECT_LE(box.extent(0), 22);
  const Vec3 momentum = flow->solver.force_by_momentum(flow->solver.accepted_step(), box);
  std::cout << "  traction (" << traction[0] << ", " << traction[1] << "), momentum (" << momentum[0] << ", "
            << momentum[1] << ")\n";
  EXPECT_LE((traction - momentum).head<2>().norm(), 0.03 * momentum.norm());
}

}  // namespace
}  // namespace luff::test
