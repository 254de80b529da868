// SPDX-License-Identifier: BSD-3-Clause
// The kinetic energy of the flow, and what changes it.
#pragma once

#include "fluid/flow_solver.hpp"

namespace luff::fluid {

/// At an instant.  With the power of surfaces in the flow the powers add up to dE/dt,
///
///   E = int rho |u|^2/2 dV,   dE/dt = sides + surfaces + body_force - dissipation,
///
/// but for what the discretisation adds or takes.
struct FlowEnergy {
  double kinetic = 0.0;      ///< E [M L^2/T^2]
  double dissipation = 0.0;  ///< int mu |grad u|^2 dV [M L^2/T^3]
  double sides = 0.0;        ///< through the sides of the domain: energy carried, pressure and friction
  double body_force = 0.0;
};

/// Of the accepted flow at t, in the cells outside closed bodies: the sums that the discrete momentum equation
/// multiplied with u gives.  With F_f = nu (grad u . S) through face f between cells P and N, u_f their mean,
///
///   dissipation = rho sum_f F_f . (u_N - u_P)   (half of it on sides; in cut links nu A |u_P - u_b|^2/h_k),
///   sides = rho sum over sides, outwards, of  -U (u_P . u_N)/2 - p_f U + F_f . u_f,
///
/// p extrapolated to t; where the velocity is prescribed the tangential part of F_f is that of side_stresses().  Halos
/// filled by fill_halos().  Collective.
[[nodiscard]] FlowEnergy energy(const FlowSolver& flow, double t);

}  // namespace luff::fluid
