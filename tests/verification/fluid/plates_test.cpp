// SPDX-License-Identifier: BSD-3-Clause
// Forces on plates: against the momentum balance of the flow around them, moving against fixed, and at long steps.
#include <iostream>

#include <gtest/gtest.h>

#include "support/control_volume.hpp"
#include "support/plate_history.hpp"
#include "support/plates.hpp"

namespace luff::test {
namespace {

struct SteadyPlate {
  const char* name;
  double degrees;
  double reynolds;
  int cells_per_length;
  Vec3 centre{0.007, 0.003, 0.0};
};

struct PlateForces {
  Vec3 crossings;
  Vec3 momentum;
  double divergence = 0.0;
};

/// Cells of width h around [-1, 2] x [-1, 1], growing to [-3, 5] x [-3, 3].
Slab slab_around_plate(int cells_per_length, double reynolds)
{
  const double h = 1.0 / cells_per_length;
  const int n = cells_per_length;
  return {.x = {-3.0, 5.0, 3 * n + 36, grid::Refinement{-1.0, 2.0, h}},
          .y = {-3.0, 3.0, 2 * n + 34, grid::Refinement{-1.0, 1.0, h}},
          .depth = h,
          .stream = 1.0,
          .viscosity = 1.0 / reynolds};
}

/// Coefficients three time units after the start, on the way to the steady state.
PlateForces forces_on_fixed_plate(const SteadyPlate& c)
{
  const Slab slab = slab_around_plate(c.cells_per_length, c.reynolds);
  const Plate plate{.degrees = c.degrees, .centre = c.centre, .divisions = c.cells_per_length};
  const auto flow = make_flow(slab);
  ControlVolume volume(*flow, {0.2, 0.0, 0.0}, 0.8);
  const double dt = 0.01;
  flow->advance(dt, 297, plate.at(0.0, slab.depth));
  PlateForces forces;
  for (int n = 0; n < 3; ++n) {
    flow->step(dt, plate.at(0.0, slab.depth));
    forces.crossings = coefficients(total_force(flow->solver.loads()), slab.depth);
    flow->solver.accept();
    volume.record(dt);
  }
  forces.momentum = coefficients(volume.force(), slab.depth);
  forces.divergence = flow->largest_divergence;
  return forces;
}

class SteadyPlates : public ::testing::TestWithParam<SteadyPlate> {};

TEST_P(SteadyPlates, FeelWhatTheFlowAroundThemLosesToThreePercent)
{
  const PlateForces forces = forces_on_fixed_plate(GetParam());
  const double error = (forces.crossings - forces.momentum).norm() / forces.momentum.norm();
  std::cout << "  " << GetParam().name << ", h = L/" << GetParam().cells_per_length << ": crossings ("
            << forces.crossings[0] << ", " << forces.crossings[1] << "), momentum (" << forces.momentum[0] << ", "
            << forces.momentum[1] << "), apart " << 100.0 * error << " %; divergence " << forces.divergence << '\n';
  EXPECT_LE(error, 0.03);
  EXPECT_LE(forces.divergence, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(
    Plates, SteadyPlates,
    ::testing::Values(SteadyPlate{"normal", 90.0, 20.0, 20}, SteadyPlate{"inclined by 70 degrees", 70.0, 50.0, 20},
                      SteadyPlate{"inclined by 30 degrees", 30.0, 50.0, 20},
                      SteadyPlate{"the same elsewhere in the grid", 30.0, 50.0, 20, {-0.013, 0.008, 0.0}},
                      SteadyPlate{"inclined by 30 degrees", 30.0, 50.0, 40},
                      SteadyPlate{"parallel", 0.0, 100.0, 20, {0.007, 0.003, 0.0}},
                      SteadyPlate{"parallel", 0.0, 100.0, 40, {0.007, 0.013, 0.0}}),
    [](const auto& tested) { return "Case" + std::to_string(tested.index); });

/// Largest less smallest force coefficients on a plate at 30 degrees, in four places of the grid, soon after the start.
Vec3 spread_over_places(bool edges_cover_in_part)
{
  const Slab slab = slab_around_plate(16, 50.0);
  Vec3 low = Vec3::Constant(10.0);
  Vec3 high = -low;
  for (const Vec3& place :
       {Vec3(0.0, 0.0, 0.0), Vec3(0.016, -0.010, 0.0), Vec3(-0.024, 0.026, 0.0), Vec3(0.030, 0.014, 0.0)}) {
    const auto flow =
        make_flow(slab, MPI_COMM_WORLD, {.edges_cover_in_part = edges_cover_in_part, .viscosity = slab.viscosity});
    const immersed::SheetMotion plate = Plate{.degrees = 30.0, .centre = place, .divisions = 16}.at(0.0, slab.depth);
    flow->advance(0.0125, 79, plate);
    flow->step(0.0125, plate);
    const Vec3 force = coefficients(total_force(flow->solver.loads()), slab.depth);
    low = low.cwiseMin(force);
    high = high.cwiseMax(force);
    EXPECT_LE(flow->largest_divergence, 1e-13);
  }
  return high - low;
}

TEST(EdgesOfPlates, ThatFadeOutMakeTheForceDependLessOnThePlaceInTheGrid)
{
  const Vec3 whole = spread_over_places(false);
  const Vec3 partial = spread_over_places(true);
  std::cout << "  spread of C_x, C_y: whole faces " << whole[0] << ", " << whole[1] << ", in part " << partial[0]
            << ", " << partial[1] << '\n';
  EXPECT_LE(partial[0], whole[0]);
  EXPECT_LE(partial[1], 0.8 * whole[1]);
}

/// cases/plate/parallel.toml: Re = 100, L/h = 40 in a wide domain, up to t = 6.
TEST(ParallelPlate, HasTheDragOfTripleDeckTheory)
{
  constexpr double theory = 0.3606;  // 2 (1.328 Re^-1/2 + 2.67 Re^-7/8)
  const double h = 0.025;
  const Slab slab{.x = {-6.0, 12.0, 189, grid::Refinement{-1.0, 2.0, h}},
                  .y = {-6.0, 6.0, 142, grid::Refinement{-1.0, 1.0, h}},
                  .depth = h,
                  .stream = 1.0,
                  .viscosity = 0.01};
  const Plate plate{.degrees = 0.0, .centre = {0.007, 0.013, 0.0}, .divisions = 40};
  const auto flow = make_flow(slab);
  ControlVolume volume(*flow, {0.2, 0.0, 0.0}, 0.8);
  const double dt = 0.012;
  Vec3 traction;
  for (int n = 0; n < 500; ++n) {
    flow->step(dt, plate.at(0.0, slab.depth));
    traction = coefficients(total_force(flow->solver.loads()), slab.depth);
    flow->solver.accept();
    volume.record(dt);
  }
  const double drag = coefficients(volume.force(), slab.depth)[0];
  std::cout << "  drag by the momentum balance " << drag << ", by surface traction " << traction[0] << ", theory "
            << theory << '\n';
  EXPECT_NEAR(drag, theory, 0.02 * theory);
  EXPECT_NEAR(traction[0], theory, 0.04 * theory);
}

TEST(MovingPlate, FeelsTheForceOfTheSamePlateFixedInAStreamWithLittleNoiseAtAnyStep)
{
  const History fixed = history_of({.stream = 1.0});
  const History moving = history_of({});
  const History small_steps = history_of({.dt = 0.00125});
  const double drag = fixed.mean()[0];
  const double rms = noise(moving, 0.16);
  const double rms_small_steps = noise(small_steps, 0.16);
  std::cout << "  mean drag fixed " << drag << ", moving " << moving.mean()[0] << " and with dt/4 "
            << small_steps.mean()[0] << "; lift " << fixed.mean()[1] << ", " << moving.mean()[1] << ", "
            << small_steps.mean()[1] << "; noise " << 100.0 * rms / drag << " % and with dt/4 "
            << 100.0 * rms_small_steps / drag << " % of the drag\n";
  EXPECT_NEAR(moving.mean()[0], drag, 0.01 * drag);
  EXPECT_NEAR(small_steps.mean()[0], drag, 0.01 * drag);
  EXPECT_LE(rms, 0.06 * drag);
  EXPECT_LE(rms_small_steps, 0.06 * drag);
}

struct Passage {
  double degrees;
  bool edges_cover_in_part;
  double felt;      ///< noise, at most, of a drag coefficient of 2 to 3
  double reported;  ///< the same
};

class NoiseOfPlates : public ::testing::TestWithParam<Passage> {};

TEST_P(NoiseOfPlates, ThatPassOverTheGridIsSmall)
{
  const auto [degrees, in_part, felt, reported] = GetParam();
  const PlateRun run{.dt = 0.01,
                     .centre = {0.013, 0.017, 0.0},
                     .degrees = degrees,
                     .h = 0.05,
                     .viscosity = 0.02,
                     .end = 1.5,
                     .edges_cover_in_part = in_part};
  const History moving = history_of(run);
  const double as_felt = noise(moving, 4.0 * run.h);
  const double as_reported = noise(moving.as_reported(), 4.0 * run.h);
  std::cout << "  " << degrees << " degrees, edges " << (in_part ? "in part" : "whole") << ", Re = 50, h = L/20: drag "
            << moving.mean()[0] << ", noise as felt " << as_felt << ", as reported " << as_reported << '\n';
  EXPECT_LE(as_felt, felt);
  EXPECT_LE(as_reported, reported);
}

INSTANTIATE_TEST_SUITE_P(AtAnAngle, NoiseOfPlates,
                         ::testing::Values(Passage{70.0, false, 0.16, 0.08}, Passage{45.0, false, 0.19, 0.15},
                                           Passage{90.0, false, 0.18, 0.05}, Passage{70.0, true, 0.06, 0.04},
                                           Passage{45.0, true, 0.025, 0.03}, Passage{90.0, true, 0.14, 0.08}));

class LongSteps : public ::testing::TestWithParam<double> {};

/// Every step as long as the largest sum_d |U_d| dt/h_d over all cells allows, for cell Reynolds numbers U h/nu.
TEST_P(LongSteps, UpToTheRecommendedLimitKeepAMovingPlateStable)
{
  const double h = 0.04;
  const Slab slab{.x = {-5.0, 4.0, 100 + 32, grid::Refinement{-2.8, 1.2, h}},
                  .y = {-3.0, 3.0, 40 + 34, grid::Refinement{-0.8, 0.8, h}},
                  .depth = 0.2,
                  .stream = 0.0,
                  .viscosity = h / GetParam()};
  const Plate plate{.degrees = 70.0, .centre = {0.007, 0.003, 0.0}, .velocity = {-1.0, 0.0, 0.0}};
  const auto flow = make_flow(slab);
  double largest = 0.0;
  int steps = 0;
  for (; flow->t < 2.0; ++steps) {
    const double dt = rk3_limits.convective / std::max(flow->solver.convective_rate(), 1.0 / h);
    flow->step(dt, plate.at(flow->t + dt, slab.depth));
    if (flow->t > 0.5)
      largest = std::max(largest, coefficients(total_force(flow->solver.loads()), slab.depth).norm());
    flow->solver.accept();
  }
  std::cout << "  sum of |U_d| dt/h_d = " << rk3_limits.convective << ", cell Re " << GetParam() << ": " << steps
            << " steps, largest force coefficient after the start " << largest << '\n';
  EXPECT_GE(rk3_limits.convective, 1.0);
  EXPECT_LE(largest, 7.0);
  EXPECT_LE(flow->largest_divergence, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(CellReynolds, LongSteps, ::testing::Values(4.0, 16.0, 160.0),
                         [](const auto& tested) { return std::to_string(static_cast<int>(tested.param)); });

}  // namespace
}  // namespace luff::test
