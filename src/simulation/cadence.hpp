// SPDX-License-Identifier: BSD-3-Clause
// When something is due that is written from time to time.
#pragma once

#include <cmath>
#include <optional>

namespace luff::simulation {

/// Instants at which something is due: every `interval` from t = 0 on, and the last one of a run.
class Cadence {
 public:
  /// Without an interval nothing is ever due.
  explicit Cadence(std::optional<double> interval) : interval_(interval) {}

  /// True once for each instant reached; at the last instant true unless it was already.  t does not decrease.
  bool due(double t, bool last = false)
  {
    if (!interval_)
      return false;
    // The rounding of a time that many steps added up to.
    const double reached = t / *interval_ + 1e-9;
    if (reached < next_ && !(last && t != latest_))
      return false;
    next_ = std::floor(reached) + 1.0;
    latest_ = t;
    return true;
  }

 private:
  std::optional<double> interval_;
  std::optional<double> latest_;
  double next_ = 0.0;  ///< number of the next instant
};

}  // namespace luff::simulation
