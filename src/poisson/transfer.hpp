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
  /// fine.u += P coarse.u on plane k of the fine level, where the next half sweep reads it; and on extra unknowns.
  void prolong_plane(int k);
  void prolong_extras();

 private:
  struct Weight {
    std::int32_t fine, coarse;
    float weight;
  };
  struct Scratch;
  void make_tables();
  [[nodiscard]] bool reads(const Cuts& fine_cuts, Unknown x) const;
  void restrict_row(int J, int K, Scratch& s) const;
  void gather_rows(int J, int K, Scratch& s) const;
  void add_row(int j, int k, float weight, bool own, Scratch& s) const;
  void combine_along_row(int J, int K, Scratch& s) const;
  void interpolate_rows(int j, int k, Scratch& s) const;
  void add_interpolated(int j, int k, const Scratch& s);

  Level& fine_;
  Level& coarse_;
  std::array<Merge, 3> merges_;
  IndexBox home_;                                   // coarse cells whose children this rank owns
  bool regular_ = false;                            // coarse cell I holds the cells 2 I and 2 I + 1 of a row
  std::array<std::vector<float>, 2> weight_;        // per parity of i, with one more on each side
  std::array<std::vector<int>, 2> parent_, other_;  // per parity of i
  std::vector<float> weight_left_, weight_right_;   // by i: w towards -1, towards 1
  std::vector<int> first_, last_;                   // by I
  std::vector<Weight> restriction_;                 // by coarse owner
  std::vector<Weight> prolongation_;                // by plane of the fine cell, extras last
  std::vector<int> first_of_plane_;
};

}  // namespace luff::poisson
