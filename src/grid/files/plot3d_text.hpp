// SPDX-License-Identifier: BSD-3-Clause
// PLOT3D grids as text.
#pragma once

#include <filesystem>

#include "grid/node_source.hpp"

namespace luff::grid {

/// Whether a file begins with nothing but numbers in text.
[[nodiscard]] bool is_plot3d_text(const std::filesystem::path& file);

/// See open_plot3d().  Numbers are separated by blanks, commas or ends of lines, may have Fortran's exponents (1.5D-3)
/// and repeats (3*0.0); one or three of them on the first line tell whether the number of blocks is given.
[[nodiscard]] CurvilinearNodes open_plot3d_text(const std::filesystem::path& file);

}  // namespace luff::grid
