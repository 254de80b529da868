// SPDX-License-Identifier: BSD-3-Clause
// The quasi-Newton acceleration IQN-ILS.
#include "coupling/quasi_newton.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "interface_maps.hpp"

namespace luff::coupling::test {
namespace {

using Eigen::VectorXd;

TEST(QuasiNewton, SolvesALinearMapOfNUnknownsInNPlusTwoIterations)
{
  for (int n : {1, 2, 5, 10}) {
    const LinearMap map{random_matrix(n, 40 + n), random_vector(n, 50 + n)};
    QuasiNewton newton(0.5, 0, 1e-6);
    VectorXd d = VectorXd::Zero(n);
    const auto report = solve(map, d, newton, 1e-9, 50);
    EXPECT_TRUE(report.converged());
    EXPECT_LE(report.iterations, n + 2) << "n = " << n;
    EXPECT_LT((d - map.fixed_point()).norm(), 1e-7);
  }
}

TEST(QuasiNewton, ConvergesWhereTheAddedMassIsTenAndAHundredTimesTheShells)
{
  for (double ratio : {10., 100.})
    for (int n : {2, 8, 40}) {
      const LinearMap map = added_mass_map(n, ratio, 3);
      QuasiNewton newton(0.5, 0, 1e-2);
      VectorXd d = VectorXd::Zero(n);
      const auto report = solve(map, d, newton, 1e-8, 60);
      EXPECT_TRUE(report.converged()) << n << " unknowns, ratio " << ratio;
      EXPECT_LE(report.iterations, std::min(n + 4, 30));  // GMRES on I - J: 2, 8 and 21 for the ratio 100
    }
}

/// Iterations of each step of a sequence whose right-hand side moves smoothly, as a flapping flag's does.
std::vector<int> iterations_of_sequence(QuasiNewton& newton, int steps)
{
  LinearMap map = added_mass_map(30, 100, 11);
  const VectorXd a = random_vector(30, 12), b = random_vector(30, 13);
  VectorXd d = VectorXd::Zero(30);
  std::vector<int> iterations;
  for (int step = 0; step < steps; ++step) {
    map.c = std::cos(0.1 * step) * a + std::sin(0.1 * step) * b;
    const auto report = solve(map, d, newton, 1e-8, 60);
    EXPECT_TRUE(report.converged());
    iterations.push_back(report.iterations);
  }
  return iterations;
}

double mean(const std::vector<int>& v)
{
  return Eigen::Map<const Eigen::VectorXi>(v.data(), v.size()).cast<double>().mean();
}

TEST(QuasiNewton, NeedsFewerIterationsWithTheDifferencesOfPastSteps)
{
  QuasiNewton fresh(0.5, 0, 1e-2), reusing(0.5, 2, 1e-2);
  const double without = mean(iterations_of_sequence(fresh, 30));
  const double with = mean(iterations_of_sequence(reusing, 30));
  RecordProperty("mean_without_reuse", std::to_string(without));
  RecordProperty("mean_with_two_steps", std::to_string(with));
  EXPECT_LT(with, 0.7 * without);
  EXPECT_EQ(reusing.steps_kept(), 2);
  EXPECT_EQ(fresh.steps_kept(), 0);
}

TEST(QuasiNewton, NeedsFewerIterationsThanAitken)
{
  const LinearMap map = added_mass_map(30, 100, 11);
  VectorXd d = VectorXd::Zero(30), e = d;
  const auto aitken = solve(map, d, *make_acceleration({.method = AccelerationMethod::Aitken}), 1e-8, 500);
  const auto newton = solve(map, e, *make_acceleration({.method = AccelerationMethod::QuasiNewton}), 1e-8, 500);
  EXPECT_TRUE(aitken.converged());
  EXPECT_LT(2 * newton.iterations, aitken.iterations);
}

TEST(QuasiNewton, DropsDifferencesThatAreNearlyCombinationsOfNewerOnes)
{
  // Two unknowns change, the other three stay converged: no more than two columns can be independent.
  LinearMap map{Eigen::MatrixXd::Zero(5, 5), VectorXd::Zero(5)};
  map.J(0, 0) = -20;
  map.J(1, 1) = -5;
  map.c[0] = 1;
  map.c[1] = 2;
  QuasiNewton newton(0.5, 2, 1e-2);
  newton.begin_step();
  VectorXd d = VectorXd::Zero(5);
  const VectorXd directions[] = {VectorXd::Unit(5, 0), VectorXd::Unit(5, 0) + 1e-3 * VectorXd::Unit(5, 1),
                                 VectorXd::Unit(5, 1)};
  newton.next(d, map(d));
  int used[3];
  for (int i = 0; i < 3; ++i) {
    d += directions[i];
    newton.next(d, map(d));
    used[i] = newton.columns_used();
  }
  EXPECT_EQ(used[0], 1);
  EXPECT_EQ(used[1], 1) << "a direction 1e-3 from the last one adds noise only";
  EXPECT_EQ(used[2], 2);
}

TEST(QuasiNewton, IgnoresARepeatedGuess)
{
  QuasiNewton newton(0.5, 2, 1e-2);
  newton.begin_step();
  const VectorXd d = VectorXd::Ones(3), image = 2 * VectorXd::Ones(3);
  newton.next(d, image);
  EXPECT_TRUE(newton.next(d, image).allFinite());
  EXPECT_EQ(newton.columns_used(), 0);
}

TEST(QuasiNewton, ForgetsPastStepsWhenTheResidualGrowsTwiceInARow)
{
  QuasiNewton newton(0.5, 2, 1e-2);
  iterations_of_sequence(newton, 3);
  ASSERT_EQ(newton.steps_kept(), 2);
  newton.begin_step();
  const VectorXd d = VectorXd::Zero(30), r = random_vector(30, 21);
  newton.next(d, r);
  newton.next(d, 2 * r);
  EXPECT_EQ(newton.steps_kept(), 2);
  newton.next(d, r);
  newton.next(d, 2 * r);
  EXPECT_EQ(newton.steps_kept(), 2);
  newton.next(d, 3 * r);
  EXPECT_EQ(newton.steps_kept(), 0);
}

TEST(QuasiNewton, RecoversFromHistoryThatMisleads)
{
  QuasiNewton newton(0.5, 2, 1e-2);
  iterations_of_sequence(newton, 3);
  const LinearMap other = map_with_eigenvalues(random_vector(30, 31), 32);
  VectorXd d = VectorXd::Zero(30);
  EXPECT_TRUE(solve(other, d, newton, 1e-8, 60).converged());
}

TEST(QuasiNewton, ForgetsEverythingAfterAStepThatFailed)
{
  QuasiNewton newton(0.5, 2, 1e-2);
  iterations_of_sequence(newton, 3);
  VectorXd d = VectorXd::Zero(30);
  solve(map_with_eigenvalues(100 * random_vector(30, 31), 32), d, newton, 1e-14, 2);
  EXPECT_EQ(newton.steps_kept(), 0);
  newton.begin_step();
  const VectorXd guess = newton.next(VectorXd::Zero(30), VectorXd::Ones(30));
  EXPECT_EQ(guess, VectorXd::Constant(30, 0.5));
}

/// The next guesses of a step whose map is the same for both.
TEST(QuasiNewton, GoesOnFromItsHistoryWithTheSameBits)
{
  QuasiNewton first(0.5, 2, 1e-2);
  (void)iterations_of_sequence(first, 4);
  QuasiNewton second(0.5, 2, 1e-2);
  second.restore(first.history());
  EXPECT_EQ(second.steps_kept(), first.steps_kept());
  EXPECT_EQ(iterations_of_sequence(second, 3), iterations_of_sequence(first, 3));
  const VectorXd d = random_vector(30, 14), image = random_vector(30, 15);
  first.begin_step();
  second.begin_step();
  EXPECT_EQ(first.next(d, image), second.next(d, image));
  EXPECT_GT(first.columns_used(), 0);
}

}  // namespace
}  // namespace luff::coupling::test
