// SPDX-License-Identifier: BSD-3-Clause
// Time of a run: how far it has come and how long the next step is.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/time_step.hpp"
#include "fluid/stages.hpp"

namespace luff::simulation {

/// How fast information crosses cells: with dt, the CFL and diffusion numbers.
struct StepRates {
  double convective = 0.0;  ///< max over cells of sum_d |U_d|/h_d [1/T]
  double diffusive = 0.0;   ///< nu sum_d 1/h_d^2 [1/T]
  fluid::StepLimits limits = fluid::step_limits(fluid::TimeScheme::Rk3);
};

class Clock {
 public:
  /// With `cfl`, `longest_step` is an upper bound and the step follows the flow; without, every step is that long.
  Clock(double end, double longest_step, std::optional<double> cfl) : end_(end), longest_step_(longest_step), cfl_(cfl)
  {
  }

  [[nodiscard]] double now() const { return now_; }
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] bool finished() const { return now_ >= end_ * (1.0 - 1e-12); }

  /// The next step, halved as often as it was rejected; the last one ends on the end.
  [[nodiscard]] TimeStep next(const StepRates& rates) const
  {
    double dt = longest_step_;
    if (cfl_ && rates.convective > 0.0)
      dt = std::min(dt, *cfl_ / rates.convective);
    if (cfl_ && rates.diffusive > 0.0)
      dt = std::min(dt, rates.limits.diffusive / rates.diffusive);
    dt = std::ldexp(dt, -rejections_);
    const double left = end_ - now_;
    // The last steps share what is left, so that none is a splinter.
    if (dt * (1.0 + 1e-9) >= left)
      dt = left;
    else if (2.0 * dt > left)
      dt = 0.5 * left;
    return {.t_old = now_, .t_new = dt == left ? end_ : now_ + dt, .dt = dt, .index = steps_ + 1};
  }
  void accept(const TimeStep& step)
  {
    now_ = step.t_new;
    steps_ = step.index;
    rejections_ = 0;
  }
  /// Go on from the end of an accepted step.
  void resume(double t, int steps)
  {
    now_ = t;
    steps_ = steps;
    rejections_ = 0;
  }
  /// The step did not converge: the next one is half as long.
  void reject() { ++rejections_; }
  [[nodiscard]] int rejections() const { return rejections_; }

 private:
  double end_;
  double longest_step_;
  std::optional<double> cfl_;
  double now_ = 0.0;
  int steps_ = 0;
  int rejections_ = 0;
};

}  // namespace luff::simulation
