// SPDX-License-Identifier: BSD-3-Clause
// One axis of a multigrid level: widths, distances, blocks of ranks, and how cells merge on the next coarser level.
#pragma once

#include <array>
#include <vector>

#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Lengths are in units of the finest grid's smallest width, so that single precision never sees the user's units.
struct Line {
  int n = 0;
  bool periodic = false;
  std::array<SideCondition, 2> sides{SideCondition::Neumann, SideCondition::Neumann};
  std::vector<double> h;          ///< widths, n
  std::vector<double> inverse_d;  ///< per face 0 ... n: 1 / distance between the centres beside it, or between centre
                                  ///< and side where p = 0 holds; 0 where no gradient acts
  std::vector<double> measure;    ///< finest cells in each cell, n
  std::vector<int> splits;        ///< first cells of the blocks of ranks, and n

  /// Index of the neighbour of cell i on a side; -1 beyond the domain.
  [[nodiscard]] int neighbour(int i, int side) const
  {
    const int m = side == 0 ? i - 1 : i + 1;
    if (m >= 0 && m < n)
      return m;
    return periodic ? (m + n) % n : -1;
  }
  /// Whether red-black colours clash across the periodic seam.
  [[nodiscard]] bool odd_seam() const { return periodic && n > 1 && n % 2 == 1; }
};

[[nodiscard]] Line make_line(std::vector<double> h, bool periodic, const std::array<SideCondition, 2>& sides,
                             std::vector<int> splits);

/// How the cells of one axis merge by ones and twos, and the linear interpolation back:
///
///   u_i = U_p + w_i (U_{p + towards_i} - U_p),   p = parent_i,   w_i = |x_i - X_p| / |X_{p + towards_i} - X_p|.
struct Merge {
  std::vector<int> parent;     ///< n
  std::vector<int> first;      ///< N + 1: first child of every coarse cell, and n
  std::vector<int> towards;    ///< n: -1, 1, or 0 for a cell that stays alone
  std::vector<double> weight;  ///< n
  std::vector<double> scale;   ///< N + 1: fine over coarse distance across a coarse face
};

/// Pairs of neighbouring cells merge when together they are no wider than `target` and no block of ranks ends between.
[[nodiscard]] std::vector<int> merge_pairs(const Line& line, double target, bool keep_blocks);
/// The coarser axis that `first` (from merge_pairs) gives, and the interpolation from it.
[[nodiscard]] Line coarse_line(const Line& line, const std::vector<int>& first);
[[nodiscard]] Merge make_merge(const Line& fine, const Line& coarse, const std::vector<int>& first);

}  // namespace luff::poisson
