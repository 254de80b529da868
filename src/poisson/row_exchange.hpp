// SPDX-License-Identifier: BSD-3-Clause
// Exchange of one layer of colour-split rows with the neighbouring blocks and across periodic seams.
#pragma once

#include <array>
#include <vector>

#include <mpi.h>

#include "poisson/layout.hpp"
#include "poisson/line.hpp"

namespace luff::poisson {

/// Which cells of a red-black colouring.
enum class Colours { Red, Black, Both };
[[nodiscard]] constexpr bool includes(Colours set, int colour)
{
  return set == Colours::Both || colour == (set == Colours::Red ? 0 : 1);
}

/// Ranks beside this one along the two split axes (indices 1 and 2 of a level), or MPI_PROC_NULL.
struct Neighbourhood {
  MPI_Comm comm = MPI_COMM_NULL;
  std::array<std::array<int, 2>, 3> ranks{};
  std::array<bool, 3> split{};  ///< several blocks in line along an axis
};

/// Fills the halos of one level: of faces only where edges and corners of the halo are not read.
class RowExchange {
 public:
  RowExchange(const Layout& layout, const std::array<Line, 3>& lines, const Neighbourhood* neighbourhood);

  /// Nothing to do between planes of one rank: stages of work may overlap from plane to plane.
  [[nodiscard]] bool within_planes() const { return !any_rank_ && !wraps_[2]; }
  /// Only planes come from beyond, no rows inside them.
  [[nodiscard]] bool of_planes() const { return neighbourhood_ == nullptr || !neighbourhood_->split[1]; }
  /// Periodic seams inside plane k: along rows, and along j where one rank holds the whole axis, edges included.
  void close_plane(float* values, int k, Colours colours) const;
  /// The seams across planes and what other ranks hold.  Collective.
  void exchange(float* values, Colours colours);
  /// All seams and what other ranks hold, of both colours, edges of the halo and cells beyond the ends of its rows
  /// included.  Collective.
  void exchange_with_edges(float* values);

 private:
  void close_row(float* values, int j, int k) const;
  void exchange_rows_along(int axis, float* values);
  float* pack_whole(const float* values, const IndexBox& rows, float* out) const;
  void unpack_whole(float* values, const IndexBox& rows, bool flips, const float* in) const;
  void copy_row(float* values, int j_from, int k_from, int j_to, int k_to, Colours colours) const;
  float* pack(const float* values, int axis, int index, Colours colours, float* out) const;
  void unpack(float* values, int axis, int index, bool flips, Colours colours, const float* in) const;

  Layout layout_;
  Index3 cells_{};
  std::array<bool, 3> wraps_{};  ///< periodic over more than one cell, and whole on this rank
  std::array<bool, 3> seam_flips_{};
  const Neighbourhood* neighbourhood_;
  bool any_rank_ = false;
  std::array<std::vector<float>, 4> send_;
  std::array<std::vector<float>, 4> receive_;
};

}  // namespace luff::poisson
