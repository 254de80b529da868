// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose parts have names, with directions on it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::surface {

/// Named vertices, edges and triangles of a mesh, by number and ascending. A name may stand for some of each.
struct Sets {
  std::map<std::string, std::vector<int>> vertices = {};
  std::map<std::string, std::vector<EdgeKey>> edges = {};
  std::map<std::string, std::vector<int>> triangles = {};
};

/// Every name once.
std::vector<std::string> names(const Sets& sets);

/// Sorts the numbers and drops repetitions.
void tidy(Sets& sets);

/// What was put right in a mesh from a file, by how often.
struct Repairs {
  int united_vertices = 0;     ///< that were at the place of another one
  int dropped_vertices = 0;    ///< that belong to no triangle
  int dropped_triangles = 0;   ///< that have the corners of another one
  int reversed_triangles = 0;  ///< that faced against most of those they are connected with

  bool any() const { return united_vertices + dropped_vertices + dropped_triangles + reversed_triangles > 0; }
};

/// What a mesh file or a generator tells besides the triangles.
struct Marks {
  Sets sets = {};
  /// Fields of vectors, such as fibres: one per triangle, of any length.
  std::map<std::string, std::vector<Vec3>> directions = {};
  Repairs repairs = {};
};

struct MarkedMesh {
  TriangleMesh mesh = {};
  Marks marks = {};
};

/// The field of vectors of this name. \throws InputError that starts with `what` and suggests the nearest name.
const std::vector<Vec3>& direction_field(const Marks& marks, const std::string& name, std::string_view what);

}  // namespace luff::surface
