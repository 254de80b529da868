// SPDX-License-Identifier: BSD-3-Clause
// Triangles, sets and fields of vectors from the files that VTK reads.
#pragma once

#include <filesystem>
#include <string>

#include "surface/marked_mesh.hpp"

namespace luff::surface {

/// Reads .stl, .vtp or .vtu; `kind` is the ending, in lower case. Arrays of single numbers of VTP and VTU
/// become sets (of points or cells whose number is not zero), arrays of three fields of vectors; those of points are
/// averaged over the corners. Nothing is printed. \throws InputError naming the file when it cannot be read or holds
/// other cells than triangles.
MarkedMesh read_vtk(const std::filesystem::path& file, const std::string& kind);

}  // namespace luff::surface
