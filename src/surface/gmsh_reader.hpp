// SPDX-License-Identifier: BSD-3-Clause
// Triangles and physical groups from Gmsh's files.
#pragma once

#include <filesystem>

#include "surface/marked_mesh.hpp"

namespace luff::surface {

/// Reads format 2.2 or 4.1, ASCII or binary [geuzaine_2009_gmsh]. Physical groups of points, curves and surfaces become
/// sets of vertices, edges and triangles under their name, or their number if they have none. Vertices are those of the
/// file, used or not. \throws InputError naming the file and line (or byte) when it is not understood, ends too early,
/// or holds other elements than points, lines and triangles of first order.
MarkedMesh read_gmsh(const std::filesystem::path& file);

}  // namespace luff::surface
