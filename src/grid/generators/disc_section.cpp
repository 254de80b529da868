// SPDX-License-Identifier: BSD-3-Clause
#include "grid/generators/disc_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace luff::grid {

namespace {

using Vec2 = Eigen::Vector2d;

/// Measured on 49^2 and 101^2 nodes, with rings that grow evenly: grid lines are least skewed.
constexpr double core_size = 0.64;
constexpr double equal_angles = 0.3;

/// The point of the unit circle for the side of the square on which (x, y) lies.
Vec2 on_circle(double x, double y)
{
  const bool along_x = std::abs(x) >= std::abs(y);
  const double larger = along_x ? x : y;
  const double m = larger == 0.0 ? 0.0 : (along_x ? y : x) / larger;
  const double angle = equal_angles * m * std::numbers::pi / 4.0 + (1.0 - equal_angles) * std::atan(m);
  const Vec2 c = std::copysign(1.0, larger) * Vec2(std::cos(angle), std::sin(angle));
  return along_x ? c : Vec2(c[1], c[0]);
}

Vec2 ring_map(double x, double y)
{
  const double r = std::max(std::abs(x), std::abs(y));
  return (1.0 - r) * core_size * Vec2(x, y) + r * r * on_circle(x, y);
}

/// Sweeps that round the kinks of the ring map off over the same part of the disc whatever the number of cells, so that
/// grids are refinements of one smooth map: a Jacobi sweep reaches over cells, s sweeps over sqrt(s) of them.
int winslow_sweeps(int cells)
{
  return std::max(2, cells * cells / 100);
}

/// Part of Jacobi's correction that a node takes: half of it, and less and less towards the corners of the rim, where
/// grid lines without a kink would meet under 180 degrees.
double damping(double x, double y)
{
  return 0.5 * (1.0 - std::abs(x * y));
}

/// One damped Jacobi sweep of  g22 P_xx - 2 g12 P_xy + g11 P_yy = 0,  g the metric of the map, the rim fixed
/// [winslow_1966_numerical].
std::vector<Vec2> winslow_sweep(const std::vector<Vec2>& P, int n)
{
  std::vector<Vec2> result = P;
  const auto at = [&](int i, int j) -> const Vec2& { return P[i + j * (n + 1)]; };
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) {
      const Vec2 P_x = 0.5 * (at(i + 1, j) - at(i - 1, j));
      const Vec2 P_y = 0.5 * (at(i, j + 1) - at(i, j - 1));
      const double g11 = P_x.squaredNorm();
      const double g22 = P_y.squaredNorm();
      const double g12 = P_x.dot(P_y);
      const Vec2 cross = at(i + 1, j + 1) - at(i + 1, j - 1) - at(i - 1, j + 1) + at(i - 1, j - 1);
      const Vec2 solved =
          (g22 * (at(i + 1, j) + at(i - 1, j)) + g11 * (at(i, j + 1) + at(i, j - 1)) - 0.5 * g12 * cross) /
          (2.0 * (g11 + g22));
      result[i + j * (n + 1)] += damping(2.0 * i / n - 1.0, 2.0 * j / n - 1.0) * (solved - at(i, j));
    }
  return result;
}

}  // namespace

std::vector<Vec2> disc_section(int cells)
{
  ensure(cells >= 1, "a section has a cell");
  std::vector<Vec2> P;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      P.push_back(ring_map(2.0 * i / cells - 1.0, 2.0 * j / cells - 1.0));
  for (int sweep = 0; sweep < winslow_sweeps(cells); ++sweep)
    P = winslow_sweep(P, cells);
  return P;
}

}  // namespace luff::grid
