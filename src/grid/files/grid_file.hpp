// SPDX-License-Identifier: BSD-3-Clause
// Grids from files.
#pragma once

#include <filesystem>

#include "grid/node_source.hpp"

namespace luff::grid {

/// Opens a structured grid: VTK's where the name ends in .vts or .vtk, PLOT3D's otherwise.  Throws InputError, naming
/// the file, when it is missing, unreadable or empty, and as open_vts() and open_plot3d() do.
[[nodiscard]] CurvilinearNodes open_grid_file(const std::filesystem::path& file);

}  // namespace luff::grid
