// SPDX-License-Identifier: BSD-3-Clause
// Structured grids from VTK's files.
#pragma once

#include <filesystem>

#include "grid/node_source.hpp"

namespace luff::grid {

/// Opens a structured grid in VTK's XML format (.vts), of which ranks read their own parts, or its legacy format
/// (.vtk), of which each reads the whole.  Throws InputError with VTK's complaint when the file is of another kind,
/// damaged or cut short, or the grid has no cells along some direction.
[[nodiscard]] CurvilinearNodes open_vts(const std::filesystem::path& file);
[[nodiscard]] CurvilinearNodes open_legacy_vtk(const std::filesystem::path& file);

}  // namespace luff::grid
