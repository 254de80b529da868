// SPDX-License-Identifier: BSD-3-Clause
// A square of cells that fills a disc: the section of pipes.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace luff::grid {

/// Nodes of the unit disc, (cells + 1)^2 of them, i fastest; node (i, j) lies on the rim where i or j is 0 or `cells`.
///
/// Rings of the square [-1, 1]^2, at r = max(|x|, |y|), become rings of the disc,
///
///   P = (1 - r) 0.64 (x, y) + r^2 (cos a, sin a),   a = 0.3 (pi/4) m + 0.7 atan(m),
///
/// m the smaller over the larger of |x| and |y|, a counted from the axis of the larger; cells^2/100 damped sweeps
/// of Winslow's equations then round the kinks on the diagonals off.  The angle between grid lines at cell centres
/// stays above 65 degrees up to 48 cells, above 54 up to 100, above 44 up to 200; at the four corners of the rim it is
/// 180 degrees, as for every such map: metrics are made for cells and faces, never at those nodes.
[[nodiscard]] std::vector<Eigen::Vector2d> disc_section(int cells);

}  // namespace luff::grid
