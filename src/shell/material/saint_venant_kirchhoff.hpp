// SPDX-License-Identifier: BSD-3-Clause
// St-Venant-Kirchhoff's law: stress linear in the Green-Lagrange strain.
#pragma once

#include "shell/material/response.hpp"

namespace luff::shell {

/// W = E.C E/2 with the plane-stress moduli C. For small strains only: it softens under compression without bound.
struct SaintVenantKirchhoff {
  double young = 0;    ///< E [M/(L T^2)], > 0
  double poisson = 0;  ///< nu [-], -1 < nu <= 1/2

  double energy(const Vec3& E, const Fibre&) const { return 0.5 * E.dot(reference_moduli() * E); }
  Vec3 stress(const Vec3& E, const Fibre&) const { return reference_moduli() * E; }
  Mat3 tangent(const Vec3&, const Fibre&) const { return reference_moduli(); }
  Response response(const Vec3& E, const Fibre& a) const { return {stress(E, a), tangent(E, a)}; }
  Mat3 reference_moduli() const { return isotropic_plane_stress(young, poisson); }
};

}  // namespace luff::shell
