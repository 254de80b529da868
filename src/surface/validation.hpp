// SPDX-License-Identifier: BSD-3-Clause
// Is a mesh an oriented manifold with sound triangles?
#pragma once

#include <string_view>

#include "surface/mesh.hpp"

namespace luff::surface {

/// Check everything that flow and shell rely on; all tolerances are relative to the mesh.
/// \throws InputError that starts with `where` and gives the number of the triangle or vertex (from 0), its coordinates
/// and a remedy, for: no triangles; corner numbers out of range; coordinates that are not finite; triangles with equal
/// corners or no area; duplicate triangles or vertices; unused vertices; edges with more than two triangles; flipped
/// triangles and surfaces with one side only.
void validate(const TriangleMesh& mesh, std::string_view where);

/// The part of validate() that everything else needs: triangles, corner numbers in range, finite coordinates.
void validate_numbers(const TriangleMesh& mesh, std::string_view where);

/// Vertices closer than this fraction of the mesh's size are duplicates.
inline constexpr double duplicate_tolerance = 1e-9;

}  // namespace luff::surface
