// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are moved about on their surface without tearing.
#pragma once

#include <vector>

#include "surface/pattern.hpp"
#include "surface/random.hpp"

namespace luff::surface {

/// Flip edges until the two angles opposite to each inner edge sum to at most pi [lawson_1977_software].
void flip_to_delaunay(TriangleMesh& mesh, const ParametricSurface& surface);

/// Let nothing be left of a regular mesh: send the inner vertices on a random walk, spread them evenly by Lloyd's
/// iteration, and join them by Delaunay's rule. Where triangles stay poor, repeat.
void spread(TriangleMesh& mesh, const ParametricSurface& surface, const std::vector<bool>& inner, Random& random);

}  // namespace luff::surface
