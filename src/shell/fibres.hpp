// SPDX-License-Identifier: BSD-3-Clause
// Direction of the material in every triangle of the reference.
#pragma once

#include <string_view>
#include <vector>

#include "shell/material/response.hpp"
#include "surface/mesh.hpp"

namespace luff::shell {

/// A direction at each triangle, of any length, projected on the triangle's plane and turned into its frame
/// e1 = (X1 - X0)/|X1 - X0|, e2 = n x e1. Empty: along the first side.
///
/// \throws InputError naming `shell` where there isn't one direction per triangle, or one is zero or normal to its
/// triangle (within a twentieth of a degree).
std::vector<Fibre> fibres_in_triangles(const surface::TriangleMesh& mesh, const std::vector<Vec3>& directions,
                                       std::string_view shell);

/// The same direction everywhere.
std::vector<Vec3> uniform_directions(const surface::TriangleMesh& mesh, const Vec3& direction);

/// Around an axis, axis x (X - through) at each centroid: the circumference of a leaflet.
/// \throws InputError naming `shell` where a centroid lies on the axis.
std::vector<Vec3> circumferential_directions(const surface::TriangleMesh& mesh, const Vec3& axis, const Vec3& through,
                                             std::string_view shell);

}  // namespace luff::shell
