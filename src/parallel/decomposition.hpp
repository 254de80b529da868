// SPDX-License-Identifier: BSD-3-Clause
// How the cells of one structured block are shared among MPI ranks.
#pragma once

#include <vector>

#include <mpi.h>

#include "parallel/index_box.hpp"

namespace luff {

/// The Cartesian communicator of a block split along j and k.  Rows along i are never split: they stay long, which is
/// what vector units want, and a pencil per rank scales far enough.
class Decomposition {
 public:
  /// Collective over `comm`.  Throws InputError when there are more ranks than rows to share.
  Decomposition(MPI_Comm comm, const Index3& cells, const std::array<bool, 3>& periodic);
  Decomposition(const Decomposition&) = delete;
  Decomposition& operator=(const Decomposition&) = delete;
  ~Decomposition();

  [[nodiscard]] MPI_Comm comm() const { return cart_; }
  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const Index3& cells() const { return cells_; }
  [[nodiscard]] IndexBox domain() const { return {{0, 0, 0}, cells_}; }
  [[nodiscard]] bool periodic(int axis) const { return periodic_[axis]; }

  /// Cells of this rank.
  [[nodiscard]] const IndexBox& owned() const { return owned_; }
  /// First cells of the blocks along an axis, and the number of cells as last entry.
  [[nodiscard]] const std::vector<int>& splits(int axis) const { return splits_[axis]; }
  /// Number of blocks along an axis, and the position of this rank's among them.
  [[nodiscard]] int blocks(int axis) const { return dims_[axis]; }
  [[nodiscard]] int coordinate(int axis) const { return coords_[axis]; }
  /// Ranks that hold the blocks below and above along an axis (MPI_PROC_NULL where there are none).
  [[nodiscard]] std::array<int, 2> neighbours(int axis) const { return neighbours_[axis]; }
  /// Communicator of the ranks in line along axis 1 or 2, a one-dimensional Cartesian topology.
  [[nodiscard]] MPI_Comm line(int axis) const { return lines_[axis]; }

  /// Whether this rank's block touches the low (side 0) or high (side 1) boundary of the domain; never on periodic
  /// axes.
  [[nodiscard]] bool at_boundary(int axis, int side) const
  {
    return !periodic_[axis] && (side == 0 ? owned_.lo[axis] == 0 : owned_.hi[axis] == cells_[axis]);
  }

  [[nodiscard]] double sum(double value) const;
  [[nodiscard]] double max(double value) const;

 private:
  MPI_Comm cart_ = MPI_COMM_NULL;
  std::array<MPI_Comm, 3> lines_{MPI_COMM_NULL, MPI_COMM_NULL, MPI_COMM_NULL};
  int rank_ = 0;
  int size_ = 1;
  Index3 cells_{};
  std::array<bool, 3> periodic_{};
  Index3 dims_{1, 1, 1};
  Index3 coords_{0, 0, 0};
  std::array<std::array<int, 2>, 3> neighbours_{};
  std::array<std::vector<int>, 3> splits_;
  IndexBox owned_;
};

}  // namespace luff
