// SPDX-License-Identifier: BSD-3-Clause
// Cross terms of the pressure operator on curvilinear grids, in single precision and the layout of a level.
#pragma once

#include "poisson/level.hpp"
#include "poisson/partial_faces.hpp"

namespace luff::poisson {

/// Adds to the 7-point operator of a level of stored coefficients what CurvilinearOperator has beyond it,
///
///   sum over faces outwards of -(w_a(L) + w_a(R))/2,   w_a = sum_{b != a} g_ab <d_b>.
class CrossTerms {
 public:
  explicit CrossTerms(Level& level);

  /// g_ab of the cells of `box`, or of some, in the order of cross_pairs; then close() them.
  using Source = std::function<double(int pair, const Index3& cell)>;
  void load(const IndexBox& box, const Source& source);
  void load(std::span<const Index3> cells, const Source& source);
  /// Those of cells beyond the edges of this rank's block.  Collective.
  void close();

  /// Faces of all ranks that are open in part.
  void set_partial_faces(std::span<const FaceIndex> faces);

  /// Keeps w on the latest planes only, which then stay in cache: for one thread that applies plane k right after it
  /// prepared plane k + 1; or on all planes.
  void keep_all_planes(bool all) { slots_ = all ? 0 : ring; }
  /// w on plane k, from values with halo, edges included; across the edges of the block too.
  void prepare_plane(int k, const float* values);
  /// q += cross terms on plane k, from w on planes k - 1 ... k + 1; returns the sum of p times what was added.
  double apply_plane(int k, const float* p, float* q) const { return add_plane<1>(k, p, q); }
  /// q -= the same.
  void subtract_plane(int k, const float* p, float* q) const { (void)add_plane<-1>(k, p, q); }
  [[nodiscard]] float value(int pair, const Index3& cell) const { return g_[pair][layout_.index(cell)]; }
  [[nodiscard]] Values& values(int pair) { return g_[pair]; }

 private:
  /// What lies beyond the block at both ends of an axis.
  enum class Beyond { Cells, Wall, Pressure };
  template <int sign>
  double add_plane(int k, const float* p, float* q) const;
  void cross_row(int j, int k, int colour, const float* values);
  void cross_row_across(int axis, int j, int k, int colour, const float* values);
  void add_ends(int j, int k, const float* values);
  void weigh_cross_terms(int k, const float* values);
  template <int sign>
  double weigh_cross_fluxes(int k, const float* p, float* q) const;
  void close_row(int j, int k);
  /// Differences to p = 0 on a side are twice those to the value beyond, which is zero.
  [[nodiscard]] float half(int axis, int side, int index) const;
  [[nodiscard]] bool at_side(int axis, int side, int index) const
  {
    return beyond_[axis][side] != Beyond::Cells && index == (side == 0 ? 0 : cells_[axis] - 1);
  }

  static constexpr int ring = 4;
  /// Such that w()[place] is w_a at a place on plane k.
  [[nodiscard]] std::ptrdiff_t shift(int k) const
  {
    const int plane = k - layout_.owned.lo[2] + 1;
    return slots_ == 0 ? 0 : (plane % slots_ - plane) * layout_.plane;
  }
  [[nodiscard]] float* w(int axis, int k) { return w_[axis].data() + shift(k); }
  [[nodiscard]] const float* w(int axis, int k) const { return w_[axis].data() + shift(k); }

  Level& level_;
  Layout layout_;
  int slots_ = 0;
  Index3 cells_{};
  std::array<std::array<Beyond, 2>, 3> beyond_{};
  PartialFaces beside_partial_;
  std::array<Values, 3> g_;
  std::array<Values, 3> w_;
};

}  // namespace luff::poisson
