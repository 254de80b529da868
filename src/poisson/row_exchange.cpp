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

void RowExchange::close_row(float* values, int j, int k) const
{
  const int n = cells_[0];
  values[layout_.index(-1, j, k)] = values[layout_.index(n - 1, j, k)];
  values[layout_.index(n, j, k)] = values[layout_.index(0, j, k)];
}

void RowExchange::close_plane(float* values, int k, Colours colours) const
{
  if (wraps_[0])
    for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j)
      close_row(values, j, k);
  if (wraps_[1]) {
    copy_row(values, cells_[1] - 1, k, -1, k, colours);
    copy_row(values, 0, k, cells_[1], k, colours);
    if (wraps_[0]) {
      close_row(values, -1, k);
      close_row(values, cells_[1], k);
    }
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

/// Both colours of a row with the cells beyond its ends.
float* RowExchange::pack_whole(const float* values, const IndexBox& rows, float* out) const
{
  const int m = (cells_[0] + 1) / 2 + 2;
  for (int k = rows.lo[2]; k < rows.hi[2]; ++k)
    for (int j = rows.lo[1]; j < rows.hi[1]; ++j)
      for (int c = 0; c < 2; ++c)
        out = std::copy_n(values + layout_.start(j, k, c) - 1, m, out);
  return out;
}

void RowExchange::unpack_whole(float* values, const IndexBox& rows, bool flips, const float* in) const
{
  const int m = (cells_[0] + 1) / 2 + 2;
  for (int k = rows.lo[2]; k < rows.hi[2]; ++k)
    for (int j = rows.lo[1]; j < rows.hi[1]; ++j)
      for (int c = 0; c < 2; ++c, in += m)
        std::copy_n(in, m, values + layout_.start(j, k, flips ? 1 - c : c) - 1);
}

/// The layers at both ends along j or k, with the halo along j when it goes along k.
void RowExchange::exchange_rows_along(int axis, float* values)
{
  const bool split = neighbourhood_ != nullptr && neighbourhood_->split[axis];
  if (!split && !wraps_[axis])
    return;
  IndexBox rows = axis == 2 ? layout_.owned.grown(1) : layout_.owned;
  const auto layer = [&](int index) {
    rows.lo[axis] = index;
    rows.hi[axis] = index + 1;
    return rows;
  };
  const std::size_t size = static_cast<std::size_t>(layer(0).extent(3 - axis)) * 2 * ((cells_[0] + 1) / 2 + 2);
  const std::array<int, 2> ends{layout_.owned.lo[axis], layout_.owned.hi[axis] - 1};
  std::array<std::vector<float>, 2> sent{std::vector<float>(size), std::vector<float>(size)};
  std::array<std::vector<float>, 2> received = sent;
  for (int side = 0; side < 2; ++side)
    pack_whole(values, layer(ends[side]), sent[side].data());
  std::array<int, 2> from{MPI_PROC_NULL, MPI_PROC_NULL};
  if (!split) {
    received = {sent[1], sent[0]};
  } else {
    from = neighbourhood_->ranks[axis];
    std::array<MPI_Request, 4> requests;
    for (int side = 0; side < 2; ++side) {
      MPI_Irecv(received[side].data(), static_cast<int>(size), MPI_FLOAT, from[side], 1 - side, neighbourhood_->comm,
                &requests[2 * side]);
      MPI_Isend(sent[side].data(), static_cast<int>(size), MPI_FLOAT, from[side], side, neighbourhood_->comm,
                &requests[2 * side + 1]);
    }
    MPI_Waitall(4, requests.data(), MPI_STATUSES_IGNORE);
  }
  for (int side = 0; side < 2; ++side) {
    if (split && from[side] == MPI_PROC_NULL)
      continue;
    const int index = side == 0 ? layout_.owned.lo[axis] - 1 : layout_.owned.hi[axis];
    const bool across_seam = index < 0 || index == cells_[axis];
    unpack_whole(values, layer(index), across_seam && seam_flips_[axis], received[side].data());
  }
}

void RowExchange::exchange_with_edges(float* values)
{
  if (wraps_[0])
    for (int k = layout_.owned.lo[2]; k < layout_.owned.hi[2]; ++k)
      for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j)
        close_row(values, j, k);
  exchange_rows_along(1, values);
  exchange_rows_along(2, values);
}

}  // namespace luff::poisson
