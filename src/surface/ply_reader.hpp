// SPDX-License-Identifier: BSD-3-Clause
// Triangles from PLY files.
#pragma once

#include <filesystem>

#include "surface/mesh.hpp"

namespace luff::surface {

/// Reads x, y, z of the element `vertex` and the corners of the element `face` of a PLY file, as text or as bytes of
/// either order; all else is skipped. VTK's reader crashes on damaged files. \throws InputError naming the file when it
/// is not understood, ends too early, or holds faces that are not triangles.
TriangleMesh read_ply(const std::filesystem::path& file);

}  // namespace luff::surface
