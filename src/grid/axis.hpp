// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of grid lines along one axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace luff::grid {

/// A stretch of an axis where the cells have one given width.
struct Refinement {
  double from = 0.0;     ///< [L]
  double to = 0.0;       ///< [L]
  double spacing = 0.0;  ///< [L]
};

struct AxisSpec {
  double from = 0.0;  ///< [L]
  double to = 1.0;    ///< [L]
  int cells = 1;
  std::optional<Refinement> refine;
};

/// Face coordinates x_0 < ... < x_cells [L]: uniform, or a refined stretch with widths that grow geometrically, by one
/// common ratio as nearly as whole cells allow, towards both ends.
///
/// Throws InputError, naming `name`, when the cells are too few (growth above `largest_growth` per cell) or too many
/// (the cells outside would be finer than inside).
[[nodiscard]] std::vector<double> face_coordinates(const AxisSpec& spec, const std::string& name);

/// Growth of the width from one cell to the next beyond which second-order accuracy is lost in practice.
inline constexpr double largest_growth = 1.35;

}  // namespace luff::grid
