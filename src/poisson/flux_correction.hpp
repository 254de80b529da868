// SPDX-License-Identifier: BSD-3-Clause
// Volume fluxes in double precision: their net outflow, and their correction by a pressure gradient.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Net outflow of fluxes from the cells of all ranks; that of isolated cells, whose faces are all closed, counts as
/// zero.
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

/// The part that does not depend on the grid's kind.
class FluxCorrection {
 public:
  FluxCorrection(const grid::Grid& grid, const SideConditions& sides);
  FluxCorrection(const FluxCorrection&) = delete;
  FluxCorrection& operator=(const FluxCorrection&) = delete;
  virtual ~FluxCorrection() = default;

  /// Faces among those of owned cells; only the open part of each is corrected.
  virtual void set_blocked(std::span<const FaceIndex> faces);

  /// Work on the rows of the plane t along the outer axis, the longer of y and z.
  using PlaneWork = std::function<void(int t)>;
  /// Takes the net outflows of the owned cells of row (j, k).
  using RowSink = std::function<void(int j, int k, const double* net_outflow)>;

  /// Hands every row's net outflows to `sink`.  Collective.
  [[nodiscard]] Outflow measure(const View3<double>& U, const RowSink& sink) const;

  /// U <- U - factor G p on all faces of owned cells, then measures.  `prepare` makes p on a plane (halo rows included)
  /// just before it is used; p needs its halo, mirrored beyond Dirichlet sides.  Collective.
  template <class T>
  Outflow correct(const View3<double>& U, const View<const T>& p, double factor, const PlaneWork& prepare,
                  const RowSink& sink);

  /// U <- U - factor G p on all faces of owned cells.  Local.
  void subtract(const View3<double>& U, const View<const double>& p, double factor);

  [[nodiscard]] int outer_axis() const { return outer_; }

 protected:
  /// Stages of work on plane t: what correct_plane() needs from the planes around, and the correction itself.
  [[nodiscard]] virtual bool prepares_planes() const { return false; }
  virtual void prepare_plane(const View<const double>&, int) {}
  virtual void prepare_plane(const View<const float>&, int) {}
  virtual void correct_plane(const View3<double>& U, const View<const double>& p, double factor, int t) = 0;
  virtual void correct_plane(const View3<double>& U, const View<const float>& p, double factor, int t) = 0;
  /// Largest of |net_i| h / V, h the smallest width of the cell, over row (j, k).
  [[nodiscard]] virtual double largest_divergence(const double* net, int j, int k) const = 0;
  /// h / V of one cell.
  [[nodiscard]] virtual double width_over_volume(const Index3& c) const = 0;

  template <class Row>
  void for_rows(int t, Row row) const
  {
    const int inner = 3 - outer_;
    for (int b = grid_.owned().lo[inner]; b < grid_.owned().hi[inner]; ++b)
      outer_ == 2 ? row(b, t) : row(t, b);
  }
  /// The faces of plane t, each once: along(j, k) for those along a row, across(axis, j, k) for the low faces of a row;
  /// the last plane takes its high faces too.
  template <class Along, class Across>
  void for_faces(int t, Along along, Across across) const
  {
    const IndexBox& box = grid_.owned();
    for_rows(t, [&](int j, int k) {
      along(j, k);
      across(1, j, k);
      across(2, j, k);
    });
    const int inner = 3 - outer_;
    Index3 last{};
    last[outer_] = t;
    last[inner] = box.hi[inner];
    across(inner, last[1], last[2]);
    if (t + 1 == box.hi[outer_])
      for_rows(t, [&](int j, int k) { across(outer_, outer_ == 1 ? j + 1 : j, outer_ == 2 ? k + 1 : k); });
  }

  const grid::Grid& grid_;
  SideConditions sides_;
  int outer_;

 private:
  struct Partial {
    double sum = 0.0, norm = 0.0, flux_norm = 0.0, divergence = 0.0;
  };
  [[nodiscard]] Partial measure_row(const View3<double>& U, int j, int k, double* net) const;
  void measure_plane(const View3<double>& U, int t, const RowSink& sink, std::vector<Partial>& partial) const;
  [[nodiscard]] std::size_t number_of_row(int j, int k) const;
  void forget_isolated(int j, int k, double* net) const;
  [[nodiscard]] Outflow collect(const View3<double>& U, const std::vector<Partial>& partial) const;
  [[nodiscard]] Index3 worst_cell_of_row(const View3<double>& U, std::size_t row) const;

  std::vector<int> isolated_;        // i of isolated cells, by row
  std::vector<int> first_isolated_;  // of a row; empty when there are none
};

/// The correction for the grid's kind.
[[nodiscard]] std::unique_ptr<FluxCorrection> make_flux_correction(const grid::Grid& grid, const SideConditions& sides);

/// Owned cells of which every face is blocked or on a Neumann side.
[[nodiscard]] std::vector<Index3> isolated_cells(const grid::Grid& grid, const SideConditions& sides,
                                                 std::span<const FaceIndex> blocked);

/// Beyond Dirichlet sides, halos included: p <- -p of the cell inside, so that p = 0 on the side.
template <class T>
void mirror_beyond_sides(const grid::Grid& grid, const SideConditions& sides, const View<T>& p);

/// The pressure given on Dirichlet sides: the means of p in the cells inside and beyond.
class SidePressure {
 public:
  SidePressure(const grid::Grid& grid, const SideConditions& sides, const View<const double>& p);
  /// Makes the halo beyond Dirichlet sides mirror p there about the given pressure.
  void restore(const View<double>& p) const;

 private:
  struct Value {
    Index3 inside, beyond;
    double value;
  };
  std::vector<Value> values_;
};

}  // namespace luff::poisson
