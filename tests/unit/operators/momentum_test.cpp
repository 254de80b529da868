// SPDX-License-Identifier: BSD-3-Clause
#include "operators/momentum.hpp"

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"

namespace luff::operators {
namespace {

using Profile = std::function<Vec3(const Vec3&)>;

/// Velocity at centres, halo included, and fluxes of a velocity profile.
struct Flow {
  Flow(const grid::Grid& on, const Profile& velocity)
      : grid(on), u(make_field3<double>(on.owned())), U(u), rate(u), increment(u)
  {
    for_each_cell_in_order(on.owned().grown(1), [&](int i, int j, int k) {
      for (int d = 0; d < 3; ++d)
        u[d](i, j, k) = velocity(on.centre(i, j, k))[d];
    });
    for (int d = 0; d < 3; ++d)
      for_each_cell_in_order(on.owned().faces(d), [&](int i, int j, int k) {
        U[d](i, j, k) = on.area_vector(d, i, j, k).dot(velocity(on.face_centre(d, i, j, k)));
      });
  }
  void advance(double viscosity, const Vec3& force, const StageWeights& weights)
  {
    advance_momentum(grid, views(std::as_const(u)), views(std::as_const(U)), viscosity, force, weights, views(rate),
                     views(increment));
  }
  [[nodiscard]] double largest_rate(const Vec3& expected) const
  {
    double largest = 0.0;
    for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
      for (int d = 0; d < 3; ++d)
        largest = std::max(largest, std::abs(rate[d](i, j, k) - expected[d]));
    });
    return largest;
  }

  const grid::Grid& grid;
  Field3<double> u, U, rate, increment;
};

class Momentum : public ::testing::TestWithParam<bool> {
 protected:
  Momentum() : grid_(MPI_COMM_SELF, faces(GetParam()), {false, false, false}) {}
  static std::array<std::vector<double>, 3> faces(bool stretched)
  {
    const double a = stretched ? 0.3 : 0.0;
    return {test::stretched_faces(0, 1, 8, a), test::stretched_faces(0, 1, 8, -a), test::stretched_faces(0, 1, 8, a)};
  }
  grid::Grid grid_;
};

TEST_P(Momentum, OfAUniformFlowDoesNotChange)
{
  Flow flow(grid_, [](const Vec3&) { return Vec3(1.0, -0.7, 0.3); });
  flow.advance(0.1, Vec3::Zero(), {0.1, 0.0});
  EXPECT_LE(flow.largest_rate(Vec3::Zero()), 1e-13);
}

TEST_P(Momentum, OfAShearFlowDoesNotChange)
{
  Flow flow(grid_, [](const Vec3& x) { return Vec3(2.0 * x[1] - x[2], 0.0, 0.0); });
  flow.advance(0.1, Vec3::Zero(), {0.1, 0.0});
  EXPECT_LE(flow.largest_rate(Vec3::Zero()), 1e-13);
}

TEST_P(Momentum, GrowsByTheForceWithTheWeightsOfBothStages)
{
  const Vec3 force(1.0, 2.0, -3.0);
  Flow flow(grid_, [](const Vec3&) { return Vec3(1.0, 1.0, 1.0); });
  flow.advance(0.1, force, {0.25, 0.0});
  flow.advance(0.1, 2.0 * force, {0.5, -0.125});
  EXPECT_LE(flow.largest_rate(2.0 * force), 1e-13);
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(flow.increment[d](3, 4, 5), (0.25 + 1.0 - 0.125) * force[d], 1e-13);
}

TEST_P(Momentum, RecoversAUniformVelocityFromItsFluxes)
{
  const Vec3 stream(1.0, -0.7, 0.3);
  Flow flow(grid_, [&](const Vec3&) { return stream; });
  recover_velocity(grid_, views(std::as_const(flow.U)), views(flow.increment));
  for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) {
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(flow.increment[d](i, j, k), stream[d], 1e-15);
  });
}

/// x of the permuted axes: what was along axis d is along d + 1.
Vec3 turned(const Vec3& x)
{
  return {x[2], x[0], x[1]};
}

TEST_P(Momentum, RatesTurnWithTheAxes)
{
  const auto velocity = [](const Vec3& x) {
    return Vec3(std::sin(3 * x[0]) * std::cos(2 * x[1]) + x[2], std::cos(x[0] + 2 * x[2]), std::sin(x[1] * x[2]));
  };
  const std::array<std::vector<double>, 3> along{test::stretched_faces(0, 1, 6, GetParam() ? 0.3 : 0.0),
                                                 test::stretched_faces(0, 1, 6, 0.0),
                                                 test::stretched_faces(0, 1, 6, GetParam() ? -0.2 : 0.0)};
  const grid::Grid plain(MPI_COMM_SELF, along, {false, false, false});
  const grid::Grid other(MPI_COMM_SELF, {along[2], along[0], along[1]}, {false, false, false});
  Flow flow(plain, velocity);
  Flow turned_flow(other, [&](const Vec3& x) { return turned(velocity({x[1], x[2], x[0]})); });
  flow.advance(0.1, Vec3::Zero(), {0.1, 0.0});
  turned_flow.advance(0.1, Vec3::Zero(), {0.1, 0.0});
  for_each_cell_in_order(plain.owned(), [&](int i, int j, int k) {
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(turned_flow.rate[(d + 1) % 3](k, i, j), flow.rate[d](i, j, k), 2e-13);
  });
}

TEST_P(Momentum, ConvectiveRateIsTheSumOverAxesInTheWorstCellAndSeesNaN)
{
  Flow flow(grid_, [](const Vec3&) { return Vec3(1.0, -2.0, 0.5); });
  std::array<double, 3> finest{1.0, 1.0, 1.0};
  for (int d = 0; d < 3; ++d)
    for (int i = 0; i < 8; ++i)
      finest[d] = std::min(finest[d], grid_.width(d, i));
  EXPECT_NEAR(convective_rate(grid_, views(std::as_const(flow.U))), 1.0 / finest[0] + 2.0 / finest[1] + 0.5 / finest[2],
              1e-11);
  flow.U[1](3, 3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(convective_rate(grid_, views(std::as_const(flow.U)))));
}

INSTANTIATE_TEST_SUITE_P(Grids, Momentum, ::testing::Values(false, true),
                         [](const auto& tested) { return tested.param ? "Stretched" : "Uniform"; });

/// A periodic box [0, 1]^3 with curvilinear cells.
template <class Map>
grid::Grid curvilinear_grid(const Index3& cells, const Map& map)
{
  return {MPI_COMM_SELF, cells, test::mapped_nodes(cells, map), {true, true, true}};
}

void expect_uniform_flow_to_stay(const grid::Grid& grid)
{
  const Vec3 stream(1.0, -0.7, 0.3);
  Flow flow(grid, [&](const Vec3&) { return stream; });
  flow.advance(0.1, Vec3::Zero(), {0.1, 0.0});
  EXPECT_LE(flow.largest_rate(Vec3::Zero()), 1e-12);
  recover_velocity(grid, views(std::as_const(flow.U)), views(flow.increment));
  for_each_cell_in_order(grid.owned(), [&, u = views(flow.increment)](int i, int j, int k) {
    EXPECT_LE((at(u, {i, j, k}) - stream).norm(), 1e-14);
  });
}

TEST(CurvilinearMomentum, OfAUniformFlowDoesNotChangeOnRandomlyPerturbedCells)
{
  const test::Perturbed perturbed{{9, 8, 7}};
  expect_uniform_flow_to_stay(curvilinear_grid(perturbed.cells, perturbed));
  expect_uniform_flow_to_stay(curvilinear_grid({9, 7, 8}, test::Mirrored<test::Perturbed>{perturbed}));
}

/// Root mean square error of -u.grad u + nu lap u for a solenoidal field of period 1.
double rate_error(const Index3& cells)
{
  using std::numbers::pi;
  const double nu = 0.05;
  const double k = 2.0 * pi;
  const auto velocity = [k](const Vec3& x) {
    return Vec3(std::sin(k * x[1]) + std::cos(k * x[2]), std::sin(k * x[2]) + std::cos(k * x[0]),
                std::sin(k * x[0]) + std::cos(k * x[1]));
  };
  const auto rate = [&](const Vec3& x) -> Vec3 {
    const Vec3 u = velocity(x);
    const Vec3 convection(k * (std::cos(k * x[1]) * u[1] - std::sin(k * x[2]) * u[2]),
                          k * (std::cos(k * x[2]) * u[2] - std::sin(k * x[0]) * u[0]),
                          k * (std::cos(k * x[0]) * u[0] - std::sin(k * x[1]) * u[1]));
    return -nu * k * k * u - convection;
  };
  const grid::Grid grid = curvilinear_grid(cells, test::Waved{});
  Flow flow(grid, velocity);
  flow.advance(nu, Vec3::Zero(), {1.0, 0.0});
  double sum = 0.0;
  for_each_cell_in_order(grid.owned(), [&, N = views(flow.rate)](int i, int j, int l) {
    sum += grid.volume(i, j, l) * (at(N, {i, j, l}) - rate(grid.centre(i, j, l))).squaredNorm();
  });
  return std::sqrt(sum);
}

TEST(CurvilinearMomentum, ConvectionAndDiffusionAreSecondOrderOnASkewedGrid)
{
  const double coarse = rate_error({16, 18, 14});
  const double fine = rate_error({32, 36, 28});
  std::cout << "  order of the rate of change " << std::log2(coarse / fine) << '\n';
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

}  // namespace
}  // namespace luff::operators
