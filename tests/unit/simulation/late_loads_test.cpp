// SPDX-License-Identifier: BSD-3-Clause
// Sums over loads between steps.
#include <gtest/gtest.h>

#include "simulation/late_loads.hpp"

namespace luff::simulation {
namespace {

double pressure_at(double t)
{
  return 2.0 - 3.0 * t;
}

/// A step whose friction is 7, and whose pressure is linear in time.
LateSums sums_of(const TimeStep& step)
{
  const double extrapolated = pressure_at(step.t_new) + 0.25;  // whatever it is off by
  return {step, {7.0 + extrapolated}, {extrapolated}, {pressure_at(0.5 * (step.t_old + step.t_new))}};
}

TEST(LateSums, AreExactForPressuresThatChangeEvenlyOverStepsOfAnyLengths)
{
  for (const double end : {0.31, 0.5, 1.7}) {
    const TimeStep step{.t_old = 0.1, .t_new = 0.3, .dt = 0.2, .index = 1};
    const TimeStep next{.t_old = 0.3, .t_new = end, .dt = end - 0.3, .index = 2};
    const LateSums late = sums_of(step);
    EXPECT_EQ(late.t(), 0.3);
    EXPECT_NEAR(late.interpolated(next, std::array{pressure_at(0.5 * (0.3 + end))})[0], 7.0 + pressure_at(0.3), 1e-14);
    EXPECT_EQ(late.extrapolated()[0], 7.0 + pressure_at(0.3) + 0.25);
  }
}

TEST(LateSums, ComeBackFromTheirNumbers)
{
  const TimeStep next{.t_old = 0.3, .t_new = 0.4, .dt = 0.1, .index = 2};
  const LateSums late = sums_of({.t_old = 0.1, .t_new = 0.3, .dt = 0.2, .index = 1});
  const std::vector<double> numbers = late.numbers();
  const auto again = LateSums::of(numbers);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->numbers(), numbers);
  EXPECT_EQ(again->interpolated(next, std::array{1.0}), late.interpolated(next, std::array{1.0}));
  EXPECT_FALSE(LateSums::of({}));
}

}  // namespace
}  // namespace luff::simulation
