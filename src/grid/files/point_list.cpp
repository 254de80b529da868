// SPDX-License-Identifier: BSD-3-Clause
#include "grid/files/point_list.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/readable.hpp"

namespace luff::grid {

namespace {

/// Three finite numbers and nothing else.
std::optional<Vec3> parse_point(std::string line)
{
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  std::istringstream in(line);
  Vec3 x;
  std::string rest;
  if (!(in >> x[0] >> x[1] >> x[2]) || in >> rest || !x.allFinite())
    return std::nullopt;
  return x;
}

}  // namespace

std::vector<Vec3> read_points(const std::filesystem::path& file)
{
  require_readable(file);
  std::ifstream in(file);
  std::vector<Vec3> points;
  bool header_allowed = true;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#')
      continue;
    const auto point = parse_point(line);
    if (!point && !std::exchange(header_allowed, false))
      fail_input("{}:{}: '{}' must be three numbers, x, y and z", file.string(), number, line);
    header_allowed = false;
    if (point)
      points.push_back(*point);
  }
  if (points.size() < 2)
    fail_input("{}: holds {} points; a centreline goes through two at least", file.string(), points.size());
  return points;
}

}  // namespace luff::grid
