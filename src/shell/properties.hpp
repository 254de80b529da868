// SPDX-License-Identifier: BSD-3-Clause
// What a shell is made of.
#pragma once

#include <string_view>

#include "core/vec3.hpp"
#include "shell/bending_operator.hpp"
#include "shell/material/material.hpp"
#include "shell/membrane.hpp"

namespace luff::shell {

/// Uniform properties of one piece of a shell, in any consistent units.
struct Properties {
  double thickness = 0;  ///< h [L], > 0
  double density = 0;    ///< rho [M/L^3], >= 0; dynamics needs > 0
  Material material;
  int thickness_points = 0;  ///< Gauss points through the thickness, 1 to 5; 0: what the material recommends
  BendingKind bending = BendingKind::AveragedQuadratics;
  bool lumped_mass = false;  ///< a third of each triangle's at each corner, instead of the consistent matrix
  MembraneKind membrane = MembraneKind::ConstantStrain;
  double damping_mass = 0;       ///< f_m [1/T], >= 0
  double damping_stiffness = 0;  ///< f_k [T], >= 0
  Vec3 gravity = Vec3::Zero();   ///< acceleration [L/T^2]

  double mass_per_area() const { return density * thickness; }
};

/// \throws InputError naming `shell`, the property, its value and what is allowed.
void validate(const Properties& properties, std::string_view shell);

}  // namespace luff::shell
