// SPDX-License-Identifier: BSD-3-Clause
// Points of a curve from a text file.
#pragma once

#include <filesystem>
#include <vector>

#include "core/vec3.hpp"

namespace luff::grid {

/// Reads "x, y, z" lines [L].  Lines that start with '#' and one header line are skipped; the separator is a comma, a
/// semicolon or blanks.  Throws InputError with file, line and what is wrong with it, or when there are less than two.
[[nodiscard]] std::vector<Vec3> read_points(const std::filesystem::path& file);

}  // namespace luff::grid
