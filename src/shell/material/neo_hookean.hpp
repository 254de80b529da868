// SPDX-License-Identifier: BSD-3-Clause
// Incompressible neo-Hookean law in plane stress.
#pragma once

#include "shell/material/invariants.hpp"

namespace luff::shell {

/// W = mu (I1 - 3)/2. At rest Young's modulus is 3 mu and Poisson's ratio 1/2.
struct NeoHookean {
  double shear_modulus = 0;  ///< mu [M/(L T^2)], > 0

  double energy(const Vec3& E, const Fibre&) const { return 0.5 * shear_modulus * FirstInvariant(E).excess(); }
  Vec3 stress(const Vec3& E, const Fibre&) const { return 0.5 * shear_modulus * FirstInvariant(E).gradient(); }
  Mat3 tangent(const Vec3& E, const Fibre&) const { return 0.5 * shear_modulus * FirstInvariant(E).hessian(); }
  Response response(const Vec3& E, const Fibre& a) const { return {stress(E, a), tangent(E, a)}; }
  Mat3 reference_moduli() const { return incompressible_plane_stress(shear_modulus); }
};

}  // namespace luff::shell
