// SPDX-License-Identifier: BSD-3-Clause
// The same case on a finer or coarser grid.
#include "config/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace luff::config {

Resolution::Resolution(double factor) : factor_(factor)
{
  if (!positive.contains(factor))
    fail_input("--resolution {}: must be a number > 0", factor);
}

void Resolution::visit_key(std::string_view /*name*/, const Value& value, const Spec& spec)
{
  if (spec.scaling == Scaling::Count) {
    if (int* const* count = std::get_if<int*>(&value))
      **count = scaled_count(**count);
    if (std::array<int, 2>* const* counts = std::get_if<std::array<int, 2>*>(&value))
      for (int& count : **counts)
        count = scaled_count(count);
  }
  if (spec.scaling == Scaling::Size)
    if (double* const* size = std::get_if<double*>(&value))
      **size = scaled_size(**size);
}

int Resolution::scaled_count(int count) const
{
  const double scaled = std::max(1.0, std::round(count * factor_));
  if (scaled > std::numeric_limits<int>::max())
    fail_input("--resolution {}: makes {} cells of {}, too many", factor_, scaled, count);
  return static_cast<int>(scaled);
}

double Resolution::scaled_size(double size) const
{
  const double scaled = size / factor_;
  if (!positive.contains(scaled))
    fail_input("--resolution {}: makes {} of the size {}", factor_, scaled, size);
  return scaled;
}

}  // namespace luff::config
