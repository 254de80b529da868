// SPDX-License-Identifier: BSD-3-Clause
// Two columns of a CSV file as a piecewise linear function.
#include "config/time_series.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace luff::config {
namespace {

struct Sample {
  double time;
  double value;
};

/// Two finite numbers and nothing else; separators may be commas, semicolons or blanks.
std::optional<Sample> parse_sample(std::string line)
{
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  std::istringstream in(line);
  Sample sample{};
  std::string rest;
  if (!(in >> sample.time >> sample.value) || in >> rest)
    return std::nullopt;
  return sample;
}

bool is_blank_or_comment(const std::string& line)
{
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

}  // namespace

TimeSeries::TimeSeries(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values))
{
  ensure(!times_.empty() && times_.size() == values_.size(), "a time series has as many values as instants");
}

double TimeSeries::operator()(double t) const
{
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  if (after == times_.begin())
    return values_.front();
  if (after == times_.end())
    return values_.back();
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const double weight = (t - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return values_[i - 1] + weight * (values_[i] - values_[i - 1]);
}

TimeSeries read_time_series(const std::filesystem::path& file)
{
  std::ifstream in(file);
  if (!in)
    fail_input("{}: cannot be read", file.string());
  std::vector<double> times;
  std::vector<double> values;
  bool header_allowed = true;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (is_blank_or_comment(line))
      continue;
    const auto sample = parse_sample(line);
    if (!sample && !std::exchange(header_allowed, false))
      fail_input("{}:{}: '{}' must be two numbers, time and value", file.string(), number, line);
    header_allowed = false;
    if (!sample)
      continue;
    if (!times.empty() && sample->time <= times.back())
      fail_input("{}:{}: time {} must be later than {} before it", file.string(), number, sample->time, times.back());
    times.push_back(sample->time);
    values.push_back(sample->value);
  }
  if (times.empty())
    fail_input("{}: holds no line of two numbers, time and value", file.string());
  return {std::move(times), std::move(values)};
}

}  // namespace luff::config
