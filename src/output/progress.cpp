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

}  // namespace

ProgressOptions progress_on_standard_output(double t_end, double cells)
{
  if (standard_output_is_terminal())
    return {.t_end = t_end, .cells = cells, .style = ProgressStyle::Live, .every = 0.2, .width = terminal_width() - 1};
  return {.t_end = t_end, .cells = cells, .style = ProgressStyle::Plain, .every = 10};
}

Progress::Progress(std::ostream& out, const ProgressOptions& options) : Progress(out, options, steady_seconds) {}

Progress::Progress(std::ostream& out, const ProgressOptions& options, Clock clock)
    : out_(out), options_(options), clock_(std::move(clock)), last_clock_(clock_())
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
  std::string text = line(progress);
  if (options_.style == ProgressStyle::Live && options_.width > 0)
    text.resize(std::min<std::size_t>(text.size(), options_.width));
  if (options_.style == ProgressStyle::Live)
    out_ << clear_line << text << std::flush;
  else
    out_ << text << std::endl;
  pending_.reset();
}

std::string Progress::line(const StepProgress& p) const
{
  std::string text = fmt::format("step {}{}t {:.5g} of {:.5g}", p.step, gap, p.t, options_.t_end);
  if (p.cfl)
    text += fmt::format("{}CFL {:.2f}", gap, *p.cfl);
  if (p.pressure_iterations)
    text += fmt::format("{}pressure {}", gap, *p.pressure_iterations);
  if (p.coupling_iterations)
    text += fmt::format("{}coupling {}", gap, *p.coupling_iterations);
  if (p.probe)
    text += fmt::format("{}{} {:.4f}", gap, p.probe_name, *p.probe);
  if (!seconds_per_step_)
    return text;
  text += fmt::format("{}{:.3g} s/step", gap, *seconds_per_step_);
  if (options_.cells > 0 && *seconds_per_step_ > 0)
    text += fmt::format("{}{:.3g} Mcells/s", gap, 1e-6 * options_.cells / *seconds_per_step_);
  if (time_per_step_ > 0)
    text += fmt::format("{}{} left", gap, duration((options_.t_end - p.t) / time_per_step_ * *seconds_per_step_));
  return text;
}

}  // namespace luff::output
