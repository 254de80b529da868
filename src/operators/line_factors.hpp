// SPDX-License-Identifier: BSD-3-Clause
// An approximate inverse of the implicit momentum equation: tridiagonal systems along the lines of the grid.
#pragma once

#include <array>

#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::operators {

/// The factors of
///
///   prod_a (1 + tau L_a),   (L_a v)_P = (1/V) [ sum_f +-U_f v_f - nu sum_f g_f (v_N - v_P) ],   g_f = A/d or G_aa,
///
/// along the index directions a, central convection by frozen fluxes.  Lines end with the block of a rank, without a
/// gradient but at sides of the domain that hold the velocity, where it is of second order.  An
/// approximate factorisation [beam_1978_implicit] as preconditioner: exact for a direction that dominates, as across
/// thin cells at walls.
class LineFactors {
 public:
  /// holds[a][end]: the velocity is given there.
  LineFactors(const grid::Grid& grid, const std::array<std::array<bool, 2>, 3>& holds);

  /// Factors for the weight tau [T], the fluxes U [L^3/T] and the viscosity [L^2/T].
  void update(double tau, const View3<const double>& U, double viscosity);

  /// Replaces v by the solution of the factors' systems, component by component.
  void solve(const View3<double>& v) const;

 private:
  const grid::Grid& grid_;
  std::array<std::array<bool, 2>, 3> holds_;  ///< of those that this rank touches
  // Thomas's algorithm, for each direction: x_i <- (x_i - low_i x_{i-1}) pivot_i upwards, x_i <- x_i - high_i x_{i+1}
  // downwards.
  Field3<double> low_;
  Field3<double> pivot_;
  Field3<double> high_;
};

}  // namespace luff::operators
