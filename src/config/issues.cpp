// SPDX-License-Identifier: BSD-3-Clause
// Order and print issues.
#include "config/issues.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "core/error.hpp"

namespace luff::config {

std::string Place::text() const
{
  return line == 0 || is_argument() ? source : fmt::format("{}:{}", source, line);
}

bool Place::is_argument() const
{
  return source.starts_with("--");
}

void Issues::add(const Place& place, const std::string& text)
{
  issues_.push_back({place, text});
}

void Issues::throw_if_any() const
{
  if (issues_.empty())
    return;
  auto sorted = issues_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Issue& a, const Issue& b) {
    if (a.place.is_argument() != b.place.is_argument())
      return b.place.is_argument();
    return !a.place.is_argument() && a.place.line < b.place.line;
  });
  std::string all;
  for (const auto& issue : sorted)
    all += fmt::format("{}{}: {}", all.empty() ? "" : "\n", issue.place.text(), issue.text);
  throw InputError(all);
}

}  // namespace luff::config
