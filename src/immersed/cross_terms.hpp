// SPDX-License-Identifier: BSD-3-Clause
// Diffusion of momentum across skewed cells beside a sheet: cross terms that don't reach across it.
#pragma once

#include <vector>

#include "immersed/cut_links.hpp"
#include "parallel/halo.hpp"

namespace luff::immersed {

/// On a curvilinear grid the gradient flux through a face of direction a has, beside a_f (u_N - u_P), the cross part
///
///   (w_a(P) + w_a(N))/2,   w_a = sum_{b != a} G_ab <d_b>,   <d_b> = (u(+b) - u(-b))/2
///
/// (operators::GradientStencil).  In a cut cell <d_b> ends on the sheet and leaves the cell's own value out,
///
///   <d_b> = (u_e - u_w)/(theta_e + theta_w),
///
/// theta = 1 on open links, max(theta, theta_min) on cut ones: exact for linear flows.  The change of w_a acts on the
/// cell itself and on its neighbours behind open links.  Through a cut face the cross flux is extrapolated,
/// 3/2 w_a(P) - 1/2 w_a(W) with W the neighbour behind, w_a(P) where there is none.  A face that is covered in part
/// counts as cut and as open in proportion (LinkForms).
class CrossTerms {
 public:
  /// Collective.
  explicit CrossTerms(const grid::Grid& grid);

  /// Finds the neighbours of the cut cells.  Collective.
  void freeze(const CutLinks& links);
  /// Cross terms of the cut cells for the velocity u, whose halo with its edges is filled.  Collective.
  void update(const CutLinks& links, const View3<const double>& u, const StageTime& time);

  /// Net outflow of the cross fluxes from a cut cell [L^2/T].
  [[nodiscard]] Vec3 net_outflow(const CutLinks& links, const CutCell& cut, const View3<const double>& u) const;
  /// The cross flux through the cut face of a cell along an axis (side 0: its low face), towards increasing index.
  [[nodiscard]] Vec3 at_wall(const CutLinks& links, const CutCell& cut, int axis, int side,
                             const View3<const double>& u) const;
  /// Owned cells that are not cut, beside cut ones.
  [[nodiscard]] const std::vector<Index3>& neighbours() const { return neighbours_; }
  /// What must be added to the net outflow from one of them, for the cross terms of cut cells changed.
  [[nodiscard]] Vec3 change_in_neighbour(const Index3& cell) const;

 private:
  [[nodiscard]] Vec3 w(int axis, const Index3& cell, const View3<const double>& u) const;
  [[nodiscard]] Vec3 w_beside(const CutCell& cut, int axis, int side, const View3<const double>& u) const;
  [[nodiscard]] bool beyond_domain(int axis, const Index3& cell) const;

  const grid::Grid& grid_;
  const grid::Curvilinear& metric_;
  HaloExchange halo_;
  Field<int> kind_;  ///< 1: cut, 2: beside cut cells
  std::vector<Index3> cut_;
  std::vector<Index3> neighbours_;
  std::array<Field3<double>, 3> change_;  ///< [a][c]: component c of w_a in cut cells, less what bulk cells have
};

}  // namespace luff::immersed
