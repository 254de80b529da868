// SPDX-License-Identifier: BSD-3-Clause
// The progress line.
#include "output/progress.hpp"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

namespace luff::output::test {
namespace {

class ProgressLine : public testing::Test {
 protected:
  Progress progress(ProgressOptions options)
  {
    return {out, options, [this] { return now; }};
  }
  int lines() const
  {
    const std::string text = out.str();
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }

  std::ostringstream out;
  double now = 100;
};

TEST_F(ProgressLine, TellsStepTimeIterationsProbeSpeedAndWhatIsLeft)
{
  auto p = progress({.t_end = 20, .cells = 1e6});
  now += 0.5;
  p.step({.step = 1,
          .t = 0.05,
          .cfl = 0.421,
          .pressure_iterations = 7,
          .coupling_iterations = 4,
          .probe_name = "tip y",
          .probe = 0.12345});
  EXPECT_EQ(
      out.str(),
      "step 1  t 0.05 of 20  CFL 0.42  pressure 7  coupling 4  tip y 0.1235  0.5 s/step  2 Mcells/s  ETA 3 min 20 s\n");
}

TEST_F(ProgressLine, LeavesOutWhatIsNotThere)
{
  auto p = progress({.t_end = 2});
  now += 0.25;
  p.step({.step = 1, .t = 0.5});
  EXPECT_EQ(out.str(), "step 1  t 0.5 of 2  0.25 s/step  ETA 1 s\n");
}

TEST_F(ProgressLine, PlainLinesComeNoOftenerThanAskedAndTheLastStepIsNotLost)
{
  auto p = progress({.t_end = 1, .every = 10});
  for (int step = 1; step <= 100; ++step) {
    now += 0.5;
    p.step({.step = step, .t = 0.01 * step});
  }
  EXPECT_EQ(lines(), 5);
  p.finish();
  EXPECT_EQ(lines(), 6);
  EXPECT_NE(out.str().find("step 100  t 1 of 1"), std::string::npos);
  EXPECT_EQ(out.str().find('\r'), std::string::npos);
}

TEST_F(ProgressLine, ALiveLineRenewsItselfWithinTheWidthOfTheTerminal)
{
  auto p = progress({.t_end = 1, .cells = 1e6, .style = ProgressStyle::Live, .every = 0, .width = 20});
  for (int step = 1; step <= 3; ++step) {
    now += 0.5;
    p.step({.step = step, .t = 0.01 * step, .cfl = 0.5});
  }
  EXPECT_EQ(lines(), 0);
  std::istringstream text(out.str());
  std::string part;
  std::getline(text, part, '\r');
  int renewals = 0;
  while (std::getline(text, part, '\r')) {
    ++renewals;
    EXPECT_EQ(part.substr(0, 3), "\033[K");
    EXPECT_LE(part.size(), 3u + 20u);
    EXPECT_NE(part.find("t 0.0"), std::string::npos);
  }
  EXPECT_EQ(renewals, 3);
  p.finish();
  EXPECT_EQ(lines(), 1);
}

TEST_F(ProgressLine, ANarrowTerminalShowsWhatMattersMost)
{
  auto p = progress({.t_end = 20, .cells = 1e6, .style = ProgressStyle::Live, .width = 79});
  now += 0.5;
  p.step({.step = 1,
          .t = 0.05,
          .cfl = 0.421,
          .pressure_iterations = 7,
          .coupling_iterations = 4,
          .probe_name = "tip y",
          .probe = 0.12345});
  EXPECT_EQ(out.str(), "\r\033[Kstep 1  t 0.05 of 20  coupling 4  tip y 0.1235  0.5 s/step  ETA 3 min 20 s");
}

TEST_F(ProgressLine, TheTimeLeftFollowsAStepThatChanges)
{
  auto p = progress({.t_end = 10, .every = 0});
  for (int step = 1; step <= 400; ++step) {
    now += step <= 200 ? 1 : 2;
    p.step({.step = step, .t = 0.01 * step});
  }
  EXPECT_NE(p.line({.step = 400, .t = 4}).find("2 s/step  ETA 20 min"), std::string::npos)
      << p.line({.step = 400, .t = 4});
}

}  // namespace
}  // namespace luff::output::test
