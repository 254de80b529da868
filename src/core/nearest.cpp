// SPDX-License-Identifier: BSD-3-Clause
// Edit distance and suggestions.
#include "core/nearest.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace luff {
namespace {

/// Optimal string alignment distance: row i holds the distances from the first i letters of `a` to prefixes of `b`.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t substitution = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::size_t tolerated_differences(std::size_t length)
{
  return std::max<std::size_t>(length >= 4 ? 2 : 1, length / 3);
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& known)
{
  if (known.empty())
    return std::nullopt;
  const auto nearest = std::min_element(known.begin(), known.end(), [name](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  if (edit_distance(name, *nearest) > tolerated_differences(nearest->size()))
    return std::nullopt;
  return *nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known)
{
  if (known.empty())
    return "";
  if (const auto nearest = nearest_name(name, known))
    return fmt::format(" (did you mean '{}'?)", *nearest);
  return fmt::format(" (known: {})", joined(known));
}

std::string joined(const std::vector<std::string>& names)
{
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace luff
