// SPDX-License-Identifier: BSD-3-Clause
// Choosing vertices of a surface by where they are.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "surface/marked_mesh.hpp"

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

/// The members of a named set.
struct SetWhere {
  std::string name;
};
/// Everything.
struct AllWhere {};

using Where = std::variant<EdgeWhere, BoxWhere, PlaneWhere, PointWhere, SetWhere, AllWhere>;

/// A vertex within this fraction of the mesh's size of a segment, box or plane lies on it.
inline constexpr double selection_tolerance = 1e-6;

/// Numbers of the vertices there, ascending; at least one. Of a set: its vertices, and those of its edges and
/// triangles. \throws InputError that starts with `what` and gives the nearest vertex when there is none, or for an
/// edge without length, a box inside out, a plane without normal; for an unknown set, with the nearest name, and an
/// empty one.
std::vector<int> select_vertices(const TriangleMesh& mesh, const Where& where, std::string_view what,
                                 const Sets& sets = {});

/// Numbers of the triangles there, ascending; at least one: those of a set that has some, else those with all three
/// corners among the vertices there. \throws InputError as select_vertices(), and when there is none.
std::vector<int> select_triangles(const TriangleMesh& mesh, const Where& where, std::string_view what,
                                  const Sets& sets = {});

}  // namespace luff::surface
