// SPDX-License-Identifier: BSD-3-Clause
// Faces that are open in part, for operators whose cells couple the differences across their faces.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "parallel/index_box.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// The faces of all ranks, sorted, each once.  Collective.
[[nodiscard]] std::vector<FaceIndex> gather_faces(MPI_Comm comm, std::span<const FaceIndex> own);

/// Those of all ranks that are neither shut nor left out.  Collective.
[[nodiscard]] std::vector<FaceIndex> gather_partial_faces(MPI_Comm comm, std::span<const FaceIndex> own);

/// The faces that are open in part as the cells beside them see them, those in the halo of a block too.
class PartialFaces {
 public:
  /// One face of a cell.
  struct Beside {
    Index3 cell{};
    int axis = 0;
    int side = 0;         ///< of the cell: 0 low, 1 high
    double closed = 0.0;  ///< part of the face
    friend auto operator<=>(const Beside&, const Beside&) = default;
  };

  PartialFaces() = default;
  /// Takes the faces of all ranks.  `outer`: the axis that planes are normal to.
  PartialFaces(std::span<const FaceIndex> faces, const IndexBox& owned, const Index3& cells,
               const std::array<bool, 3>& periodic, int outer);

  /// Of the cells of a plane of the block or its halo.
  [[nodiscard]] std::span<const Beside> on_plane(int plane) const;
  /// Whether the block computes the cross term of direction `axis` in a cell: in its own, and in those of the halo
  /// along that direction, but not beyond the ends of rows.
  [[nodiscard]] bool has_cross_term(int axis, const Index3& cell) const;
  [[nodiscard]] bool owns(const Index3& cell) const { return owned_.contains(cell); }

 private:
  void add(const FaceIndex& face, int side, const Index3& cells, const std::array<bool, 3>& periodic);

  IndexBox owned_{};
  int outer_ = 2;
  std::vector<Beside> beside_;  ///< by plane, then cell
};

}  // namespace luff::poisson
