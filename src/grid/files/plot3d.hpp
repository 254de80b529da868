// SPDX-License-Identifier: BSD-3-Clause
// Grids from PLOT3D files.
#pragma once

#include <filesystem>

#include "grid/node_source.hpp"

namespace luff::grid {

/// Opens a three-dimensional PLOT3D grid of one block, "whole" format, with or without the number of blocks before its
/// dimensions and blanking after its coordinates: text; binary; or Fortran's unformatted records, whose markers may
/// have 4 or 8 bytes and which may be split.  Single or double precision and either byte order are told apart by
/// markers and sizes.  Nodes are read when asked for, binary ones without the rest of the file.
///
/// Throws InputError, with the file, what was expected and what found, when the file is of another kind, has several
/// blocks, or its size is not that of its dimensions.
[[nodiscard]] CurvilinearNodes open_plot3d(const std::filesystem::path& file);

}  // namespace luff::grid
