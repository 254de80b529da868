// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/decomposition.hpp"

#include <limits>

#include "core/error.hpp"

namespace luff {

namespace {

/// The factorisation of `ranks` into blocks along j and k with the smallest surface between blocks.
Index3 choose_blocks(int ranks, const Index3& cells)
{
  Index3 best{0, 0, 0};
  double smallest = std::numeric_limits<double>::max();
  for (int pk = 1; pk <= ranks; ++pk) {
    const int pj = ranks / pk;
    if (pj * pk != ranks || pj > cells[1] || pk > cells[2])
      continue;
    const double surface = double(pj - 1) * cells[2] + double(pk - 1) * cells[1];
    if (surface < smallest) {
      smallest = surface;
      best = {1, pj, pk};
    }
  }
  if (best[0] == 0)
    fail_input("{} ranks cannot share {} x {} rows of cells: start fewer ranks or refine the grid along y or z", ranks,
               cells[1], cells[2]);
  return best;
}

std::vector<int> even_splits(int cells, int blocks)
{
  std::vector<int> splits(blocks + 1);
  for (int b = 0; b <= blocks; ++b)
    splits[b] = static_cast<int>(static_cast<long>(cells) * b / blocks);
  return splits;
}

}  // namespace

Decomposition::Decomposition(MPI_Comm comm, const Index3& cells, const std::array<bool, 3>& periodic)
    : cells_(cells), periodic_(periodic)
{
  MPI_Comm_size(comm, &size_);
  dims_ = choose_blocks(size_, cells);
  const std::array<int, 3> wraps{periodic[0], periodic[1], periodic[2]};
  MPI_Cart_create(comm, 3, dims_.data(), wraps.data(), /*reorder=*/1, &cart_);
  MPI_Comm_rank(cart_, &rank_);
  MPI_Cart_coords(cart_, rank_, 3, coords_.data());
  for (int axis = 0; axis < 3; ++axis) {
    MPI_Cart_shift(cart_, axis, 1, &neighbours_[axis][0], &neighbours_[axis][1]);
    const std::array<int, 3> keep{axis == 0, axis == 1, axis == 2};
    MPI_Cart_sub(cart_, keep.data(), &lines_[axis]);
    splits_[axis] = even_splits(cells[axis], dims_[axis]);
    owned_.lo[axis] = splits_[axis][coords_[axis]];
    owned_.hi[axis] = splits_[axis][coords_[axis] + 1];
  }
}

Decomposition::~Decomposition()
{
  for (MPI_Comm& line : lines_)
    if (line != MPI_COMM_NULL)
      MPI_Comm_free(&line);
  if (cart_ != MPI_COMM_NULL)
    MPI_Comm_free(&cart_);
}

double Decomposition::sum(double value) const
{
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, cart_);
  return value;
}

double Decomposition::max(double value) const
{
  // MPI_MAX may swallow a NaN; its presence travels beside the value.
  std::array<double, 2> both{value == value ? value : 0.0, value == value ? 0.0 : 1.0};
  MPI_Allreduce(MPI_IN_PLACE, both.data(), 2, MPI_DOUBLE, MPI_MAX, cart_);
  return both[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[0];
}

}  // namespace luff
