// SPDX-License-Identifier: BSD-3-Clause
// What a law of plane stress answers, and the fibre it is asked about.
#pragma once

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace luff::shell {

/// (cos, sin) of the fibre's angle to the first side in the plane of a reference triangle; see shell/fibres.hpp.
using Fibre = Eigen::Vector2d;

/// Second Piola-Kirchhoff stress (S11, S22, S12) and its derivative in the Green-Lagrange strain (E11, E22, 2 E12)
/// [M/(L T^2)].
struct Response {
  Vec3 stress;
  Mat3 tangent;
};

/// Moduli of an isotropic linear material in plane stress,
///
///   C = E/(1 - nu^2) [1 nu 0; nu 1 0; 0 0 (1 - nu)/2].
inline Mat3 isotropic_plane_stress(double young, double poisson)
{
  Mat3 C;
  C << 1, poisson, 0, poisson, 1, 0, 0, 0, (1 - poisson) / 2;
  return young / (1 - poisson * poisson) * C;
}

/// The same of an incompressible one with shear modulus mu: E = 3 mu, nu = 1/2.
inline Mat3 incompressible_plane_stress(double shear_modulus)
{
  return isotropic_plane_stress(3 * shear_modulus, 0.5);
}

}  // namespace luff::shell
