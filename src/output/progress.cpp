// SPDX-License-Identifier: BSD-3-Clause
// The progress line.
#include "output/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "output/terminal.hpp"

namespace luff::output {

namespace {

constexpr const char* gap = "  ";
constexpr double memory = 0.95;  // share of the mean that a new step keeps

double steady_seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string duration(double seconds)
{
  const auto s = static_cast<long>(std::ceil(seconds));
  if (s < 60)
    return fmt::format("{} s", s);
  if (s < 3600)
    return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

using Part = ProgressPart;

std::string joined(const std::vector<Part>& parts)
{
  std::string text;
  for (const Part& part : parts)
    text += (text.empty() ? "" : gap) + part.text;
  return text;
}

/// Leaves out what matters least until the line fits; cuts it off if nothing else helps.
std::string fitted(std::vector<Part> parts, std::size_t width)
{
  const auto by_importance = [](const Part& a, const Part& b) { return a.importance < b.importance; };
  while (parts.size() > 1 && joined(parts).size() > width)
    parts.erase(std::min_element(parts.begin(), parts.end(), by_importance));
  return joined(parts).substr(0, width);
}

std::vector<Part> parts_of_step(const StepProgress& p, double t_end)
{
  std::vector<Part> parts{{7, fmt::format("step {}", p.step)}, {8, fmt::format("t {:.5g} of {:.5g}", p.t, t_end)}};
  if (p.cfl)
    parts.push_back({2, fmt::format("CFL {:.2f}", *p.cfl)});
  if (p.pressure_iterations)
    parts.push_back({1, fmt::format("pressure {}", *p.pressure_iterations)});
  if (p.coupling_iterations)
    parts.push_back({3, fmt::format("coupling {}", *p.coupling_iterations)});
  if (p.probe)
    parts.push_back({5, fmt::format("{} {:.4f}", p.probe_name, *p.probe)});
  return parts;
}

}  // namespace

ProgressOptions progress_on_standard_output(double t_start, double t_end, double cells)
{
  if (standard_output_is_terminal())
    return {.t_start = t_start,
            .t_end = t_end,
            .cells = cells,
            .style = ProgressStyle::Live,
            .every = 0.2,
            .width = terminal_width() - 1};
  return {.t_start = t_start, .t_end = t_end, .cells = cells, .style = ProgressStyle::Plain, .every = 10};
}

Progress::Progress(std::ostream& out, const ProgressOptions& options) : Progress(out, options, steady_seconds) {}

Progress::Progress(std::ostream& out, const ProgressOptions& options, Clock clock)
    : out_(out), options_(options), clock_(std::move(clock)), last_clock_(clock_()), last_t_(options.t_start)
{
}

void Progress::step(const StepProgress& progress)
{
  const double now = clock_();
  measure(progress.t, now);
  if (last_shown_ && now - *last_shown_ < options_.every) {
    pending_ = progress;
    return;
  }
  show(progress);
  last_shown_ = now;
}

void Progress::finish()
{
  if (pending_)
    show(*pending_);
  if (last_shown_ && options_.style == ProgressStyle::Live)
    out_ << std::endl;
}

void Progress::measure(double t, double now)
{
  const double seconds = now - last_clock_;
  const double time = t - last_t_;
  seconds_per_step_ = seconds_per_step_ ? memory * *seconds_per_step_ + (1 - memory) * seconds : seconds;
  time_per_step_ = time_per_step_ > 0 ? memory * time_per_step_ + (1 - memory) * time : time;
  last_clock_ = now;
  last_t_ = t;
}

void Progress::show(const StepProgress& progress)
{
  const std::string text = line(progress);
  if (options_.style == ProgressStyle::Live)
    out_ << clear_line << text << std::flush;
  else
    out_ << text << std::endl;
  pending_.reset();
}

std::string Progress::line(const StepProgress& progress) const
{
  std::vector<Part> parts = parts_of_step(progress, options_.t_end);
  add_speed(progress, parts);
  const bool narrow = options_.style == ProgressStyle::Live && options_.width > 0;
  return narrow ? fitted(std::move(parts), options_.width) : joined(parts);
}

void Progress::add_speed(const StepProgress& p, std::vector<Part>& parts) const
{
  if (!seconds_per_step_)
    return;
  const double seconds = *seconds_per_step_;
  parts.push_back({4, fmt::format("{:.3g} s/step", seconds)});
  if (options_.cells > 0 && seconds > 0)
    parts.push_back({0, fmt::format("{:.3g} Mcells/s", 1e-6 * options_.cells / seconds)});
  if (time_per_step_ > 0)
    parts.push_back({6, fmt::format("ETA {}", duration((options_.t_end - p.t) / time_per_step_ * seconds))});
}

}  // namespace luff::output
