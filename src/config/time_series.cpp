// SPDX-License-Identifier: BSD-3-Clause
// Two columns of a CSV file as a function.
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

TimeSeries::TimeSeries(std::vector<double> times, std::vector<double> values, const SeriesOptions& options)
    : times_(std::move(times)), values_(std::move(values)), periodic_(options.periodic)
{
  ensure(!times_.empty() && times_.size() == values_.size(), "a time series has as many values as instants");
  if (options.smooth && times_.size() > 1)
    for (std::size_t i = 0; i < times_.size(); ++i)
      slopes_.push_back(slope_at(i));
}

double TimeSeries::slope_between(std::size_t before) const
{
  return (values_[before + 1] - values_[before]) / (times_[before + 1] - times_[before]);
}

/// Brodlie's weighted harmonic mean of the slopes on both sides, 0 at an extremum: Eq. (5) of [fritsch_1984_method]. At
/// an end that no period joins to the other, the slope beside it.
double TimeSeries::slope_at(std::size_t i) const
{
  const std::size_t last = times_.size() - 1;
  const bool at_end = i == 0 || i == last;
  if (at_end && !periodic_)
    return slope_between(i == 0 ? 0 : last - 1);
  const std::size_t before = at_end ? last - 1 : i - 1;
  const std::size_t after = at_end ? 0 : i;
  const double s_1 = slope_between(before);
  const double s_2 = slope_between(after);
  if (s_1 * s_2 <= 0.0)
    return 0.0;
  const double h_1 = times_[before + 1] - times_[before];
  const double h_2 = times_[after + 1] - times_[after];
  const double alpha = (h_1 + 2.0 * h_2) / (3.0 * (h_1 + h_2));
  return s_1 * s_2 / (alpha * s_2 + (1.0 - alpha) * s_1);
}

double TimeSeries::operator()(double t) const
{
  if (periodic_) {
    const double period = times_.back() - times_.front();
    t -= period * std::floor((t - times_.front()) / period);
  }
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  if (after == times_.begin())
    return values_.front();
  if (after == times_.end())
    return values_.back();
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const double h = times_[i] - times_[i - 1];
  const double s = (t - times_[i - 1]) / h;
  const double linear = values_[i - 1] + s * (values_[i] - values_[i - 1]);
  if (slopes_.empty())
    return linear;
  // Hermite's cubic: the straight line, and what the slopes at both ends differ from it.
  const double slope = slope_between(i - 1);
  return linear + h * s * (1.0 - s) * ((1.0 - s) * (slopes_[i - 1] - slope) - s * (slopes_[i] - slope));
}

TimeSeries read_time_series(const std::filesystem::path& file, const SeriesOptions& options)
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
  if (options.periodic && times.size() < 2)
    fail_input("{}: holds one instant; `periodic` needs two at least, a period apart", file.string());
  if (options.periodic && values.front() != values.back())
    fail_input("{}: begins with {} and ends with {}; `periodic` needs the same value a period later", file.string(),
               values.front(), values.back());
  return {std::move(times), std::move(values), options};
}

}  // namespace luff::config
