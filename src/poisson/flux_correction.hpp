// SPDX-License-Identifier: BSD-3-Clause
// Volume fluxes in double precision: their net outflow, and their correction by a pressure gradient.
#pragma once

#include <vector>

#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Net outflow of fluxes from the cells of all ranks.
struct Outflow {
  double norm = 0.0;        ///< 2-norm over cells [L^3/T]
  double flux_norm = 0.0;   ///< 2-norm of the fluxes themselves: their round-off is what `norm` can fall to
  double divergence = 0.0;  ///< max over cells of |net outflow| h / V [L/T]; NaN when any flux is
  Index3 worst_cell{};
};

/// Whether a target is met, given the norm before any correction.
[[nodiscard]] inline bool meets(const Outflow& outflow, double initial_norm, const Target& target)
{
  return outflow.norm == 0.0 || (target.relative > 0.0 && outflow.norm <= target.relative * initial_norm) ||
         (target.divergence > 0.0 && outflow.divergence <= target.divergence * target.speed);
}

class FluxCorrection {
 public:
  FluxCorrection(const grid::Grid& grid, const SideConditions& sides);

  /// Faces among those of owned cells; none of them is corrected.
  void set_blocked(std::span<const FaceIndex> faces) { blocked_.assign(faces.begin(), faces.end()); }

  /// net = minus the net outflow of every owned cell; collective.
  Outflow measure(const View3<double>& U, const View<double>& net) const;

  /// U <- U - factor G p on all faces of owned cells; p with its halo, except beyond the sides of the domain.
  template <class T>
  void correct(const View3<double>& U, const View<const T>& p, double factor);

 private:
  template <class T>
  void correct_axis(int axis, const View<double>& U, const View<const T>& p, double factor) const;
  template <class T>
  void correct_along_rows(const View<double>& U, const View<const T>& p, double factor) const;
  [[nodiscard]] double inverse_distance(int axis, int face) const;

  const grid::Grid& grid_;
  SideConditions sides_;
  std::vector<FaceIndex> blocked_;
  std::vector<double> kept_;
  std::vector<double> inverse_distance_x_;
};

}  // namespace luff::poisson
