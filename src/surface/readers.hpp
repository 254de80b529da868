// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes from files.
#pragma once

#include <filesystem>

#include "surface/mesh.hpp"

namespace luff::surface {

/// STL corners closer than this fraction of the mesh's size become one vertex (its coordinates are single precision).
inline constexpr double stl_merge_tolerance = 1e-6;

/// Read STL, OBJ, PLY or VTP, told apart by the name's ending, through VTK. STL's separate corners and OBJ's vertices
/// that were repeated for their texture are united; the result passed validate(). \throws InputError naming the file
/// when it is missing, unreadable, of another kind, not made of triangles, or its mesh is bad.
TriangleMesh read_mesh(const std::filesystem::path& file);

}  // namespace luff::surface
