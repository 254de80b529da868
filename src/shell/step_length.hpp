// SPDX-License-Identifier: BSD-3-Clause
// Steps of a parameter that are halved where they fail and grow again.
#pragma once

#include <algorithm>
#include <cmath>

namespace luff::shell {

class StepLength {
 public:
  /// Steps of at most `whole`, halved at most so many times.
  StepLength(double whole, int max_halvings) : whole_(whole), smallest_(std::ldexp(whole, -max_halvings)), now_(whole)
  {
  }

  double now() const { return now_; }
  /// Steps in a row that succeeded since the last change.
  int successes() const { return successes_; }
  /// As they were at some time.
  void restore(double now, int successes)
  {
    now_ = now;
    successes_ = successes;
  }

  /// Where a step from here ends: at `mark`, or before it. What would leave a sliver goes all the way.
  double end(double from, double mark) const { return from + 1.01 * now_ >= mark ? mark : from + now_; }

  /// False where the step is as short as it may be.
  bool halve()
  {
    successes_ = 0;
    if (now_ <= smallest_)
      return false;
    now_ /= 2;
    return true;
  }

  /// After two steps in a row that succeeded, twice as long.
  void succeeded()
  {
    if (++successes_ < 2)
      return;
    successes_ = 0;
    now_ = std::min(2 * now_, whole_);
  }

 private:
  double whole_;
  double smallest_;
  double now_;
  int successes_ = 0;
};

}  // namespace luff::shell
