// SPDX-License-Identifier: BSD-3-Clause
// Means over time of velocity and pressure, and the covariances of their fluctuations.
#pragma once

#include <array>

#include "fluid/flow_solver.hpp"
#include "output/snapshot.hpp"

namespace luff::simulation {

/// In each cell, over all steps added so far, weighted by their lengths,
///
///   m = <x>,   s_ab = T <(x_a - m_a)(x_b - m_b)>,   x = (u, v, w, p),
///
/// updated one step at a time without the cancellation of <x^2> - m^2 [west_1979_updating].  Of each step the velocity
/// in the middle, (u^n + u^{n+1})/2, and the kinematic pressure there.
struct FlowMoments {
  explicit FlowMoments(const IndexBox& owned);

  /// An accepted step of length dt.
  void add(const fluid::FlowSolver& flow, double dt);

  double time = 0.0;  ///< T, that the means are over [T]
  Field3<double> u;
  Field<double> p;
  std::array<Field<double>, 6> uu;  ///< s of uu, vv, ww, uv, vw, uw (VTK's order of symmetric tensors) [L^2/T]
  Field<double> pp;
};

/// velocity_mean, velocity_rms, velocity_covariance (xx, yy, zz, xy, yz, xz), pressure_mean and pressure_rms, pressures
/// times the density.
[[nodiscard]] output::FlowSnapshot moments_snapshot(const grid::Grid& grid, const FlowMoments& moments, double density);

}  // namespace luff::simulation
