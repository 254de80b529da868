// SPDX-License-Identifier: BSD-3-Clause
// Aitken's relaxation.
#include "coupling/aitken.hpp"

#include <gtest/gtest.h>

#include "interface_maps.hpp"

namespace luff::coupling::test {
namespace {

using Eigen::VectorXd;

TEST(Aitken, SolvesALinearMapOfOneUnknownInThreeIterations)
{
  const LinearMap map = map_with_eigenvalues(VectorXd::Constant(1, -10), 1);
  Aitken aitken(0.5, 1);
  VectorXd d = VectorXd::Zero(1);
  EXPECT_EQ(solve(map, d, aitken, 1e-12, 30).iterations, 3);
  EXPECT_NEAR(aitken.factor(), 1.0 / 11, 1e-14);
}

TEST(Aitken, ConvergesWhereTheAddedMassIsTenAndAHundredTimesTheShells)
{
  for (double ratio : {10., 100.}) {
    const LinearMap map = added_mass_map(8, ratio, 3);
    Aitken aitken(0.5, 1);
    VectorXd d = VectorXd::Zero(8);
    const auto report = solve(map, d, aitken, 1e-8, 300);
    EXPECT_TRUE(report.converged()) << report.residual;
    EXPECT_LT((d - map.fixed_point()).lpNorm<Eigen::Infinity>(), 1e-6);
    RecordProperty("iterations", report.iterations);
  }
}

TEST(Aitken, StartsAStepWithTheLastFactorButNoMoreThanTheInitialOne)
{
  Aitken aitken(0.5, 1);
  VectorXd d = VectorXd::Zero(1);
  solve(map_with_eigenvalues(VectorXd::Constant(1, -10), 1), d, aitken, 1e-12, 30);
  aitken.begin_step();
  EXPECT_NEAR(aitken.factor(), 1.0 / 11, 1e-14);
  aitken.end_step(true);
  solve(map_with_eigenvalues(VectorXd::Constant(1, -0.1), 1), d, aitken, 1e-12, 30);
  EXPECT_NEAR(aitken.factor(), 1.0 / 1.1, 1e-13);
  aitken.begin_step();
  EXPECT_EQ(aitken.factor(), 0.5);
}

TEST(Aitken, KeepsItsFactorWithinTheBound)
{
  Aitken aitken(0.5, 0.75);
  aitken.begin_step();
  VectorXd d = VectorXd::Ones(1);
  const LinearMap nearly_neutral = {Eigen::MatrixXd::Constant(1, 1, 0.99),
                                    VectorXd::Zero(1)};  // the secant gives w = 100
  d = aitken.next(d, nearly_neutral(d));
  aitken.next(d, nearly_neutral(d));
  EXPECT_EQ(aitken.factor(), 0.75);
}

TEST(Aitken, ForgetsItsFactorAfterAStepThatFailed)
{
  Aitken aitken(0.5, 1);
  VectorXd d = VectorXd::Zero(2);
  solve(map_with_eigenvalues(Eigen::Vector2d(-100, -50), 1), d, aitken, 1e-12, 2);
  EXPECT_EQ(aitken.factor(), 0.5);
}

TEST(Aitken, GoesOnFromItsHistoryWithTheSameFactor)
{
  Aitken first(0.5, 1);
  first.begin_step();
  const VectorXd zero = VectorXd::Zero(1);
  (void)first.next(zero, VectorXd::Constant(1, 1.0));
  (void)first.next(VectorXd::Constant(1, 0.5), VectorXd::Constant(1, -2.0));
  first.end_step(/*converged=*/true);
  EXPECT_NE(first.factor(), 0.5);
  Aitken second(0.5, 1);
  second.restore(first.history());
  EXPECT_EQ(second.factor(), first.factor());
}

}  // namespace
}  // namespace luff::coupling::test
