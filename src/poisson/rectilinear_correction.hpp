// SPDX-License-Identifier: BSD-3-Clause
// Correction of fluxes on uniform and rectilinear grids.
#pragma once

#include <vector>

#include "poisson/flux_correction.hpp"

namespace luff::poisson {

/// G p = A (p_N - p_P)/d.
class RectilinearCorrection final : public FluxCorrection {
 public:
  RectilinearCorrection(const grid::Grid& grid, const SideConditions& sides);
  void set_blocked(std::span<const FaceIndex> faces) override;

 protected:
  void correct_plane(const View3<double>& U, const View<const double>& p, double factor, int t) override;
  void correct_plane(const View3<double>& U, const View<const float>& p, double factor, int t) override;
  [[nodiscard]] double largest_divergence(const double* net, int j, int k) const override;
  [[nodiscard]] double width_over_volume(const Index3& c) const override;

 private:
  template <class T>
  void correct_plane_of(const View3<double>& U, const View<const T>& p, double factor, int t);
  template <class T>
  void correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j, int k) const;
  template <class T>
  void correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor, int j, int k) const;
  [[nodiscard]] double inverse_distance(int axis, int face) const;

  std::vector<double> inverse_distance_x_;
  std::vector<double> width_x_;
  std::vector<FaceIndex> blocked_;  // by plane
  std::vector<int> first_blocked_;  // of a plane
  std::vector<double> kept_;
};

}  // namespace luff::poisson
