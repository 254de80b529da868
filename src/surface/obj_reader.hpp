// SPDX-License-Identifier: BSD-3-Clause
// Triangles and groups from Wavefront's OBJ files.
#pragma once

#include <filesystem>

#include "surface/marked_mesh.hpp"

namespace luff::surface {

/// Reads vertices, faces and groups (`v`, `f`, `g`); groups become sets of triangles. Texture, normals, materials,
/// lines and points are left out. \throws InputError naming file and line where a number is missing or a face has not
/// three corners.
MarkedMesh read_obj(const std::filesystem::path& file);

}  // namespace luff::surface
