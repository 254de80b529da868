// SPDX-License-Identifier: BSD-3-Clause
// Face coordinates of stretched axes.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace luff::test {

/// n cells over [from, to] with widths that vary smoothly by (1 + amplitude) : (1 - amplitude).
inline std::vector<double> stretched_faces(double from, double to, int n, double amplitude)
{
  std::vector<double> x(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    x[i] = from + (to - from) * (s + amplitude * std::sin(2.0 * std::numbers::pi * s) / (2.0 * std::numbers::pi));
  }
  x.front() = from;
  x.back() = to;
  return x;
}

}  // namespace luff::test
