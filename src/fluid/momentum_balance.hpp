// SPDX-License-Identifier: BSD-3-Clause
// Momentum of the fluid in a box of cells over a step: an account of the forces on what stands in the box that is
// independent of how they are found at surfaces.
#pragma once

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::fluid {

/// The flow at both ends of a step, velocities with valid halos, edges included; p [L^2/T^2] is that of the middle.
struct FlowOverStep {
  View3<const double> u_old;
  View3<const double> U_old;
  View3<const double> u;
  View3<const double> U;
  View<const double> p;
  double dt = 0.0;
};

/// What the fluid in a box of cells loses in the mean of a step, per density [L^4/T^2]:
///
///   - (int u dV - int u_old dV)/dt - sum_f <U u_f - nu (grad u . S)_f>_f - sum_f p_f S_f,
///
/// f the faces of the box outwards, < > the mean of both ends.  Faces of periodic sides, where the box meets itself,
/// cancel.  Collective; the same on every rank.
[[nodiscard]] Vec3 momentum_lost(const grid::Grid& grid, const IndexBox& box, const FlowOverStep& flow,
                                 double viscosity);

/// The cells whose low faces are the low (end 0) or high (end 1) side of a box, of those that this rank answers for:
/// the rank of the cell inside the box.
[[nodiscard]] IndexBox side_faces(const grid::Grid& grid, const IndexBox& box, int axis, int end);

}  // namespace luff::fluid
