// SPDX-License-Identifier: BSD-3-Clause
// The two schemes for sheets and bodies side by side: a cylinder that turns in a free vortex, plates in a stream.
#include <iostream>

#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/control_volume.hpp"
#include "support/plate_history.hpp"
#include "surface/generators.hpp"

namespace luff::test {
namespace {

using fluid::ImmersedScheme;

const char* name_of(ImmersedScheme scheme)
{
  return scheme == ImmersedScheme::Curvib ? "curvib" : "cut-link";
}

struct VortexErrors {
  double mean = 0.0;     ///< of |u - exact| over the fluid
  double largest = 0.0;  ///< of the same
  double torque = 0.0;   ///< relative
};

/// A cylinder of radius 1/2 that turns with 2 in a box whose sides move with the free vortex u = 1/(2 r), Re = 20.
VortexErrors errors_around_turning_cylinder(ImmersedScheme scheme, double h)
{
  constexpr double radius = 0.5;
  constexpr double spin = 2.0;
  constexpr double viscosity = 0.05;
  constexpr double reach = 1.6;
  const auto exact = [](const Vec3& x) -> Vec3 {
    const double turn = std::min(1.0, radius * radius / (x[0] * x[0] + x[1] * x[1]));
    return spin * turn * Vec3(-x[1], x[0], 0.0);
  };
  const fluid::VectorFunction vortex{[&](const Vec3& x, double) { return exact(x); }, false};
  const fluid::SideBoundary side{fluid::SideKind::Velocity, vortex};
  const fluid::SideBoundary symmetry{.kind = fluid::SideKind::Symmetry};
  const auto faces = grid::face_coordinates({-reach, reach, static_cast<int>(std::lround(2.0 * reach / h)), {}}, "x");
  TestFlow flow({faces, faces, std::vector{0.0, h}}, {{{side, side}, {side, side}, {symmetry, symmetry}}},
                {.immersed = scheme, .viscosity = viscosity});
  flow.solver.start(vortex, 0.0);
  const surface::TriangleMesh mesh = surface::cylinder(
      {.radius = radius, .length = h, .divisions = {static_cast<int>(std::lround(12.6 * radius / h)), 1}});
  immersed::SheetMotion motion;
  motion.position = mesh.vertices;
  motion.triangles = mesh.triangles;
  motion.bodies = {{.vertices = mesh.n_vertices(), .triangles = mesh.n_triangles()}};
  for (const Vec3& x : mesh.vertices) {
    motion.velocity.push_back(spin * Vec3::UnitZ().cross(x));
    motion.acceleration.push_back(-spin * spin * Vec3(x[0], x[1], 0.0));
  }
  const double dt = 0.2 * h;
  flow.advance(dt, static_cast<int>(std::lround(1.0 / dt)), motion);
  EXPECT_LE(flow.largest_divergence, 1e-13);

  VortexErrors errors;
  double cells = 0.0;
  const auto u = views(flow.solver.state().u);
  for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
    if (flow.solver.links().is_inside({i, j, k}))
      return;
    const double error = (luff::at(u, Index3{i, j, k}) - exact(flow.grid.centre(i, j, k))).norm();
    errors.mean += error;
    errors.largest = std::max(errors.largest, error);
    cells += 1.0;
  });
  errors.mean /= cells;
  const immersed::SheetLoads loads = flow.solver.loads();
  double torque = 0.0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    torque += mesh.vertices[v].cross(loads.force(v))[2];
  const double exact_torque = -4.0 * std::numbers::pi * viscosity * spin * radius * radius * h;
  errors.torque = torque / exact_torque - 1.0;
  return errors;
}

class BothSchemes : public ::testing::TestWithParam<ImmersedScheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, BothSchemes, ::testing::Values(ImmersedScheme::CutLink, ImmersedScheme::Curvib));

TEST_P(BothSchemes, ConvergeToTheVortexAroundATurningCylinderAndItsTorque)
{
  const VortexErrors coarse = errors_around_turning_cylinder(GetParam(), 0.1);
  const VortexErrors fine = errors_around_turning_cylinder(GetParam(), 0.05);
  std::cout << "  " << name_of(GetParam()) << ", h = D/10 and D/20: mean error of u " << coarse.mean << ", "
            << fine.mean << ", order " << observed_order(coarse.mean, fine.mean) << "; largest " << coarse.largest
            << ", " << fine.largest << ", order " << observed_order(coarse.largest, fine.largest) << "; torque "
            << 100.0 * coarse.torque << " %, " << 100.0 * fine.torque << " %\n";
  EXPECT_GE(observed_order(coarse.mean, fine.mean), 1.75);
  EXPECT_GE(observed_order(coarse.largest, fine.largest), 1.0);
  EXPECT_LE(std::abs(fine.torque), GetParam() == ImmersedScheme::CutLink ? 0.01 : 0.12);
  EXPECT_LE(std::abs(fine.torque), std::abs(coarse.torque));
}

struct PlateForces {
  Vec3 loads;
  Vec3 momentum;
};

/// At t = 1 on a plate at rest in a stream from the start, h = L/20.
PlateForces forces_on_plate(ImmersedScheme scheme, double degrees, double reynolds)
{
  const Slab slab{.x = {-3.0, 5.0, 96, grid::Refinement{-1.0, 2.0, 0.05}},
                  .y = {-3.0, 3.0, 74, grid::Refinement{-1.0, 1.0, 0.05}},
                  .depth = 0.05,
                  .stream = 1.0,
                  .viscosity = 1.0 / reynolds};
  const auto flow = make_flow(slab, MPI_COMM_WORLD, {.immersed = scheme, .viscosity = slab.viscosity});
  const immersed::SheetMotion plate =
      Plate{.degrees = degrees, .centre = {0.007, 0.003, 0.0}, .divisions = 20}.at(0.0, slab.depth);
  ControlVolume volume(*flow, {0.2, 0.0, 0.0}, 0.8);
  PlateForces forces;
  for (int n = 0; n < 100; ++n) {
    flow->step(0.01, plate);
    forces.loads = coefficients(total_force(flow->solver.loads()), slab.depth);
    flow->solver.accept();
    volume.record(0.01);
  }
  EXPECT_LE(flow->largest_divergence, 1e-13);
  forces.momentum = coefficients(volume.force(), slab.depth);
  return forces;
}

TEST(CurvibPlates, TakeTheMomentumThatTheyTakeWithCutLinksAndFeelMostOfIt)
{
  struct Case {
    double degrees;
    double reynolds;
    double felt;    ///< largest difference between loads and momentum, relative
    double scheme;  ///< and between the momentum of the schemes
  };
  // Friction at the leading edge is first order (docs/numerics/curvib.md).
  for (const Case& c : {Case{90.0, 20.0, 0.05, 0.01}, Case{30.0, 50.0, 0.06, 0.06}, Case{0.0, 100.0, 0.25, 0.06}}) {
    const PlateForces curvib = forces_on_plate(ImmersedScheme::Curvib, c.degrees, c.reynolds);
    const PlateForces cut_link = forces_on_plate(ImmersedScheme::CutLink, c.degrees, c.reynolds);
    const auto apart = [](const Vec3& a, const Vec3& b) { return (a - b).norm() / b.norm(); };
    const double felt = apart(curvib.loads, curvib.momentum);
    const double scheme = apart(curvib.momentum, cut_link.momentum);
    std::cout << "  " << c.degrees << " degrees, Re = " << c.reynolds << ", h = L/20: curvib loads (" << curvib.loads[0]
              << ", " << curvib.loads[1] << "), momentum (" << curvib.momentum[0] << ", " << curvib.momentum[1]
              << "), apart " << 100.0 * felt << " %; cut-link loads (" << cut_link.loads[0] << ", " << cut_link.loads[1]
              << "), momentum (" << cut_link.momentum[0] << ", " << cut_link.momentum[1]
              << "); momentum of the schemes apart " << 100.0 * scheme << " %\n";
    EXPECT_LE(felt, c.felt);
    EXPECT_LE(scheme, c.scheme);
  }
}

TEST(CurvibMovingPlate, FeelsTheForceOfTheSamePlateFixedInAStreamAndItsNoiseDoesNotGrowWithShorterSteps)
{
  const double drag = history_of({.stream = 1.0, .scheme = ImmersedScheme::Curvib}).mean()[0];
  const History moving = history_of({.scheme = ImmersedScheme::Curvib});
  const History shorter = history_of({.dt = 0.0025, .scheme = ImmersedScheme::Curvib});
  std::cout << "  mean drag fixed " << drag << ", moving " << moving.mean()[0] << " and with dt/2 " << shorter.mean()[0]
            << "; noise " << 100.0 * noise(moving, 0.16) / drag << " % and with dt/2 "
            << 100.0 * noise(shorter, 0.16) / drag << " % of the drag\n";
  EXPECT_NEAR(moving.mean()[0], drag, 0.03 * drag);
  EXPECT_NEAR(shorter.mean()[0], drag, 0.03 * drag);
  EXPECT_LE(noise(moving, 0.16), 0.12 * drag);
  EXPECT_LE(noise(shorter, 0.16), 0.12 * drag);
}

}  // namespace
}  // namespace luff::test
