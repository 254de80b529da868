// SPDX-License-Identifier: BSD-3-Clause
// Membership and wording of ranges.
#include "config/range.hpp"

#include <cmath>

#include <fmt/core.h>

namespace luff::config {

bool Range::contains(double value) const
{
  const bool above = with_low ? value >= low : value > low;
  const bool below = with_high ? value <= high : value < high;
  return std::isfinite(value) && above && below;
}

std::string Range::text() const
{
  const bool bounded_below = std::isfinite(low);
  const bool bounded_above = std::isfinite(high);
  if (bounded_below && bounded_above)
    return fmt::format(" in {}{}, {}{}", with_low ? '[' : '(', low, high, with_high ? ']' : ')');
  if (bounded_below)
    return fmt::format(" {} {}", with_low ? ">=" : ">", low);
  if (bounded_above)
    return fmt::format(" {} {}", with_high ? "<=" : "<", high);
  return "";
}

}  // namespace luff::config
