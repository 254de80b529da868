// SPDX-License-Identifier: BSD-3-Clause
// Steps fill the time of a run without splinters; what is due from time to time is due once.
#include <gtest/gtest.h>

#include "simulation/cadence.hpp"
#include "simulation/clock.hpp"

namespace luff::simulation {
namespace {

constexpr StepRates at_rest{};

std::vector<double> steps_of(Clock clock, const StepRates& rates)
{
  std::vector<double> lengths;
  while (!clock.finished()) {
    const TimeStep step = clock.next(rates);
    EXPECT_EQ(step.t_old, clock.now());
    EXPECT_EQ(step.index, static_cast<int>(lengths.size()) + 1);
    EXPECT_NEAR(step.t_new - step.t_old, step.dt, 1e-15 * clock.end());
    lengths.push_back(step.dt);
    clock.accept(step);
  }
  EXPECT_EQ(clock.now(), clock.end());
  return lengths;
}

TEST(AClock, TakesEqualStepsThatEndOnTheEnd)
{
  const auto lengths = steps_of(Clock(20.0, 0.02, std::nullopt), at_rest);
  ASSERT_EQ(lengths.size(), 1000U);
  for (const double dt : lengths)
    EXPECT_NEAR(dt, 0.02, 1e-9);
}

TEST(AClock, SharesWhatIsLeftBetweenTheLastTwoSteps)
{
  const auto lengths = steps_of(Clock(1.0, 0.3, std::nullopt), at_rest);
  ASSERT_EQ(lengths.size(), 4U);
  EXPECT_DOUBLE_EQ(lengths[1], 0.3);
  EXPECT_NEAR(lengths[2], 0.2, 1e-15);
  EXPECT_NEAR(lengths[3], 0.2, 1e-15);
}

TEST(AClock, TakesOneStepWhereTheStepIsLongerThanTheRun)
{
  EXPECT_EQ(steps_of(Clock(0.5, 2.0, std::nullopt), at_rest), std::vector<double>{0.5});
}

TEST(AClock, KeepsTheCourantNumberThatTheCaseAsksFor)
{
  const Clock clock(10.0, 1.0, 0.8);
  EXPECT_DOUBLE_EQ(clock.next({.convective = 4.0, .diffusive = 0.0}).dt, 0.2);
  EXPECT_DOUBLE_EQ(clock.next({.convective = 0.1, .diffusive = 0.0}).dt, 1.0) << "time.step is the upper bound";
  EXPECT_DOUBLE_EQ(clock.next({.convective = 0.1, .diffusive = 100.0}).dt, 0.5 / 100.0);
}

TEST(AClock, KeepsAConstantStepWhateverTheFlowDoesWithoutACourantNumber)
{
  EXPECT_DOUBLE_EQ(Clock(10.0, 1.0, std::nullopt).next({.convective = 50.0, .diffusive = 50.0}).dt, 1.0);
}

TEST(AClock, HalvesARejectedStepAndForgetsThatOnceAStepIsAccepted)
{
  Clock clock(10.0, 1.0, std::nullopt);
  clock.reject();
  clock.reject();
  EXPECT_DOUBLE_EQ(clock.next(at_rest).dt, 0.25);
  EXPECT_EQ(clock.now(), 0.0);
  clock.accept(clock.next(at_rest));
  EXPECT_DOUBLE_EQ(clock.next(at_rest).dt, 1.0);
  EXPECT_EQ(clock.rejections(), 0);
}

std::vector<double> dues(Cadence cadence, double dt, int steps)
{
  std::vector<double> times;
  for (int n = 0; n <= steps; ++n)
    if (cadence.due(n * dt, n == steps))
      times.push_back(n * dt);
  return times;
}

TEST(ACadence, IsDueAtEachMultipleThatStepsLandOn)
{
  EXPECT_EQ(dues(Cadence(0.5), 0.125, 12), (std::vector<double>{0.0, 0.5, 1.0, 1.5}));
}

TEST(ACadence, IsDueOnceAfterEachMultipleThatStepsPass)
{
  EXPECT_EQ(dues(Cadence(1.0), 0.75, 5), (std::vector<double>{0.0, 1.5, 2.25, 3.0, 3.75}));
}

TEST(ACadence, IsDueOnceAStepWhereStepsAreLonger)
{
  EXPECT_EQ(dues(Cadence(0.1), 1.0, 3), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
}

TEST(ACadence, IsDueAtTheLastInstantOnlyOnce)
{
  Cadence cadence(1.0);
  EXPECT_TRUE(cadence.due(0.0));
  EXPECT_TRUE(cadence.due(1.0));
  EXPECT_FALSE(cadence.due(1.0, /*last=*/true));
  EXPECT_TRUE(cadence.due(1.5, /*last=*/true));
}

TEST(ACadence, OverlooksTheRoundingOfTimesThatAddUp)
{
  Cadence cadence(0.1);
  int count = 0;
  double t = 0.0;
  for (int n = 0; n <= 1000; ++n, t += 0.01)
    count += cadence.due(t) ? 1 : 0;
  EXPECT_EQ(count, 101);
}

TEST(ACadence, IsNeverDueWithoutAnInterval)
{
  EXPECT_TRUE(dues(Cadence(std::nullopt), 1.0, 3).empty());
}

}  // namespace
}  // namespace luff::simulation
