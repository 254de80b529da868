// SPDX-License-Identifier: BSD-3-Clause
// Vectors that a mesh file keeps for its triangles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/vec3.hpp"

namespace luff::surface {

/// The cell array `name`, of three components, of a .vtp or .vtu file; its cells in the file's order, as read_mesh()
/// keeps them. \throws InputError naming the file when it has no such array, and the arrays it has.
std::vector<Vec3> read_triangle_vectors(const std::filesystem::path& file, const std::string& name);

}  // namespace luff::surface
