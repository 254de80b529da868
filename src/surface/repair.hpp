// SPDX-License-Identifier: BSD-3-Clause
// Small faults of meshes from files, put right.
#pragma once

#include <string>

#include "surface/marked_mesh.hpp"

namespace luff::surface {

/// "3 vertices united with another at the same place, 1 triangle reversed"; "nothing" if there is nothing.
std::string text(const Repairs& repairs);

/// Vertices closer than `tolerance` times the mesh's size become one, the first of them. Returns how many were united.
/// The mesh must have passed validate_numbers(); sets follow.
int unite_vertices(MarkedMesh& marked, double tolerance);

/// Unites vertices at the same place (see duplicate_tolerance), drops unused ones and repeated triangles, and turns the
/// triangles of each connected piece the way that most of them face (the first one's, if they are even). Sets and
/// directions follow; counts go to the mesh's repairs. What is wrong besides is left for validate() to tell. The mesh
/// must have passed validate_numbers().
void repair(MarkedMesh& marked);

}  // namespace luff::surface
