// SPDX-License-Identifier: BSD-3-Clause
// How good the cells of a grid are.
#pragma once

#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace luff::grid {

/// Numbers of one cell, all without a unit.  T_a are the mean edges of a cell along its three directions, S_a its area
/// vectors: S_1 = T_2 x T_3 and so on at the centre, exact ones on faces.
struct CellQuality {
  double gap = 0.0;       ///< |sum of the area vectors of its faces, outwards| over the largest |S_a|: round-off
  double volume = 0.0;    ///< exact volume over |T_1||T_2||T_3|: 1 in a box, positive unless the cell is inside out
  double jacobian = 0.0;  ///< smallest T_a . S_a over |T_a||S_a|, S_a means of opposite faces: positive unless folded
  double skew = 0.0;      ///< largest |cos(S_a, S_b)|: 0 where grid lines are orthogonal
  double aspect = 1.0;    ///< largest |T_a| over the smallest
};

/// Of an owned cell of a grid of any kind.
[[nodiscard]] CellQuality cell_quality(const Grid& grid, int i, int j, int k);

/// A number, the cell where it is worst and the centre of that cell [L].
struct Worst {
  double value = 0.0;
  Index3 cell{};
  Vec3 place = Vec3::Zero();
};

struct GridQuality {
  Worst gap;       ///< largest
  Worst volume;    ///< smallest
  Worst jacobian;  ///< smallest
  Worst skew;      ///< largest
  Worst aspect;    ///< largest
  Worst growth;    ///< largest volume of a cell over that of the one before or behind it along any direction
};

/// Collective.
[[nodiscard]] GridQuality measure_quality(const Grid& grid);

/// Limits of what cells should be; beyond them a run is warned.
inline constexpr double largest_skew = 0.65;  ///< the pressure's preconditioner leaves cross terms out
inline constexpr double largest_volume_growth = 2.0;
inline constexpr double largest_aspect = 100.0;

/// Throws InputError, naming the worst cell and its place, when a cell is inside out, folded, without volume, or its
/// faces do not close.
void require_sound(const GridQuality& quality);

/// What is allowed but costs accuracy or iterations, a sentence each with the worst cell.
[[nodiscard]] std::vector<std::string> quality_warnings(const GridQuality& quality);

/// Throws InputError, naming a node, unless opposite sides along periodic directions differ by a translation, to a
/// millionth of the smallest width.  Collective.
void require_periodic_sides(const Grid& grid, const NodeSource& source);

}  // namespace luff::grid
