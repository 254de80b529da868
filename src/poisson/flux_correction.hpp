// SPDX-License-Identifier: BSD-3-Clause
// Volume fluxes in double precision: their net outflow, and their correction by a pressure gradient.
#pragma once

#include <functional>
#include <vector>

#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Net outflow of fluxes from the cells of all ranks.
struct Outflow {
  double sum = 0.0;         ///< over cells [L^3/T]
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

/// The figure of a report: zero in a fluid at rest, whatever the speed.
[[nodiscard]] inline double relative_divergence(const Outflow& outflow, const Target& target)
{
  return outflow.divergence == 0.0 ? 0.0 : outflow.divergence / target.speed;
}

class FluxCorrection {
 public:
  FluxCorrection(const grid::Grid& grid, const SideConditions& sides);

  /// Faces among those of owned cells; none of them is corrected.
  void set_blocked(std::span<const FaceIndex> faces);

  /// Work on the rows of the plane t along the outer axis, the longer of y and z.
  using PlaneWork = std::function<void(int t)>;
  /// Takes the net outflows of the owned cells of row (j, k).
  using RowSink = std::function<void(int j, int k, const double* net_outflow)>;

  /// Hands every row's net outflows to `sink`.  Collective.
  [[nodiscard]] Outflow measure(const View3<double>& U, const RowSink& sink) const;

  /// U <- U - factor G p on all faces of owned cells, then measures.  `prepare` makes p on a plane (halo rows included)
  /// just before it is used; p needs its halo, except beyond the sides of the domain.  Collective.
  template <class T>
  Outflow correct(const View3<double>& U, const View<const T>& p, double factor, const PlaneWork& prepare,
                  const RowSink& sink);

  /// U <- U - factor G p on all faces of owned cells.  Local.
  template <class T>
  void subtract(const View3<double>& U, const View<const T>& p, double factor);

  [[nodiscard]] int outer_axis() const { return outer_; }

 private:
  struct Partial {
    double sum = 0.0, norm = 0.0, flux_norm = 0.0, divergence = 0.0;
  };
  template <class Row>
  void for_rows(int t, Row row) const;
  template <class T>
  void correct_plane(const View3<double>& U, const View<const T>& p, double factor, int t);
  template <class T>
  void correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j, int k) const;
  template <class T>
  void correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor, int j, int k) const;
  [[nodiscard]] Partial measure_row(const View3<double>& U, int j, int k, double* net) const;
  void measure_plane(const View3<double>& U, int t, const RowSink& sink, std::vector<Partial>& partial) const;
  [[nodiscard]] std::size_t number_of_row(int j, int k) const;
  [[nodiscard]] Outflow collect(const View3<double>& U, const std::vector<Partial>& partial) const;
  [[nodiscard]] Index3 worst_cell_of_row(const View3<double>& U, std::size_t row) const;
  [[nodiscard]] double inverse_distance(int axis, int face) const;
  template <class T>
  [[nodiscard]] const T* zero_row() const
  {
    if constexpr (std::is_same_v<T, float>)
      return float_zeros_.data();
    else
      return zeros_.data();
  }

  const grid::Grid& grid_;
  SideConditions sides_;
  int outer_;
  std::vector<double> inverse_distance_x_;
  std::vector<double> width_x_;
  std::vector<double> zeros_;
  std::vector<float> float_zeros_;
  std::vector<FaceIndex> blocked_;  // by plane
  std::vector<int> first_blocked_;  // of a plane
  std::vector<double> kept_;
};

}  // namespace luff::poisson
