// SPDX-License-Identifier: BSD-3-Clause
// Stresses on the domain's sides: second order on uniform, stretched and skewed grids, right- and left-handed.
#include <gtest/gtest.h>

#include <iostream>

#include "grid/generators/pipe.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/flow.hpp"

namespace luff::test {
namespace {

using fluid::SideKind;
using std::numbers::pi;

/// grad u of a smooth field, by central differences whose error is that of the sixth digit of the fifth.
Mat3 gradient(const std::function<Vec3(const Vec3&)>& u, const Vec3& x)
{
  constexpr double step = 1e-5;
  Mat3 G;
  for (int d = 0; d < 3; ++d)
    G.col(d) = (u(x + step * Vec3::Unit(d)) - u(x - step * Vec3::Unit(d))) / (2.0 * step);
  return G;
}

/// Root mean square over the sides of the error of the shear stress, and the largest one.
struct ShearError {
  double mean = 0.0;
  double largest = 0.0;
};

ShearError shear_error(TestFlow& flow, const std::function<Vec3(const Vec3&)>& exact)
{
  flow.solver.fill_halos();
  const double viscosity = flow.solver.options().viscosity;
  double sum = 0.0;
  double area = 0.0;
  ShearError error;
  for (const fluid::SideStress& side : flow.solver.side_stresses(/*walls_only=*/false)) {
    std::size_t n = 0;
    for_each_cell_in_order(side.cells, [&](int i, int j, int k) {
      const auto [a, b, c] = stepped({i, j, k}, side.axis, side.end);
      const Vec3 S = flow.grid.area_vector(side.axis, a, b, c);
      const Vec3 normal = (side.end == 0 ? 1.0 : -1.0) * S.normalized();
      const Mat3 G = gradient(exact, flow.grid.face_centre(side.axis, a, b, c));
      const Vec3 viscous = viscosity * (G + G.transpose()) * normal;
      const double off = (side.shear[n++] - (viscous - viscous.dot(normal) * normal)).norm();
      sum += S.norm() * off * off;
      area += S.norm();
      error.largest = std::max(error.largest, off);
    });
  }
  error.mean = std::sqrt(sum / area);
  return error;
}

void expect_order(const ShearError& coarse, const ShearError& fine)
{
  const double order = observed_order(coarse.mean, fine.mean);
  std::cout << "  order of the shear stress on sides " << order << ", of its largest error "
            << observed_order(coarse.largest, fine.largest) << "; errors " << fine.mean << ", " << fine.largest << '\n';
  EXPECT_GE(order, 1.9);
}

/// Marches to `end` with the fraction 0.6 of the longest step that the scheme is stable with.
void march(TestFlow& flow, double end)
{
  const double dt = 0.6 * std::min(rk3_limits.convective / flow.solver.convective_rate(),
                                   rk3_limits.diffusive / flow.solver.diffusive_rate());
  const int steps = static_cast<int>(std::ceil(end / dt));
  flow.advance(end / steps, steps);
}

/// Ethier and Steinman's flow between prescribed velocities; viscous enough for what the start leaves at the sides to
/// spread over a few cells.
ShearError ethier_steinman_in_box(int n, double stretching)
{
  const EthierSteinman exact{.viscosity = 0.3};
  const auto faces = stretched_faces(-1, 1, n, stretching);
  TestFlow flow({faces, faces, faces}, sides_of({false, false, false}, {SideKind::Velocity, exact.function()}),
                {.viscosity = exact.viscosity, .stage_reduction = 0.0});
  flow.solver.start(exact.function(), 0.0);
  flow.advance(1e-8, 3);  // the pressure starts from nothing: short steps find it before anything moves
  march(flow, 0.1);
  return shear_error(flow, [&](const Vec3& x) { return exact.velocity(x, flow.t); });
}

TEST(WallShear, IsOfSecondOrderOnAUniformAndOnAStretchedGrid)
{
  expect_order(ethier_steinman_in_box(12, 0.0), ethier_steinman_in_box(24, 0.0));
  expect_order(ethier_steinman_in_box(12, 0.3), ethier_steinman_in_box(24, 0.3));
}

/// Steady flow of period 1 along a wavy channel, b(x) <= y <= b(x) + 1, at rest on both walls and driven by a force:
///
///   u = (F(s), b' F(s), W(s)),  s = y - b(x),  F = sin(pi s),  W = sin(2 pi s)/2,  b = B sin(2 pi x),  p = 0.
///
/// It runs along lines of equal s, so that u . grad F = 0 and (u . grad) u = b'' F^2 e_y.
struct WavyChannel {
  double viscosity = 0.1;
  double B = 0.06;

  [[nodiscard]] double wall(double x) const { return B * std::sin(2.0 * pi * x); }
  [[nodiscard]] Vec3 velocity(const Vec3& x) const
  {
    const double s = x[1] - wall(x[0]);
    const double F = std::sin(pi * s);
    return {F, 2.0 * pi * B * std::cos(2.0 * pi * x[0]) * F, 0.5 * std::sin(2.0 * pi * s)};
  }
  /// (u . grad) u - nu lap u, with lap f(s) = (1 + b'^2) f'' - b'' f'.
  [[nodiscard]] Vec3 force(const Vec3& x) const
  {
    const double k = 2.0 * pi;
    const double s = x[1] - wall(x[0]);
    const double b_1 = k * B * std::cos(k * x[0]);
    const double b_2 = -k * k * B * std::sin(k * x[0]);
    const double b_3 = -k * k * b_1;
    const double F = std::sin(pi * s);
    const double F_1 = pi * std::cos(pi * s);
    const auto laplacian = [&](double f_1, double f_2) { return (1.0 + b_1 * b_1) * f_2 - b_2 * f_1; };
    const double lap_F = laplacian(F_1, -pi * pi * F);
    const double lap_v = b_3 * F - 2.0 * b_2 * b_1 * F_1 + b_1 * lap_F;
    const double lap_W = laplacian(pi * std::cos(k * s), -0.5 * k * k * std::sin(k * s));
    return Vec3(0.0, b_2 * F * F, 0.0) - viscosity * Vec3(lap_F, lap_v, lap_W);
  }
};

/// Cells sheared and waved between the walls: cosines between area vectors up to 0.6.
struct WavyCells {
  WavyChannel channel;
  double depth = 0.15;
  Vec3 operator()(const Vec3& s) const
  {
    const double between = 4.0 * s[1] * (1.0 - s[1]);
    const double x = s[0] + 0.12 * std::sin(pi * s[1]) + 0.3 * s[1];
    const double y = s[1] + 0.04 * between * std::sin(2.0 * pi * s[0]);
    const double z = 0.15 * (s[2] + 0.3 * std::sin(2.0 * pi * s[0]) + 0.4 * s[1]);
    return {x, channel.wall(x) + y, z};
  }
};

/// `turned`: the last two directions exchanged, left-handed.
ShearError wavy_channel(int n, bool turned)
{
  const WavyChannel exact;
  const auto rest = fluid::VectorFunction::uniform(Vec3::Zero());
  const WavyCells cells{exact};
  const Index3 size = turned ? Index3{n, 2, n} : Index3{n, n, 2};
  const grid::NodeSource nodes = turned ? mapped_nodes(size, Mirrored<WavyCells>{cells}) : mapped_nodes(size, cells);
  TestFlow flow(size, nodes, sides_of({true, turned, !turned}, {SideKind::Wall, rest}),
                {.viscosity = exact.viscosity,
                 .acceleration = {[exact](const Vec3& x, double) { return exact.force(x); }, false}});
  flow.solver.start({[exact](const Vec3& x, double) { return exact.velocity(x); }, false}, 0.0);
  march(flow, 0.03 / exact.viscosity);  // what the start leaves at the walls has spread over a sixth of the channel
  return shear_error(flow, [&](const Vec3& x) { return exact.velocity(x); });
}

TEST(WallShear, IsOfSecondOrderAtCurvedWallsOfSkewedCellsOfEitherHand)
{
  const ShearError coarse = wavy_channel(20, false);
  expect_order(coarse, wavy_channel(40, false));
  EXPECT_NEAR(wavy_channel(20, true).mean, coarse.mean, 1e-8 * coarse.mean);
}

/// Largest speed of a jagged flow between walls after `steps` steps of the longest length that is stable.
double speed_left(TestFlow& flow, int steps)
{
  const auto jagged = [](const Vec3& x, double) -> Vec3 {
    return {std::sin(91.0 * x[1] + 57.0 * x[2]), std::sin(83.0 * x[2] + 71.0 * x[0]),
            std::sin(97.0 * x[0] - 61.0 * x[1])};
  };
  flow.solver.start({jagged, false}, 0.0);
  flow.advance(rk3_limits.diffusive / flow.solver.diffusive_rate(), steps);
  flow.solver.fill_halos();
  return operators::largest_speed(flow.grid, views(flow.solver.state().u));
}

TEST(WallShear, IsStableWithTheLongestDiffusiveStep)
{
  const auto sides = sides_of({false, false, false}, {SideKind::Wall, fluid::VectorFunction::uniform(Vec3::Zero())});
  const fluid::FlowOptions viscous{.viscosity = 10.0};
  // The slowest mode of the cube decays by half in about 0.02 L^2/nu: 100 steps of 0.5 h^2/(3 nu), h = L/8, take 0.26.
  TestFlow equal({stretched_faces(0, 1, 8, 0.0), stretched_faces(0, 1, 8, 0.0), stretched_faces(0, 1, 8, 0.0)}, sides,
                 viscous);
  EXPECT_LE(speed_left(equal, 100), 1e-3);
  const Perturbed perturbed{{8, 8, 8}};
  TestFlow skewed(perturbed.cells, mapped_nodes(perturbed.cells, perturbed), sides, viscous);
  EXPECT_LE(speed_left(skewed, 400), 1e-3);
}

TEST(WallShear, IsStableInThePipeCellsThatTouchTwoSidesUnder180Degrees)
{
  grid::Centreline line(grid::frame_along({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}));
  line.add_straight(0.5);
  const auto pipe = grid::make_pipe(
      {.centreline = line, .stations = {0.0, 0.25, 0.5}, .across = 12, .radius = [](double) { return 0.5; }});
  TestFlow flow(pipe.cells, pipe.source,
                sides_of({false, false, true}, {SideKind::Wall, fluid::VectorFunction::uniform(Vec3::Zero())}),
                {.viscosity = 10.0});
  // The slowest mode falls by exp(-5.78 nu dt/R^2) in a step, exp(-9) or so in 600 of them.
  EXPECT_LE(speed_left(flow, 600), 1e-3);
}

}  // namespace
}  // namespace luff::test
