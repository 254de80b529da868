// SPDX-License-Identifier: BSD-3-Clause
// Plates in curvilinear grids: against the Cartesian path, and against the momentum balance of the flow around them.
#include <iostream>

#include <gtest/gtest.h>

#include "support/control_volume.hpp"
#include "support/curvilinear_plates.hpp"

namespace luff::test {
namespace {

/// Forces on a plate that moves through a uniform grid, over twenty steps.
std::vector<Vec3> forces_on_moving_plate(TestFlow& flow, double depth)
{
  const Plate plate{.degrees = 70.0, .centre = {0.007, 0.003, 0.0}, .velocity = {-1.0, 0.2, 0.0}};
  std::vector<Vec3> forces;
  for (int n = 0; n < 20; ++n) {
    flow.step(0.01, plate.at(flow.t + 0.01, depth));
    forces.push_back(coefficients(total_force(flow.solver.loads()), depth));
    flow.solver.accept();
  }
  EXPECT_LE(flow.largest_divergence, 1e-13);
  return forces;
}

TEST(CurvilinearPlates, InABoxGivenByItsNodesFeelTheForcesOfTheCartesianGrid)
{
  const Slab slab{
      .x = {-2.0, 2.0, 64, {}}, .y = {-1.5, 1.5, 48, {}}, .depth = 0.0625, .stream = 0.5, .viscosity = 0.02};
  for (const bool in_part : {false, true}) {
    const fluid::FlowOptions options{
        .edges_cover_in_part = in_part, .viscosity = slab.viscosity, .stage_reduction = 0.0};
    const auto cartesian = make_flow(slab, MPI_COMM_WORLD, options);
    const auto curvilinear = make_curvilinear_flow(slab, undeformed, options);
    const auto expected = forces_on_moving_plate(*cartesian, slab.depth);
    const auto forces = forces_on_moving_plate(*curvilinear, slab.depth);
    double largest = 0.0;
    for (std::size_t n = 0; n < forces.size(); ++n)
      largest = std::max(largest, (forces[n] - expected[n]).norm() / expected[n].norm());
    std::cout << "  largest relative difference of the force over 20 steps, edges " << (in_part ? "in part " : "whole ")
              << largest << '\n';
    EXPECT_LE(largest, 1e-9);
  }
}

struct SkewedPlate {
  double degrees;
  int cells_per_length;
  fluid::ImmersedScheme scheme = fluid::ImmersedScheme::CutLink;
  double most = 0.03;  ///< difference of the forces
  bool edges_cover_in_part = false;
};

class PlatesInSkewedGrids : public ::testing::TestWithParam<SkewedPlate> {};

TEST_P(PlatesInSkewedGrids, FeelWhatTheFlowAroundThemLoses)
{
  const int n = GetParam().cells_per_length;
  const double h = 1.0 / n;
  const Slab slab{.x = {-3.0, 5.0, 3 * n + 36, grid::Refinement{-1.0, 2.0, h}},
                  .y = {-3.0, 3.0, 2 * n + 34, grid::Refinement{-1.0, 1.0, h}},
                  .depth = h,
                  .stream = 1.0,
                  .viscosity = 0.02};
  const auto flow = make_curvilinear_flow(slab, skewed_around_origin,
                                          {.immersed = GetParam().scheme,
                                           .edges_cover_in_part = GetParam().edges_cover_in_part,
                                           .viscosity = slab.viscosity});
  const Plate plate{.degrees = GetParam().degrees, .centre = {0.007, 0.003, 0.0}, .divisions = n};
  IndexBox box = flow->grid.owned();
  for (int axis = 0; axis < 2; ++axis) {
    box.lo[axis] += 18;
    box.hi[axis] -= 18;
  }
  ControlVolume volume(*flow, box);
  const double dt = 0.01;
  flow->advance(dt, 97, plate.at(0.0, slab.depth));
  Vec3 crossings;
  for (int step = 0; step < 3; ++step) {
    flow->step(dt, plate.at(0.0, slab.depth));
    crossings = coefficients(total_force(flow->solver.loads()), slab.depth);
    flow->solver.accept();
    volume.record(dt);
  }
  const Vec3 momentum = coefficients(volume.force(), slab.depth);
  const double error = (crossings - momentum).norm() / momentum.norm();
  std::cout << "  " << GetParam().degrees << " degrees, h = L/" << n
            << (GetParam().edges_cover_in_part ? ", edges in part" : "")
            << (GetParam().scheme == fluid::ImmersedScheme::Curvib ? ", curvib: loads (" : ": crossings (")
            << crossings[0] << ", " << crossings[1] << "), momentum (" << momentum[0] << ", " << momentum[1]
            << "), apart " << 100.0 * error << " %; divergence " << flow->largest_divergence << '\n';
  EXPECT_LE(error, GetParam().most);
  EXPECT_LE(flow->largest_divergence, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(
    Plates, PlatesInSkewedGrids,
    ::testing::Values(SkewedPlate{90.0, 20}, SkewedPlate{30.0, 20},
                      SkewedPlate{.degrees = 90.0, .cells_per_length = 20, .edges_cover_in_part = true},
                      SkewedPlate{.degrees = 30.0, .cells_per_length = 20, .edges_cover_in_part = true},
                      SkewedPlate{90.0, 20, fluid::ImmersedScheme::Curvib, 0.05},
                      SkewedPlate{30.0, 20, fluid::ImmersedScheme::Curvib, 0.06}),
    [](const auto& tested) { return "Case" + std::to_string(tested.index); });

}  // namespace
}  // namespace luff::test
