// SPDX-License-Identifier: BSD-3-Clause
// Amplitude and frequency of signals whose answers are known.
#include "output/oscillation.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace luff::output::test {
namespace {

using std::numbers::pi;

struct Samples {
  std::vector<double> t, x;
  Samples(double end, double dt, const std::function<double(double)>& f)
  {
    for (int i = 0; i * dt <= end; ++i) {
      t.push_back(i * dt);
      x.push_back(f(t.back()));
    }
  }
  auto measure(double from, double to) const { return oscillation(t, x, from, to); }
};

TEST(Oscillation, AmplitudeAndFrequencyOfASineWithAnOffset)
{
  const Samples s(20, 0.01, [](double t) { return 3 + 0.5 * std::sin(2 * pi * 0.318 * t + 1); });
  const auto o = s.measure(2.3, 19.1);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->frequency, 0.318, 1e-5);
  EXPECT_NEAR(o->peak_to_peak, 1.0, 1e-4);
  EXPECT_NEAR(o->mean, 3, 1e-4);
  EXPECT_EQ(o->periods, 5);
}

TEST(Oscillation, ATransientBeforeTheWindowDoesNotCount)
{
  const Samples s(40, 0.01, [](double t) { return t < 10 ? 50 - t : std::sin(t); });
  const auto o = s.measure(10, 40);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->frequency, 1 / (2 * pi), 1e-5);
  EXPECT_NEAR(o->peak_to_peak, 2, 1e-4);
}

TEST(Oscillation, HigherHarmonicsAndNoiseAddNoPeriods)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  const Samples s(60, 0.01, [&](double t) { return std::sin(t) + 0.4 * std::sin(3 * t) + noise(random); });
  const auto o = s.measure(0, 60);
  ASSERT_TRUE(o);
  EXPECT_EQ(o->periods, 8);
  EXPECT_NEAR(o->frequency, 1 / (2 * pi), 1e-3);
}

TEST(Oscillation, StepsOfUnequalLengthDoNotBiasTheMean)
{
  std::vector<double> t, x;
  for (double time = 0; time<60; time += std::sin(time)> 0 ? 0.002 : 0.05) {
    t.push_back(time);
    x.push_back(std::sin(time));
  }
  const auto o = oscillation(t, x, 0, 60);
  ASSERT_TRUE(o);
  EXPECT_NEAR(o->mean, 0, 2e-3);
  EXPECT_NEAR(o->frequency, 1 / (2 * pi), 1e-4);
}

TEST(Oscillation, NothingIsSaidOfFewerThanTwoPeriods)
{
  const Samples s(20, 0.01, [](double t) { return std::sin(t); });
  EXPECT_FALSE(s.measure(0, 12));
  EXPECT_FALSE(s.measure(5, 5));
  EXPECT_FALSE(s.measure(30, 40));
  EXPECT_FALSE(oscillation({}, {}, 0, 1));
  const Samples constant(20, 0.01, [](double) { return 0.1; });
  EXPECT_FALSE(constant.measure(0, 20));
  const Samples drift(20, 0.01, [](double t) { return t; });
  EXPECT_FALSE(drift.measure(0, 20));
}

TEST(Oscillation, UnitsDoNotChangeIt)
{
  const Samples s(20, 0.01, [](double t) { return std::sin(2 * t); });
  const Samples tiny(20, 0.01, [](double t) { return 1e-12 * std::sin(2 * t); });
  EXPECT_DOUBLE_EQ(s.measure(0, 20)->frequency, tiny.measure(0, 20)->frequency);
  EXPECT_NEAR(tiny.measure(0, 20)->peak_to_peak, 1e-12 * s.measure(0, 20)->peak_to_peak, 1e-26);
}

}  // namespace
}  // namespace luff::output::test
