// SPDX-License-Identifier: BSD-3-Clause
// Momentum, pressure gradient and velocity in cells beside a sheet.
#pragma once

#include <vector>

#include "immersed/cut_links.hpp"

namespace luff::immersed {

/// Terms of the momentum equation of one cut cell.  Cut links enter one-sided, the sheet standing at the distance
/// h_k = max(theta, theta_min) d; the diagonal of the cut links is implicit, so that no small theta limits the step:
///
///   du/dt = explicit_rate + wall_source - wall_rate u - G p,
///   explicit_rate = - sum_d u_d (u_e - u_w)/(h_e + h_w) + nu sum_open (u_k - u_P)/(h_k H_d) + f,
///   wall_source = sum_cut v_k u_b,   wall_rate = sum_cut v_k,   v_k = nu/(h_k H_d),   H_d = (h_e + h_w)/2.
///
/// Where the sheet covers a part of a face, the terms are those of the cut and of the open link in that proportion.
///
/// Convection skips the cell's own value (advective form): the second-order derivative on uneven links would put
/// -u/(theta h) on the diagonal, which destabilises a moving sheet (docs/numerics/immersed.md).
struct CutCellTerms {
  Vec3 explicit_rate;
  Vec3 wall_source;
  double wall_rate = 0.0;
};

/// Terms with the velocity field u at the time `now` of the explicit part and `then` of the implicit part.
[[nodiscard]] CutCellTerms momentum_terms(const CutLinks& links, const CutCell& cut, const View3<const double>& u,
                                          double viscosity, const StageTime& now, const StageTime& then);

/// wall_source alone, sum_cut v_k u_b(then): what a coupling iteration changes.
[[nodiscard]] Vec3 wall_source(const CutLinks& links, const CutCell& cut, double viscosity, const StageTime& then);

/// Gradient of p at the centre, one-sided across cut links, zero along an axis cut on both sides; across faces that are
/// covered in part by the part that is open.  p with valid halos.
[[nodiscard]] Vec3 pressure_gradient(const grid::Grid& grid, const CutLinks& links, const CutCell& cut,
                                     const View<const double>& p);

/// Velocity from the fluxes, with the sheet's own velocity at its place on cut links: tends to u_b as theta -> 0.  At a
/// face covered in part, in that proportion with what follows from the velocity through the open part.
void recover_velocity(const grid::Grid& grid, const CutLinks& links, const View3<const double>& U,
                      const StageTime& time, const View3<double>& u);

}  // namespace luff::immersed
