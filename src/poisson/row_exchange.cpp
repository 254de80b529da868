// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/row_exchange.hpp"

#include <algorithm>

namespace luff::poisson {

RowExchange::RowExchange(const Layout& layout, const std::array<Line, 3>& lines, const Neighbourhood* neighbourhood)
    : layout_(layout), neighbourhood_(neighbourhood)
{
  for (int a = 0; a < 3; ++a) {
    const bool split = neighbourhood != nullptr && neighbourhood->split[a];
    cells_[a] = lines[a].n;
    wraps_[a] = lines[a].periodic && lines[a].n > 1 && !split;
    seam_flips_[a] = lines[a].periodic && lines[a].n % 2 == 1;
    any_rank_ |= split;
  }
}

/// Cell (i, j, k) keeps its place i in the row, in the half that its colour has at the receiving row.
void RowExchange::copy_row(float* values, int j_from, int k_from, int j_to, int k_to, Colours colours) const
{
  const int flip = (j_from + k_from + j_to + k_to) & 1;
  for (int c = 0; c < 2; ++c)
    if (includes(colours, c))
      std::copy_n(values + layout_.start(j_from, k_from, c), (cells_[0] + 1) / 2,
                  values + layout_.start(j_to, k_to, c ^ flip));
}

void RowExchange::close_plane(float* values, int k, Colours colours) const
{
  if (wraps_[0]) {
    const int n = cells_[0];
    for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j) {
      values[layout_.index(-1, j, k)] = values[layout_.index(n - 1, j, k)];
      values[layout_.index(n, j, k)] = values[layout_.index(0, j, k)];
    }
  }
  if (wraps_[1]) {
    copy_row(values, cells_[1] - 1, k, -1, k, colours);
    copy_row(values, 0, k, cells_[1], k, colours);
  }
}

float* RowExchange::pack(const float* values, int axis, int index, Colours colours, float* out) const
{
  IndexBox rows = layout_.owned;
  rows.lo[axis] = index;
  rows.hi[axis] = index + 1;
  const int m = (cells_[0] + 1) / 2;
  for (int k = rows.lo[2]; k < rows.hi[2]; ++k)
    for (int j = rows.lo[1]; j < rows.hi[1]; ++j)
      for (int c = 0; c < 2; ++c)
        if (includes(colours, c))
          out = std::copy_n(values + layout_.start(j, k, c), m, out);
  return out;
}

void RowExchange::unpack(float* values, int axis, int index, bool flips, Colours colours, const float* in) const
{
  IndexBox rows = layout_.owned;
  rows.lo[axis] = index;
  rows.hi[axis] = index + 1;
  const int m = (cells_[0] + 1) / 2;
  for (int k = rows.lo[2]; k < rows.hi[2]; ++k)
    for (int j = rows.lo[1]; j < rows.hi[1]; ++j)
      for (int c = 0; c < 2; ++c)
        if (includes(colours, c)) {
          std::copy_n(in, m, values + layout_.start(j, k, flips ? 1 - c : c));
          in += m;
        }
}

void RowExchange::exchange(float* values, Colours colours)
{
  if (wraps_[2])
    for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j) {
      copy_row(values, j, cells_[2] - 1, j, -1, colours);
      copy_row(values, j, 0, j, cells_[2], colours);
    }
  if (!any_rank_)
    return;
  std::array<MPI_Request, 8> requests;
  int pending = 0;
  const auto message = [](int axis, int side) { return 2 * (axis - 1) + side; };
  for (int axis = 1; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int rank = neighbourhood_->ranks[axis][side];
      if (!neighbourhood_->split[axis] || rank == MPI_PROC_NULL)
        continue;
      const int n = message(axis, side);
      const int other_axis = 3 - axis;
      const std::size_t size = static_cast<std::size_t>(layout_.owned.extent(other_axis)) * ((cells_[0] + 1) / 2) *
                               (colours == Colours::Both ? 2 : 1);
      send_[n].resize(std::max(send_[n].size(), size));
      receive_[n].resize(std::max(receive_[n].size(), size));
      pack(values, axis, side == 0 ? layout_.owned.lo[axis] : layout_.owned.hi[axis] - 1, colours, send_[n].data());
      // The tag names the direction of travel; what arrives from below travels up.
      MPI_Irecv(receive_[n].data(), static_cast<int>(size), MPI_FLOAT, rank, message(axis, 1 - side),
                neighbourhood_->comm, &requests[pending++]);
      MPI_Isend(send_[n].data(), static_cast<int>(size), MPI_FLOAT, rank, message(axis, side), neighbourhood_->comm,
                &requests[pending++]);
    }
  MPI_Waitall(pending, requests.data(), MPI_STATUSES_IGNORE);
  for (int axis = 1; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!neighbourhood_->split[axis] || neighbourhood_->ranks[axis][side] == MPI_PROC_NULL)
        continue;
      const int index = side == 0 ? layout_.owned.lo[axis] - 1 : layout_.owned.hi[axis];
      const bool across_seam = index < 0 || index == cells_[axis];
      unpack(values, axis, index, across_seam && seam_flips_[axis], colours, receive_[message(axis, side)].data());
    }
}

}  // namespace luff::poisson
