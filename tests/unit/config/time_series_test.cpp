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
