// SPDX-License-Identifier: BSD-3-Clause
// Flow rates, pressures and outlets on the sides of the domain.
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "parallel/vector_field.hpp"
#include "support/flow.hpp"

namespace luff::test {
namespace {

using fluid::Entering;
using fluid::FlowProfile;
using fluid::FlowRate;
using fluid::ScalarFunction;
using fluid::SideBoundary;
using fluid::SideKind;

const SideBoundary slip{.kind = SideKind::Slip};
const SideBoundary wall{.kind = SideKind::Wall};
const SideBoundary symmetry{.kind = SideKind::Symmetry};
const SideBoundary outflow{.kind = SideKind::Outflow};

SideBoundary flow_rate(const FlowRate& rate)
{
  SideBoundary side{.kind = SideKind::Velocity};
  side.flow_rate = rate;
  return side;
}

SideBoundary steady_flow_rate(double Q, FlowProfile profile)
{
  return flow_rate({.into = [Q](double) { return Q; }, .constant = true, .profile = profile});
}

SideBoundary pressure(double p, Entering entering = Entering::Reservoir)
{
  SideBoundary side{.kind = SideKind::Pressure};
  side.pressure = ScalarFunction::uniform(p);
  side.entering = entering;
  return side;
}

/// A duct along an axis: the flow goes through its ends, the other four sides are given in the order of the axes.
struct Duct {
  int axis = 0;
  std::array<SideBoundary, 2> ends;
  std::array<SideBoundary, 4> around{wall, wall, wall, wall};
  double stretching = 0.3;
  double viscosity = 0.05;

  [[nodiscard]] std::unique_ptr<TestFlow> make() const
  {
    std::array<std::vector<double>, 3> faces;
    fluid::Boundaries sides;
    int other = 0;
    for (int a = 0; a < 3; ++a) {
      faces[a] = a == axis ? stretched_faces(0, 2, 12, stretching) : stretched_faces(0, 1, 10, a == 1 ? 0.3 : -0.2);
      sides[a] = ends;
      if (a != axis) {
        sides[a] = {around[other], around[other + 1]};
        other += 2;
      }
    }
    return std::make_unique<TestFlow>(faces, sides, fluid::FlowOptions{.viscosity = viscosity});
  }
};

/// Volume that passes the low faces of a layer of cells per time, along increasing index.
double flux_through(const TestFlow& flow, int axis, int layer)
{
  IndexBox faces = flow.grid.owned();
  faces.lo[axis] = layer;
  faces.hi[axis] = layer + 1;
  double sum = 0.0;
  for_each_cell_in_order(faces,
                         [&, U = flow.solver.state().U[axis].view()](int i, int j, int k) { sum += U(i, j, k); });
  return sum;
}

double kinetic_energy(const TestFlow& flow)
{
  const auto u = views(flow.solver.state().u);
  double sum = 0.0;
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    sum += 0.5 * flow.grid.volume(i, j, k) * Vec3(u[0](i, j, k), u[1](i, j, k), u[2](i, j, k)).squaredNorm();
  });
  return sum;
}

TEST(FlowRate, EntersExactlyOnEachOfTheSixSides)
{
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      Duct duct{.axis = axis, .ends = {outflow, outflow}};
      const auto Q = [](double t) { return 0.3 + 0.2 * std::sin(5.0 * t); };
      duct.ends[end] = flow_rate({.into = Q, .constant = false, .profile = FlowProfile::Parabolic});
      const auto flow = duct.make();
      flow->solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
      flow->advance(0.02, 5);
      const double along = (end == 0 ? 1.0 : -1.0) * Q(flow->t);
      EXPECT_NEAR(flux_through(*flow, axis, 0), along, 1e-14);
      EXPECT_NEAR(flux_through(*flow, axis, 12), along, 1e-13);
      EXPECT_LE(flow->largest_divergence, 1e-13);
    }
}

TEST(FlowRate, OfADevelopedFlowPassesADuctUnchanged)
{
  for (int axis = 0; axis < 3; ++axis) {
    const Duct duct{.axis = axis, .ends = {steady_flow_rate(0.7, FlowProfile::Parabolic), outflow}};
    const auto flow = duct.make();
    std::array<std::array<bool, 2>, 2> walls{{{true, true}, {true, true}}};
    const fluid::Section section(flow->grid, axis, 0, walls);
    const auto w = section.developed_flow(0.0);
    const int other = axis == 0 ? 1 : 0;
    const int last = axis == 2 ? 1 : 2;
    const auto exact = [&](const Vec3& x) -> Vec3 {
      const auto cell = [&](int a) {
        const auto& f = flow->grid.faces(a);
        return std::upper_bound(f.begin(), f.end(), x[a]) - f.begin() - 1;
      };
      return 0.7 * w[cell(other) + 10 * cell(last)].real() * Vec3::Unit(axis);
    };
    flow->solver.start({[&](const Vec3& x, double) { return exact(x); }, false}, 0.0);
    // The pressure starts from nothing: short steps find it before anything moves.
    flow->advance(1e-8, 3);
    flow->advance(0.02, 50);
    EXPECT_LE(velocity_error(*flow, exact), 1e-11);
  }
}

TEST(FlowRate, LeavesThroughASideWhereItIsNegative)
{
  const Duct duct{.ends = {steady_flow_rate(0.5, FlowProfile::Parabolic), steady_flow_rate(-0.5, FlowProfile::Plug)}};
  const auto flow = duct.make();
  flow->solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow->advance(0.02, 5);
  EXPECT_NEAR(flux_through(*flow, 0, 0), 0.5, 1e-14);
  EXPECT_NEAR(flux_through(*flow, 0, 12), 0.5, 1e-14);
}

TEST(FlowRate, ThatDoesNotLeaveAgainIsRefused)
{
  const Duct duct{.ends = {steady_flow_rate(0.5, FlowProfile::Plug), steady_flow_rate(-0.4999, FlowProfile::Plug)}};
  EXPECT_THROW(duct.make()->solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0), InputError);
}

TEST(FlowRate, WithoutAWallIsRefusedAProfileByTheNameOfItsSide)
{
  const Duct duct{.ends = {steady_flow_rate(0.5, FlowProfile::Parabolic), outflow}, .around = {slip, slip, slip, slip}};
  try {
    (void)duct.make();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("boundary.x_min.flow_rate: no wall"), std::string::npos);
  }
}

TEST(PressureSides, HoldAHeavyFluidAtRest)
{
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 gravity = -9.0 * Vec3::Unit(axis);
    const Duct duct{.axis = axis, .ends = {pressure(18.0), pressure(0.0)}, .around = {wall, slip, wall, slip}};
    auto faces = duct.make();
    fluid::FlowOptions options = faces->solver.options();
    options.acceleration = fluid::VectorFunction::uniform(gravity);
    fluid::Boundaries sides;
    sides.fill({wall, slip});
    sides[axis] = duct.ends;
    TestFlow flow({faces->grid.faces(0), faces->grid.faces(1), faces->grid.faces(2)}, sides, options);
    flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
    flow.advance(1e-8, 3);
    flow.advance(0.02, 20);
    EXPECT_LE(velocity_error(flow, [](const Vec3&) { return Vec3::Zero(); }), 1e-12);
    EXPECT_LE(pressure_error(flow, [&](const Vec3& x) { return gravity.dot(x); }), 1e-11);
  }
}

TEST(PressureSides, DriveADevelopedFlowThroughAChannel)
{
  // Steady: nu u'' = -dp/dx, for which the discrete parabola is exact with equal cells, at walls too.
  constexpr double K = 0.3 / 2.0;
  constexpr double viscosity = 0.5;
  const fluid::Boundaries sides{
      {{pressure(0.3, Entering::Developed), pressure(0.0)}, {wall, wall}, {symmetry, symmetry}}};
  TestFlow flow({stretched_faces(0, 2, 8, 0.3), stretched_faces(0, 1, 10, 0.0), std::vector{0.0, 0.1}}, sides,
                {.viscosity = viscosity});
  flow.solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow.advance(0.008, 800);
  const auto exact = [&](const Vec3& x) -> Vec3 { return K / (2.0 * viscosity) * x[1] * (1.0 - x[1]) * Vec3::UnitX(); };
  EXPECT_LE(velocity_error(flow, exact), 1e-12);
}

TEST(PressureSides, LetFluidInFromAReservoirByBernoullisLaw)
{
  // p_b = p + u^2/2 inside, p = 0 at the outlet.
  const Vec3 stream(1.2, 0.0, 0.0);
  const Duct duct{
      .ends = {pressure(0.5 * stream.squaredNorm()), outflow}, .around = {slip, slip, slip, slip}, .stretching = 0.0};
  const auto flow = duct.make();
  flow->solver.start(fluid::VectorFunction::uniform(stream), 0.0);
  flow->advance(1e-8, 3);
  flow->advance(0.02, 50);
  EXPECT_LE(velocity_error(*flow, [&](const Vec3&) { return stream; }), 1e-12);
}

TEST(PressureSides, ThatOscillateMoveASlugOfFluidAsNewtonSaysToSecondOrder)
{
  // A plug of length 2 between pressures cos(3 t) and 0 that enters as it is: u = sin(3 t)/6.
  const auto error = [](int steps) {
    SideBoundary drive = pressure(0.0, Entering::Developed);
    drive.pressure = {[](const Vec3&, double t) { return std::cos(3.0 * t); }, false};
    const Duct duct{.ends = {drive, pressure(0.0, Entering::Developed)}, .around = {slip, slip, slip, slip}};
    const auto flow = duct.make();
    flow->solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
    flow->advance(1.0 / steps, steps);
    return velocity_error(*flow, [](const Vec3&) -> Vec3 { return std::sin(3.0) / 6.0 * Vec3::UnitX(); });
  };
  const double coarse = error(20);
  EXPECT_LE(coarse, 1e-3);
  EXPECT_GE(observed_order(coarse, error(40)), 1.9);
}

/// Largest kinetic energy of a channel flow at Re = 7000 whose flow rate turns round twice a period and carries
/// vortices through the outlet both ways; stops where it leaves all bounds.
double largest_energy_of_pulsatile_flow(const SideBoundary& outlet)
{
  const double pi = std::numbers::pi;
  const auto Q = [pi](double t) { return 0.3 * (0.2 + std::sin(pi * t)); };
  const fluid::Boundaries sides{{{flow_rate({.into = Q, .constant = false, .profile = FlowProfile::Parabolic}), outlet},
                                 {wall, wall},
                                 {symmetry, symmetry}}};
  TestFlow flow({stretched_faces(0, 2, 40, 0.0), stretched_faces(0, 1, 24, 0.0), std::vector{0.0, 0.1}}, sides,
                {.viscosity = 5e-4});
  const auto vortices = [pi](const Vec3& x, double) -> Vec3 {
    return {std::sin(pi * x[0]) * std::sin(2.0 * pi * x[1]), std::cos(pi * x[0]) * std::pow(std::sin(pi * x[1]), 2),
            0.0};
  };
  flow.solver.start({vortices, false}, 0.0);
  double largest = 0.0;
  while (flow.t < 4.0 && largest < 10.0) {
    flow.advance(1.0 / 300.0, 1);
    largest = std::max(largest, kinetic_energy(flow));
  }
  EXPECT_NEAR(flux_through(flow, 0, 40), Q(flow.t), 1e-12);
  return largest;
}

TEST(Outflow, StaysStableWhenAPulsatileFlowReversesStrongly)
{
  // What a parabola of the largest flow rate has: 6/5 of 1/2 3.6^2 in a volume of 0.2.
  constexpr double peak = 0.6 * 3.6 * 3.6 * 0.2;
  EXPECT_LE(largest_energy_of_pulsatile_flow(outflow), 1.25 * peak);
  EXPECT_LE(largest_energy_of_pulsatile_flow(pressure(0.0)), 1.25 * peak);
  // The test means something: fluid that comes back as it is feeds itself.
  EXPECT_GE(largest_energy_of_pulsatile_flow(pressure(0.0, Entering::Developed)), 5.0 * peak);
}

}  // namespace
}  // namespace luff::test
