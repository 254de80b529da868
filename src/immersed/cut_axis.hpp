// SPDX-License-Identifier: BSD-3-Clause
// The two links of a cut cell along one axis, as its stencils see them.
#pragma once

#include "immersed/cut_links.hpp"

namespace luff::immersed {

/// Smallest relative distance of a surface from a centre that friction sees.  Beyond a free edge nothing is there that
/// the flow would have to slow down beside: a strip that holds cells the more the nearer it passes them takes too much.
[[nodiscard]] inline double least_theta(const CutFace& face)
{
  return face.cover < 1.0 ? 0.5 : theta_min;
}

/// Side 0 below, side 1 above.
struct CutAxis {
  const CellAxis& whole;                         ///< as if no link were cut
  std::array<int, 2> hit{open_link, open_link};  ///< the hit that the cell sees on each link
  std::array<double, 2> theta{1.0, 1.0};         ///< distance of the sheet over that of the other centre; 1: open
  std::array<double, 2> length{};                ///< h_k, to the neighbour or to the sheet, clipped by least_theta()
  double span = 0.0;                             ///< H_d

  [[nodiscard]] bool cut(int side) const { return hit[side] != open_link; }
  [[nodiscard]] bool any_cut() const { return cut(0) || cut(1); }
  /// v_k = nu/(h_k H_d), times the area of the face over that at the centre
  [[nodiscard]] double exchange(int side, double viscosity) const
  {
    return viscosity / (length[side] * span * whole.area_ratio[side]);
  }
  /// Difference of a field along the axis per cell, from the values beside it: its own value is left out.
  template <class Value>
  [[nodiscard]] Value difference(const Value& low, const Value& high) const
  {
    return (high - low) / (length[0] / whole.distance[0] + length[1] / whole.distance[1]);
  }
};

/// Which of the two links of a cell along an axis count as cut, and how much this counts.
struct LinkForm {
  std::array<bool, 2> cut{};
  double weight = 1.0;
  [[nodiscard]] bool any_cut() const { return cut[0] || cut[1]; }
};

/// The forms that the stencils of a cell along an axis are made of: a link of whose face the sheet covers the part c is
/// cut with weight c and open with weight 1 - c.
class LinkForms {
 public:
  LinkForms(const CutLinks& links, const CutCell& cut, int axis);
  [[nodiscard]] const LinkForm* begin() const { return forms_.data(); }
  [[nodiscard]] const LinkForm* end() const { return forms_.data() + count_; }

 private:
  std::array<LinkForm, 4> forms_{};
  int count_ = 0;
};

/// Part of the face that the sheet covers on a side of a cell; 0: open.
[[nodiscard]] inline double cover(const CutLinks& links, const CutCell& cut, int axis, int side)
{
  const int f = cut.face[2 * axis + side];
  return f == open_link ? 0.0 : links.faces()[f].cover;
}

/// The links in one form, with the sheet where it is at a time of the step.
[[nodiscard]] CutAxis cut_axis(const CutLinks& links, const CutCell& cut, int axis, const StageTime& time,
                               const std::array<bool, 2>& as_cut);

/// The velocities beside a cut cell along an axis: the neighbour's, or that of the sheet.
[[nodiscard]] std::array<Vec3, 2> velocities_beside(const CutLinks& links, const CutCell& cut, int axis,
                                                    const CutAxis& along, const View3<const double>& u,
                                                    const StageTime& time);

}  // namespace luff::immersed
