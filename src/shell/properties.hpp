// SPDX-License-Identifier: BSD-3-Clause
// What a shell is made of.
#pragma once

#include <string_view>

#include "core/vec3.hpp"
#include "shell/bending_operator.hpp"

namespace luff::shell {

/// Uniform properties of one shell, in any consistent units.
struct Properties {
  double thickness = 0;          ///< h [L], > 0
  double density = 0;            ///< rho [M/L^3], >= 0; dynamics needs > 0
  double young = 0;              ///< E [M/(L T^2)], > 0
  double poisson = 0;            ///< nu [-], -1 < nu <= 0.5
  BendingKind bending = BendingKind::AveragedQuadratics;
  double damping_mass = 0;       ///< f_m [1/T], >= 0
  double damping_stiffness = 0;  ///< f_k [T], >= 0
  Vec3 gravity = Vec3::Zero();   ///< acceleration [L/T^2]

  double mass_per_area() const { return density * thickness; }
};

/// \throws InputError naming `shell`, the property, its value and what is allowed.
void validate(const Properties& properties, std::string_view shell);

/// Plane-stress moduli of St-Venant-Kirchhoff's law in Voigt order (11, 22, 12 with engineering shear) [M/(L T^2)],
///
///   C = E/(1 - nu^2) [1 nu 0; nu 1 0; 0 0 (1 - nu)/2].
Mat3 plane_stress_moduli(const Properties& properties);

}  // namespace luff::shell
