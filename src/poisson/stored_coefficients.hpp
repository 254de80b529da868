// SPDX-License-Identifier: BSD-3-Clause
// Coefficients of a level that are no product of 1-D tables.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "parallel/for_each.hpp"
#include "poisson/cell_map.hpp"
#include "poisson/row_exchange.hpp"

namespace luff::poisson {

/// Coefficients of the low faces of cells, in the places of the cells, and of the high sides of the domain, in those of
/// the halo cells beyond; 0 on closed faces.
class StoredCoefficients {
 public:
  StoredCoefficients(const Layout& layout, const std::array<Line, 3>& lines);

  /// The coefficient of a face, given by its axis and the cell above it.
  using Source = std::function<double(int axis, const Index3& cell)>;
  /// Takes all faces of the cells of `box`: low ones, and those on high sides of the domain.
  void load(const IndexBox& box, const Source& source);
  void load(std::span<const FaceIndex> faces, const Source& source);
  void clear();
  /// The low faces of cells beyond the edges of this rank's block.  Collective.
  void close(RowExchange& exchange);

  [[nodiscard]] const float* face(int axis) const { return face_[axis].data(); }
  [[nodiscard]] Values& values(int axis) { return face_[axis]; }
  [[nodiscard]] double face(int axis, const Index3& cell) const { return face_[axis][layout_.index(cell)]; }
  /// Of any face of an owned cell, or of a cell that share_cells() made known.  Sides as those of Box.
  [[nodiscard]] double coefficient(const Index3& cell, int side) const;
  /// Makes cells known on every rank.  Takes the same list everywhere.  Collective.
  void share_cells(const std::vector<Index3>& cells, MPI_Comm comm);
  /// Number of cells of this rank.
  [[nodiscard]] std::ptrdiff_t cells() const { return layout_.owned.volume(); }
  /// Sum of squares of the diagonal over the cells of this rank.
  [[nodiscard]] double diagonal_squares() const;

 private:
  [[nodiscard]] std::int64_t key(const Index3& c) const
  {
    return c[0] + static_cast<std::int64_t>(cells_[0]) * (c[1] + static_cast<std::int64_t>(cells_[1]) * c[2]);
  }

  Layout layout_;
  Index3 cells_;
  std::array<bool, 3> periodic_;
  std::array<Values, 3> face_;
  CellMap shared_;
  std::vector<std::array<float, 6>> shared_coefficients_;
};

}  // namespace luff::poisson
