// SPDX-License-Identifier: BSD-3-Clause
// Zero crossings of a signal about its mean.
#include "output/oscillation.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"

namespace luff::output {

namespace {

constexpr double ripple = 0.05;  // share of the range that a signal must fall below its mean before a rise counts

struct Signal {
  std::span<const double> t;
  std::span<const double> x;
};

Signal cut(const Signal& s, double from, double to)
{
  const auto first = std::lower_bound(s.t.begin(), s.t.end(), from) - s.t.begin();
  const auto last = std::upper_bound(s.t.begin(), s.t.end(), to) - s.t.begin();
  const auto count = std::max<std::ptrdiff_t>(0, last - first);
  return {s.t.subspan(first, count), s.x.subspan(first, count)};
}

/// Trapezoidal rule, so that samples need not be evenly spaced.
double mean_of(const Signal& s)
{
  double integral = 0;
  for (std::size_t i = 1; i < s.t.size(); ++i)
    integral += 0.5 * (s.x[i] + s.x[i - 1]) * (s.t[i] - s.t[i - 1]);
  return integral / (s.t.back() - s.t.front());
}

double range_of(const Signal& s)
{
  const auto [low, high] = std::minmax_element(s.x.begin(), s.x.end());
  return *high - *low;
}

/// Times at which the signal rises through the level.
std::vector<double> rises(const Signal& s, double level, double depth)
{
  std::vector<double> times;
  bool armed = false;
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    if (armed && s.x[i] >= level) {
      const double share = (level - s.x[i - 1]) / (s.x[i] - s.x[i - 1]);
      times.push_back(s.t[i - 1] + share * (s.t[i] - s.t[i - 1]));
      armed = false;
    }
    armed = armed || s.x[i] < level - depth;
  }
  return times;
}

}  // namespace

std::optional<Oscillation> oscillation(std::span<const double> t, std::span<const double> x, double from, double to)
{
  ensure(t.size() == x.size(), "a signal has one value per instant");
  Signal signal = cut({t, x}, from, to);
  if (signal.t.size() < 2)
    return std::nullopt;
  const double depth = ripple * range_of(signal);
  std::vector<double> times = rises(signal, mean_of(signal), depth);
  if (times.size() < 3)
    return std::nullopt;

  // The mean over whole periods, and the rises through it.
  const double mean = mean_of(cut(signal, times.front(), times.back()));
  times = rises(signal, mean, depth);
  if (times.size() < 3)
    return std::nullopt;
  const int periods = static_cast<int>(times.size()) - 1;
  return Oscillation{.peak_to_peak = range_of(cut(signal, times.front(), times.back())),
                     .frequency = periods / (times.back() - times.front()),
                     .mean = mean,
                     .periods = periods};
}

}  // namespace luff::output
