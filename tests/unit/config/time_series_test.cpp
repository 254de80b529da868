// SPDX-License-Identifier: BSD-3-Clause
// Piecewise linear functions of time from CSV files.
#include "config/time_series.hpp"

#include "case_text.hpp"

namespace luff::config {
namespace {

std::string complaint_about_series(const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder.write("wave.csv", text);
  try {
    read_time_series(file);
    return "";
  } catch (const InputError& error) {
    return std::string(error.what()).substr(folder.path().string().size() + 1);
  }
}

TEST(TimeSeries, AreLinearBetweenTheirInstants)
{
  const TimeSeries series({0.0, 1.0, 3.0}, {0.0, 2.0, -2.0});
  EXPECT_DOUBLE_EQ(series(0.25), 0.5);
  EXPECT_DOUBLE_EQ(series(1.0), 2.0);
  EXPECT_DOUBLE_EQ(series(1.5), 1.0);
  EXPECT_DOUBLE_EQ(series(3.0), -2.0);
}

TEST(TimeSeries, KeepTheirFirstAndLastValueOutside)
{
  const TimeSeries series({1.0, 2.0}, {5.0, 7.0});
  EXPECT_DOUBLE_EQ(series(-3.0), 5.0);
  EXPECT_DOUBLE_EQ(series(30.0), 7.0);
}

TEST(TimeSeries, AreSmoothWithoutOvershootOnRequest)
{
  const TimeSeries series({0.0, 1.0, 2.0, 3.0, 5.0}, {0.0, 1.0, 1.0, 4.0, 5.0}, {.smooth = true});
  double before = series(0.0);
  for (int n = 1; n <= 500; ++n) {
    const double now = series(0.01 * n);
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_DOUBLE_EQ(series(1.5), 1.0);
  EXPECT_DOUBLE_EQ(series(3.0), 4.0);
  for (const double t : {1.0, 2.0, 3.0})
    EXPECT_NEAR(series(t + 1e-6) - series(t), series(t) - series(t - 1e-6), 1e-11) << "slope at " << t;
}

TEST(TimeSeries, OfASmoothFunctionConvergeToThirdOrderAndMore)
{
  const auto error = [](int n) {
    std::vector<double> times, values;
    for (int i = 0; i <= n; ++i) {
      times.push_back(1.5 * i / n);
      values.push_back(std::exp(times.back()));
    }
    const TimeSeries series(times, values, {.smooth = true});
    double largest = 0.0;
    for (double t = 0.4; t < 1.1; t += 0.01)
      largest = std::max(largest, std::abs(series(t) - std::exp(t)));
    return largest;
  };
  EXPECT_GE(std::log2(error(40) / error(80)), 2.9);
}

TEST(TimeSeries, RepeatOnRequest)
{
  const TimeSeries series({1.0, 2.0, 3.0}, {0.0, 2.0, 0.0}, {.smooth = true, .periodic = true});
  EXPECT_DOUBLE_EQ(series(2.0), 2.0);
  EXPECT_NEAR(series(12.0), 2.0, 1e-14);
  EXPECT_NEAR(series(-7.5), series(2.5), 1e-13);
  EXPECT_NEAR(series(1.0 + 1e-6) - series(1.0), series(3.0) - series(3.0 - 1e-6), 1e-9);
}

TEST(TimeSeries, ThatDoNotEndAsTheyBeginAreRefusedToRepeat)
{
  const TemporaryFolder folder;
  EXPECT_THROW(read_time_series(folder.write("wave.csv", "0, 1\n1, 2\n"), {.periodic = true}), InputError);
  EXPECT_THROW(read_time_series(folder.write("wave.csv", "0, 1\n"), {.periodic = true}), InputError);
  EXPECT_NO_THROW(read_time_series(folder.write("wave.csv", "0, 1\n0.5, 2\n1, 1\n"), {.periodic = true}));
}

TEST(TimeSeries, AreReadWithHeaderCommentsAndAnySeparator)
{
  const TemporaryFolder folder;
  const auto series = read_time_series(folder.write("a.csv", "# pulse\ntime;value\n\n0;1\n1, 3\r\n2\t5\n"));
  EXPECT_DOUBLE_EQ(series(0.5), 2.0);
  EXPECT_DOUBLE_EQ(series(1.5), 4.0);
}

TEST(WrongTimeSeries, AreToldWithTheLine)
{
  EXPECT_EQ(complaint_about_series("t,v\n0,1\n1,x\n"), "wave.csv:3: '1,x' must be two numbers, time and value");
  EXPECT_EQ(complaint_about_series("0,1\n1,2,3\n"), "wave.csv:2: '1,2,3' must be two numbers, time and value");
  EXPECT_EQ(complaint_about_series("0,1\n1,nan\n"), "wave.csv:2: '1,nan' must be two numbers, time and value");
  EXPECT_EQ(complaint_about_series("0,1\n2,1\n2,3\n"), "wave.csv:3: time 2 must be later than 2 before it");
  EXPECT_EQ(complaint_about_series("time,value\n"), "wave.csv: holds no line of two numbers, time and value");
  EXPECT_EQ(complaint_about_series("a,b\nc,d\n"), "wave.csv:2: 'c,d' must be two numbers, time and value");
}

}  // namespace
}  // namespace luff::config
