// SPDX-License-Identifier: BSD-3-Clause
// The interval in which a number of a case must lie.
#pragma once

#include <limits>
#include <string>

namespace luff::config {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true;
  bool with_high = true;

  /// False for NaN and infinities.
  bool contains(double value) const;

  /// As in "must be a number" + text(): "", " > 0", " >= 1", " in (-1, 0.5]".
  std::string text() const;
};

inline constexpr Range any_number{};
inline constexpr Range positive{.low = 0.0, .with_low = false};
inline constexpr Range not_negative{.low = 0.0};
inline constexpr Range at_least_one{.low = 1.0};

}  // namespace luff::config
