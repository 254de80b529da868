// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/halo.hpp"

#include <cstring>

namespace luff {

namespace {

template <class T>
char* pack(const View<T>& field, const IndexBox& box, char* out)
{
  const std::size_t bytes = sizeof(T) * box.extent(0);
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j, out += bytes)
      std::memcpy(out, &field(box.lo[0], j, k), bytes);
  return out;
}

template <class T>
const char* unpack(const View<T>& field, const IndexBox& box, const char* in)
{
  const std::size_t bytes = sizeof(T) * box.extent(0);
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j, in += bytes)
      std::memcpy(&field(box.lo[0], j, k), in, bytes);
  return in;
}

}  // namespace

/// The plane of cells at one index along j or k, with its halos: what is stale in them, the exchange along the next
/// axis puts right.
IndexBox HaloExchange::layer(int axis, int index) const
{
  IndexBox box = owned_.grown(1);
  box.lo[axis] = index;
  box.hi[axis] = index + 1;
  return box;
}

template <class T>
void HaloExchange::wrap_rows(const View<T>& field) const
{
  const int n = cells_[0];
  for (int k = owned_.lo[2] - 1; k <= owned_.hi[2]; ++k)
    for (int j = owned_.lo[1] - 1; j <= owned_.hi[1]; ++j) {
      field(-1, j, k) = field(n - 1, j, k);
      field(n, j, k) = field(0, j, k);
    }
}

template <class T>
void HaloExchange::exchange_along(int axis, std::span<const View<T>> fields)
{
  if (ranks_->blocks(axis) == 1 && !ranks_->periodic(axis))
    return;
  const std::size_t bytes = fields.size() * sizeof(T) * layer(axis, 0).volume();
  send_.resize(2 * bytes);
  receive_.resize(2 * bytes);
  char* out = send_.data();
  for (const int index : {owned_.lo[axis], owned_.hi[axis] - 1})
    for (const View<T>& field : fields)
      out = pack(field, layer(axis, index), out);
  if (ranks_->blocks(axis) == 1) {  // periodic onto itself: what leaves below arrives above
    std::memcpy(receive_.data(), send_.data() + bytes, bytes);
    std::memcpy(receive_.data() + bytes, send_.data(), bytes);
  } else {
    MPI_Neighbor_alltoall(send_.data(), static_cast<int>(bytes), MPI_BYTE, receive_.data(), static_cast<int>(bytes),
                          MPI_BYTE, ranks_->line(axis));
  }
  const std::array<int, 2> neighbours = ranks_->neighbours(axis);
  const char* in = receive_.data();
  for (int side = 0; side < 2; ++side, in = receive_.data() + bytes) {
    if (neighbours[side] == MPI_PROC_NULL)
      continue;
    for (const View<T>& field : fields)
      in = unpack(field, layer(axis, side == 0 ? owned_.lo[axis] - 1 : owned_.hi[axis]), in);
  }
}

template <class T>
void HaloExchange::exchange(std::span<const View<T>> fields)
{
  if (ranks_->periodic(0))
    for (const View<T>& field : fields)
      wrap_rows(field);
  exchange_along(1, fields);
  exchange_along(2, fields);
}

template void HaloExchange::exchange(std::span<const View<double>>);
template void HaloExchange::exchange(std::span<const View<float>>);
template void HaloExchange::exchange(std::span<const View<int>>);

}  // namespace luff
