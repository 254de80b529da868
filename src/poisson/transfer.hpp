// SPDX-License-Identifier: BSD-3-Clause
// Restriction and prolongation between two levels: R is the transpose of P.
#pragma once

#include <vector>

#include "poisson/level.hpp"

namespace luff::poisson {

/// P interpolates linearly from a coarse cell and its neighbours along each axis,
///
///   u_c = U_C + sum over axes a of w_a (U_{C + towards_a} - U_C),
///
/// and differs from that near blocked faces by a short list (Cuts::interpolation).
class Transfer {
 public:
  Transfer(Level& fine, Level& coarse, std::array<Merge, 3> merges);

  [[nodiscard]] const std::array<Merge, 3>& merges() const { return merges_; }
  void set_cuts(const Cuts& fine_cuts, const Cuts& coarse_cuts);

  /// coarse.f = P^T fine.r.  Collective; every rank gets the whole of a coarse level that is not shared out.
  void restrict_residual();
  /// Reads coarse.u for what follows, and adds P coarse.u to extra unknowns.  Collective.
  void begin_prolongation();
  /// fine.u += P coarse.u on plane k of the fine level, where the next half sweep reads it.
  void prolong_plane(int k);

 private:
  struct Weight {
    std::int32_t fine, coarse;
    float weight;
  };
  struct Scratch;
  /// Fine cells of a coarse index along j or k, and those beyond either side that interpolate from it too.
  struct Children {
    int first, count;
    std::array<float, 2> weight;  ///< w of the first and of the last
    std::array<float, 2> beyond;  ///< w of the cells before the first and after the last; 0 if not from here
  };
  /// The six rows of residuals of one parity that a coarse row gathers: two of its own, and one beyond each side.
  struct Rows {
    std::array<const float*, 6> row{};
    std::array<float, 6> weight{};
    int own = 0;
    int beyond = 2;
  };
  void make_tables();
  [[nodiscard]] std::vector<Children> children_along(int axis) const;
  void prolong_extras();
  void restrict_row(int J, int K, Scratch& s) const;
  void gather_rows(int J, int K, int colour, std::array<Rows, 2>& rows) const;
  void add_rows(const Rows& rows, int parity, bool first, Scratch& s) const;
  /// Coarse cells next to each other in a row that all hold two fine cells, or all one.
  struct Run {
    int fine, coarse;  ///< the first of either
    int count;         ///< of coarse cells
    bool pairs;
  };
  void combine_pairs(const Run& run, Scratch& s) const;
  void combine_singles(const Run& run, Scratch& s) const;
  void combine(Scratch& s) const;
  void store_coarse_row(int J, int K, Scratch& s) const;
  void add_coarse_row(int j, int k, int colour);
  /// Where cell i lies in split rows and in the tables made like them.
  [[nodiscard]] std::ptrdiff_t split_place(int i) const { return (i & 1) * split_ + (i >> 1); }
  [[nodiscard]] std::ptrdiff_t natural_row(int J, int K) const
  {
    return 16 + (J - home_.lo[1] + 1) * natural_stride_ +
           (K - home_.lo[2] + 1) * natural_stride_ * (home_.extent(1) + 2);
  }

  Level& fine_;
  Level& coarse_;
  std::array<Merge, 3> merges_;
  IndexBox home_;                                  // coarse cells whose children this rank owns
  std::vector<Run> runs_;                          // of a row
  std::array<std::vector<Children>, 3> children_;  // along j and k, of the coarse cells of home
  Values weight_;                                  // of the cells of a row, split by parity of i
  std::ptrdiff_t split_ = 0;                       // from even to odd cells in split rows
  Values natural_;                                 // coarse.u, i fastest, with one layer around home
  std::ptrdiff_t natural_stride_ = 0;
  std::vector<Weight> restriction_;   // by coarse owner
  std::vector<Weight> prolongation_;  // by plane of the fine cell, extras last
  std::vector<int> first_of_plane_;
};

}  // namespace luff::poisson
