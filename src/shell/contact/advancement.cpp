// SPDX-License-Identifier: BSD-3-Clause
// How far two pieces of surface may move before they come too close.
#include "shell/contact/advancement.hpp"

#include <algorithm>

namespace luff::shell {

namespace {

/// Bound of the speed at which the distance changes: each piece moves at most as far as its fastest corner. What all
/// corners share changes no distance and is taken away.
double approach_bound(PairKind kind, const Corners& dx)
{
  const Vec3 common = 0.25 * (dx[0] + dx[1] + dx[2] + dx[3]);
  std::array<double, 4> speed{};
  for (int k = 0; k < 4; ++k)
    speed[k] = (dx[k] - common).norm();
  return kind == PairKind::PointTriangle ? speed[0] + std::max({speed[1], speed[2], speed[3]})
                                         : std::max(speed[0], speed[1]) + std::max(speed[2], speed[3]);
}

Corners moved(const Corners& x, const Corners& dx, double fraction)
{
  Corners y;
  for (int k = 0; k < 4; ++k)
    y[k] = x[k] + fraction * dx[k];
  return y;
}

}  // namespace

double safe_fraction(PairKind kind, const Corners& x, const Corners& dx, double keep, double limit)
{
  // Round-off of positions a thousand times the distance must not carry the pieces past each other.
  constexpr double caution = 1 - 1e-10;
  constexpr double near_enough = 0.01;  // of the room at the start: what is left when stopping early
  constexpr int most_advances = 1000;   // pieces that slide along each other; stopping early is safe
  const double bound = approach_bound(kind, dx);
  const double start = closest(kind, x).distance;
  const double least = keep * start;
  double fraction = 0, room = start - least;
  for (int n = 0; n < most_advances; ++n) {
    if (!(room < bound * (limit - fraction)))
      return limit;
    fraction += caution * room / bound;
    room = closest(kind, moved(x, dx, fraction)).distance - least;
    if (room < near_enough * (start - least))
      break;
  }
  return fraction;
}

}  // namespace luff::shell
