// SPDX-License-Identifier: BSD-3-Clause
// Correction of fluxes on curvilinear grids.
#pragma once

#include "poisson/curvilinear_operator.hpp"
#include "poisson/flux_correction.hpp"
#include "poisson/partial_faces.hpp"

namespace luff::poisson {

/// G p = F of CurvilinearOperator.
class CurvilinearCorrection final : public FluxCorrection {
 public:
  CurvilinearCorrection(const grid::Grid& grid, const SideConditions& sides);

  void set_blocked(std::span<const FaceIndex> faces) override;
  [[nodiscard]] const CurvilinearOperator& gradient() const { return operator_; }
  /// Of all ranks.
  [[nodiscard]] const std::vector<FaceIndex>& partial_faces() const { return partial_faces_; }
  /// What the last call of set_blocked() changed.
  [[nodiscard]] const CurvilinearOperator::Changes& changes() const { return changes_; }

 protected:
  [[nodiscard]] bool prepares_planes() const override { return true; }
  void prepare_plane(const View<const double>& p, int t) override;
  void prepare_plane(const View<const float>& p, int t) override;
  void correct_plane(const View3<double>& U, const View<const double>& p, double factor, int t) override;
  void correct_plane(const View3<double>& U, const View<const float>& p, double factor, int t) override;
  [[nodiscard]] double largest_divergence(const double* net, int j, int k) const override;
  [[nodiscard]] double width_over_volume(const Index3& c) const override { return width_over_volume_.view()(c); }

 private:
  /// Whether cells beyond a side of this rank's block exist, on another rank or across a periodic seam.
  [[nodiscard]] bool continues(int axis, int side) const
  {
    return !grid_.ranks().at_boundary(axis, side) && grid_.cells()[axis] > 1;
  }
  template <class T>
  void cross_plane(const View<const T>& p, int t);
  template <class T>
  void cross_row(int axis, const View<const T>& p, int j, int k);
  template <class T>
  void weigh_cross_terms(const View<const T>& p, int t);
  void weigh_cross_fluxes(const View3<double>& U, double factor, int t) const;
  void close_row(int j, int k);
  template <class T>
  void correct_plane_of(const View3<double>& U, const View<const T>& p, double factor, int t);
  template <class T>
  void correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j, int k) const;
  template <class T>
  void correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor, int j, int k) const;

  CurvilinearOperator operator_;
  CurvilinearOperator::Changes changes_;
  std::vector<FaceIndex> partial_faces_;
  PartialFaces beside_partial_;
  Field3<double> w_;  // cross terms of the latest planes
  Field<double> width_over_volume_;
};

}  // namespace luff::poisson
