// SPDX-License-Identifier: BSD-3-Clause
// Convection, diffusion and the passage between cell centres and faces: the only place, with poisson/, that sees
// metrics.
#pragma once

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::operators {

/// Weights of one Runge-Kutta stage: du <- du + new_rate N(u) + old_rate N_old, both in units of time.
struct StageWeights {
  double new_rate = 0.0;
  double old_rate = 0.0;
};

/// One explicit stage of the momentum equation in every owned cell,
///
///   N_c = -(1/V) sum_f [ U_f (u_P + u_N)/2 ] + nu (1/V) sum_f F_f + f_c,
///   du <- du + w_new N + w_old N_old,   N_old <- N,
///
/// with central convection in divergence form.  u [L/T] at centres with valid halos (edges included on curvilinear
/// grids), U [L^3/T] the volume fluxes.  F_f = A_f (u_N - u_P)/d_f, on curvilinear grids the full metric
/// (GradientStencil).  Second order on smooth grids.
void advance_momentum(const grid::Grid& grid, const View3<const double>& u, const View3<const double>& U,
                      double viscosity, const Vec3& force, const StageWeights& weights, const View3<double>& rate,
                      const View3<double>& increment);

/// U*_f = U^n_f + S_f . (du_P + du_N)/2 on every face of owned cells; du with valid halos.  Domain boundaries are the
/// caller's.
void interpolate_to_faces(const grid::Grid& grid, const View3<const double>& U_old,
                          const View3<const double>& increment, const View3<double>& U);

/// u at centres such that u . S is the mean of the fluxes through opposite faces: exact for a uniform flow.
void recover_velocity(const grid::Grid& grid, const View3<const double>& U, const View3<double>& u);

/// Largest over cells of sum_d |U_d|/(A_d h_d) [1/T], the flux taken as the larger of the two faces: times dt, the CFL
/// number.  NaN when any flux is NaN.  Over all ranks.
[[nodiscard]] double convective_rate(const grid::Grid& grid, const View3<const double>& U);

/// Largest over cells of sum_d 1/h_d^2, of sum_a G_aa/V on curvilinear grids [1/L^2]: times nu dt, the diffusion
/// number.
[[nodiscard]] double diffusive_rate(const grid::Grid& grid);

/// Largest |u| over cells [L/T].  Over all ranks.
[[nodiscard]] double largest_speed(const grid::Grid& grid, const View3<const double>& u);

/// (1 + w) now - w before in every owned cell.
void extrapolate(const IndexBox& owned, const View<const double>& now, const View<const double>& before, double w,
                 const View<double>& result);

}  // namespace luff::operators
