// SPDX-License-Identifier: BSD-3-Clause
// Choosing vertices of a surface by where they are.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "surface/mesh.hpp"

namespace luff::surface {

/// The segment from p to q.
struct EdgeWhere {
  Vec3 p, q;
};
/// The axis-aligned box between two corners.
struct BoxWhere {
  Vec3 low, high;
};
/// The plane through a point.
struct PlaneWhere {
  Vec3 point, normal;
};
/// The vertex nearest to a point.
struct PointWhere {
  Vec3 point;
};

using Where = std::variant<EdgeWhere, BoxWhere, PlaneWhere, PointWhere>;

/// A vertex within this fraction of the mesh's size of a segment, box or plane lies on it.
inline constexpr double selection_tolerance = 1e-6;

/// Numbers of the vertices there, ascending; at least one.
/// \throws InputError that starts with `what` and gives the nearest vertex when there is none, or for an edge without
/// length, a box inside out, a plane without normal.
std::vector<int> select_vertices(const TriangleMesh& mesh, const Where& where, std::string_view what);

}  // namespace luff::surface
