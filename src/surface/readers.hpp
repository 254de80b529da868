// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes from files.
#pragma once

#include <filesystem>

#include "surface/marked_mesh.hpp"

namespace luff::surface {

/// STL corners closer than this fraction of the mesh's size become one vertex (its coordinates are single precision).
inline constexpr double stl_merge_tolerance = 1e-6;

inline constexpr auto mesh_file_endings = ".stl, .obj, .ply, .vtp, .vtu and .msh";

enum class Repair { Yes, No };

/// Read STL, OBJ, PLY, VTP, VTU or Gmsh, told apart by the name's ending, with the sets and fields of vectors that the
/// last three may hold (see vtk_reader.hpp, gmsh_reader.hpp), and repair it unless told not to; the result passed
/// validate(). \throws InputError naming the file when it is missing, unreadable, of another kind, not made of
/// triangles, or its mesh is bad.
MarkedMesh read_mesh(const std::filesystem::path& file, Repair repairing = Repair::Yes);

}  // namespace luff::surface
