// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/partial_faces.hpp"

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "parallel/for_each.hpp"

namespace luff::poisson {

std::vector<FaceIndex> gather_faces(MPI_Comm comm, std::span<const FaceIndex> own)
{
  static_assert(std::is_trivially_copyable_v<FaceIndex>);
  constexpr int bytes = sizeof(FaceIndex);
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  const int count = bytes * static_cast<int>(own.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 1; r < ranks; ++r)
    starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<FaceIndex> all((starts.back() + counts.back()) / bytes);
  MPI_Allgatherv(own.data(), count, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<FaceIndex> gather_partial_faces(MPI_Comm comm, std::span<const FaceIndex> own)
{
  std::vector<FaceIndex> partial;
  std::ranges::copy_if(own, std::back_inserter(partial), [](const FaceIndex& f) { return f.open > 0.0; });
  return gather_faces(comm, partial);
}

PartialFaces::PartialFaces(std::span<const FaceIndex> faces, const IndexBox& owned, const Index3& cells,
                           const std::array<bool, 3>& periodic, int outer)
    : owned_(owned), outer_(outer)
{
  for (const FaceIndex& face : faces)
    for (const int side : {0, 1})
      add(face, side, cells, periodic);
  std::ranges::sort(beside_, [&](const Beside& p, const Beside& q) {
    return std::tuple(p.cell[outer_], p) < std::tuple(q.cell[outer_], q);
  });
  beside_.erase(std::unique(beside_.begin(), beside_.end()), beside_.end());
}

/// The cell whose low (side 0) or high face this is, and its images beyond periodic sides, as far as they are near.
void PartialFaces::add(const FaceIndex& face, int side, const Index3& cells, const std::array<bool, 3>& periodic)
{
  Index3 cell = stepped(face.cell, face.axis, -side);
  IndexBox images{{0, 0, 0}, {1, 1, 1}};  // in periods
  for (int a = 0; a < 3; ++a)
    if (periodic[a]) {
      cell[a] = (cell[a] + cells[a]) % cells[a];
      images.lo[a] = cells[a] > 1 ? -1 : 0;
      images.hi[a] = cells[a] > 1 ? 2 : 1;
    }
  for_each_cell_in_order(images, [&](int i, int j, int k) {
    const Index3 image{cell[0] + i * cells[0], cell[1] + j * cells[1], cell[2] + k * cells[2]};
    if (owned_.grown(1).contains(image))
      beside_.push_back({image, face.axis, side, 1.0 - face.open});
  });
}

std::span<const PartialFaces::Beside> PartialFaces::on_plane(int plane) const
{
  const auto range = std::ranges::equal_range(beside_, plane, {}, [&](const Beside& b) { return b.cell[outer_]; });
  return {range.begin(), range.end()};
}

bool PartialFaces::has_cross_term(int axis, const Index3& cell) const
{
  IndexBox box = owned_;
  if (axis > 0) {
    --box.lo[axis];
    ++box.hi[axis];
  }
  return box.contains(cell);
}

}  // namespace luff::poisson
