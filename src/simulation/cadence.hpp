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
    if (reached(t) < next_ && !(last && t != latest_))
      return false;
    next_ = std::floor(reached(t)) + 1.0;
    latest_ = t;
    return true;
  }
  /// Go on from time t, up to which all that was due was done; `latest`: when something was last.
  void resume(double t, std::optional<double> latest)
  {
    if (interval_)
      next_ = std::floor(reached(t)) + 1.0;
    latest_ = latest;
  }

 private:
  /// Number of instants up to t, with the rounding of a time that many steps added up to.
  [[nodiscard]] double reached(double t) const { return t / *interval_ + 1e-9; }

  std::optional<double> interval_;
  std::optional<double> latest_;
  double next_ = 0.0;  ///< number of the next instant
};

}  // namespace luff::simulation
