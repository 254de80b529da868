// SPDX-License-Identifier: BSD-3-Clause
// One instant of a flow or a surface, as plain numbers.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "core/vec3.hpp"
#include "parallel/index_box.hpp"

namespace luff::output {

/// Numbers of one field: `components` of a cell (or point) beside one another, cells in the order of the snapshot.
struct NamedField {
  std::string name;
  int components = 1;
  std::variant<std::vector<float>, std::vector<double>> values;
};

/// Nodes of a curvilinear grid.
struct CurvilinearPiece {
  Index3 cells{};            ///< of the whole grid
  std::vector<Vec3> points;  ///< corners of the cells of this rank's piece [L], i fastest
};

/// Face coordinates of a whole grid along x, y, z [L]; cells + 1 of them.
using RectilinearNodes = std::array<std::vector<double>, 3>;

/// The cells that this rank owns.
struct FlowSnapshot {
  std::variant<RectilinearNodes, CurvilinearPiece> nodes;
  IndexBox piece;                  ///< of the cells in `fields`
  std::vector<NamedField> fields;  ///< by cell of the piece, i fastest; the same names on every rank
};

/// A surface of triangles and quadrilaterals as it is now.
struct SurfaceSnapshot {
  std::vector<Vec3> points;  ///< current position [L]
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 4>> quadrilaterals{};
  std::vector<NamedField> point_fields;
  std::vector<NamedField> face_fields;  ///< by triangle, then by quadrilateral
};

}  // namespace luff::output
