// SPDX-License-Identifier: BSD-3-Clause
// What the iteration promises whatever accelerates it.
#include "coupling/fixed_point.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "interface_maps.hpp"

namespace luff::coupling::test {
namespace {

using Eigen::VectorXd;

std::unique_ptr<Acceleration> constant(double relaxation)
{
  return make_acceleration({.method = AccelerationMethod::Constant, .relaxation = relaxation});
}

const AccelerationMethod all_methods[] = {AccelerationMethod::Constant, AccelerationMethod::Aitken,
                                          AccelerationMethod::QuasiNewton};

TEST(FixedPoint, EveryMethodFindsTheFixedPointOfAContractiveMap)
{
  const LinearMap map = map_with_eigenvalues(Eigen::Vector2d(0.5, -0.3), 1);
  for (auto method : all_methods) {
    VectorXd d = VectorXd::Zero(2);
    const auto report = solve(map, d, *make_acceleration({.method = method}), 1e-12, 100);
    EXPECT_TRUE(report.converged());
    EXPECT_LT((d - map.fixed_point()).lpNorm<Eigen::Infinity>(), 2e-12);
  }
}

TEST(FixedPoint, EveryMethodFindsTheFixedPointOfANonlinearMap)
{
  const auto map = [](const VectorXd& d) -> VectorXd {
    return Eigen::Vector3d(std::cos(d[1]), 0.5 * std::sin(d[0] + d[2]), 0.4 * d[0] * d[1] - 0.8 * d[2]);
  };
  for (auto method : all_methods) {
    VectorXd d = VectorXd::Zero(3);
    const auto report = solve(map, d, *make_acceleration({.method = method}), 1e-11, 100);
    EXPECT_TRUE(report.converged());
    EXPECT_LT((map(d) - d).lpNorm<Eigen::Infinity>(), 1e-11);
  }
}

TEST(FixedPoint, LooseCouplingOfALightShellBlowsUpWhereStrongCouplingDoesNot)
{
  const LinearMap map = added_mass_map(8, 10, 3);
  VectorXd loose = VectorXd::Zero(8);
  for (int step = 0; step < 20; ++step) {
    const auto report = solve(map, loose, *constant(1), 1e-8, 1);
    EXPECT_EQ(report.iterations, 1);
    EXPECT_EQ(report.outcome, FixedPointOutcome::MaxIterations);
  }
  EXPECT_GT(loose.norm(), 1e10);
  VectorXd strong = VectorXd::Zero(8);
  EXPECT_TRUE(solve(map, strong, *make_acceleration({}), 1e-8, 30).converged());
}

TEST(FixedPoint, OneIterationReturnsTheImageOfTheGuess)
{
  const LinearMap map = added_mass_map(4, 10, 5);
  const VectorXd guess = random_vector(4, 9);
  VectorXd d = guess;
  solve(map, d, *constant(0.1), 1e-8, 1);
  EXPECT_EQ(d, map(guess));
}

TEST(FixedPoint, ConstantRelaxationOfALightShellConvergesOnlyWithASmallFactor)
{
  const LinearMap map = added_mass_map(8, 10, 3);  // stable for w < 2 / 11
  VectorXd d = VectorXd::Zero(8);
  const auto slow = solve(map, d, *constant(0.1), 1e-8, 1000);
  EXPECT_TRUE(slow.converged());
  EXPECT_GT(slow.iterations, 50);
  d.setZero();
  EXPECT_FALSE(solve(map, d, *constant(0.2), 1e-8, 1000).converged());
}

TEST(FixedPoint, ATinyRelaxationFactorCannotFakeConvergence)
{
  const LinearMap map = map_with_eigenvalues(Eigen::Vector2d(0.5, -0.3), 1);
  VectorXd d = VectorXd::Zero(2);
  const auto report = solve(map, d, *constant(1e-12), 1e-8, 50);
  EXPECT_EQ(report.outcome, FixedPointOutcome::MaxIterations);
  EXPECT_EQ(report.iterations, 50);
  EXPECT_GT(report.residual, 0.1);
}

TEST(FixedPoint, TheReportedResidualIsThatOfTheMapAndItsHistoryIsComplete)
{
  const LinearMap map = map_with_eigenvalues(Eigen::Vector2d(0.5, -0.3), 1);
  std::vector<double> seen;
  const auto recording = [&](const VectorXd& d) -> VectorXd {
    seen.push_back((map(d) - d).lpNorm<Eigen::Infinity>());
    return map(d);
  };
  VectorXd d = VectorXd::Zero(2);
  const auto report = solve(recording, d, *make_acceleration({}), 1e-12, 100);
  EXPECT_EQ(report.history, seen);
  EXPECT_EQ(report.residual, seen.back());
  EXPECT_EQ(report.iterations, static_cast<int>(seen.size()));
}

TEST(FixedPoint, ValuesThatAreNotFiniteEndTheIterationAndAreReported)
{
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    int calls = 0;
    const auto map = [&](const VectorXd& d) -> VectorXd {
      return Eigen::Vector2d(0.5 * d[0] + 1, ++calls == 2 ? bad : 0.5 * d[1]);
    };
    VectorXd d = VectorXd::Ones(2);
    const auto report = solve(map, d, *make_acceleration({}), 1e-8, 30);
    EXPECT_EQ(report.outcome, FixedPointOutcome::NotFinite);
    EXPECT_EQ(report.iterations, 2);
    EXPECT_TRUE(d.allFinite());
  }
}

TEST(FixedPoint, TheVelocityMustConvergeAsWellAsTheDisplacement)
{
  const LinearMap map = map_with_eigenvalues(Eigen::Vector2d(0.5, -0.3), 1);
  const double length = 2, velocity = 4, rate = 1000;
  VectorXd d = VectorXd::Zero(2), residual;
  const auto recording = [&](const VectorXd& x) -> VectorXd {
    residual = map(x) - x;
    return map(x);
  };
  const auto report = solve_fixed_point(recording, d, *constant(1), {1e-6, 100},
                                        displacement_and_velocity_norm(length, velocity, rate));
  EXPECT_TRUE(report.converged());
  EXPECT_LE(rate * residual.lpNorm<Eigen::Infinity>(), 1e-6 * velocity);
  EXPECT_DOUBLE_EQ(report.residual, rate * residual.lpNorm<Eigen::Infinity>() / velocity);
  EXPECT_DOUBLE_EQ(displacement_and_velocity_norm(2, 4, 1)(Eigen::Vector2d(3, -8)), 4);
}

TEST(FixedPoint, RepeatingAStepGivesTheSameBits)
{
  const LinearMap map = added_mass_map(12, 30, 7);
  for (auto method : {AccelerationMethod::Aitken, AccelerationMethod::QuasiNewton}) {
    VectorXd first = VectorXd::Zero(12), second = first;
    const auto a = solve(map, first, *make_acceleration({.method = method}), 1e-8, 200);
    const auto b = solve(map, second, *make_acceleration({.method = method}), 1e-8, 200);
    EXPECT_EQ(first, second);
    EXPECT_EQ(a.history, b.history);
  }
}

TEST(FixedPoint, UnitsOfLengthDoNotChangeTheIterates)
{
  const double unit = std::ldexp(1, -40);
  const LinearMap map = added_mass_map(12, 30, 7);
  const LinearMap scaled{map.J, unit * map.c};
  for (auto method : all_methods) {
    const AccelerationOptions options{.method = method, .relaxation = 0.05};
    VectorXd d = VectorXd::Zero(12), e = d;
    const auto a = solve_fixed_point(map, d, *make_acceleration(options), {1e-8, 60}, displacement_norm(1));
    const auto b = solve_fixed_point(scaled, e, *make_acceleration(options), {1e-8, 60}, displacement_norm(unit));
    EXPECT_EQ(a.history, b.history);
    EXPECT_EQ(e, unit * d);
  }
}

TEST(FixedPoint, AGuessThatIsTheFixedPointTakesOneIteration)
{
  const LinearMap map = map_with_eigenvalues(Eigen::Vector2d(0.5, -10), 1);
  VectorXd d = map.fixed_point();
  EXPECT_EQ(solve(map, d, *make_acceleration({}), 1e-8, 30).iterations, 1);
}

TEST(FixedPoint, NumbersOutOfRangeAreRefused)
{
  EXPECT_THROW(make_acceleration({.relaxation = 0}), InputError);
  EXPECT_THROW(make_acceleration({.relaxation = 1.5}), InputError);
  EXPECT_THROW(make_acceleration({.largest_factor = -1}), InputError);
  EXPECT_THROW(make_acceleration({.reused_steps = -1}), InputError);
  EXPECT_THROW(make_acceleration({.filter = 1}), InputError);
  EXPECT_THROW(make_acceleration({.filter = std::nan("")}), InputError);
}

}  // namespace
}  // namespace luff::coupling::test
