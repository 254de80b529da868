// SPDX-License-Identifier: BSD-3-Clause
// Pipes of round and lobed section along a curve.
#pragma once

#include <functional>
#include <vector>

#include "grid/generators/centreline.hpp"
#include "grid/node_source.hpp"

namespace luff::grid {

struct PipeShape {
  Centreline centreline;
  std::vector<double> stations;          ///< arc length of the rings of nodes [L], increasing, at least two
  int across = 1;                        ///< cells along both directions of the section
  std::function<double(double)> radius;  ///< r(s) [L]
  /// Outward from that radius [L], at arc length s and angle theta from e1 towards e2; none: round.
  std::function<double(double, double)> bulge = nullptr;
};

/// Nodes x(s) + X e1 + Y e2 with (X, Y) = P (r + b rho^2): P = rho (cos theta, sin theta) a node of disc_section(), r
/// the radius, b the bulge.  Index directions: xi and eta across, along e1 and e2; zeta along the curve: right-handed.
///
/// Throws InputError, naming the arc length, where the radius is not positive or the pipe bends so sharply that its
/// sections meet.
[[nodiscard]] CurvilinearNodes make_pipe(PipeShape shape);

}  // namespace luff::grid
