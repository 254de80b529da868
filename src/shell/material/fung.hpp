// SPDX-License-Identifier: BSD-3-Clause
// Fung's exponential law of membranes.
#pragma once

#include "shell/material/guarded_exponential.hpp"

namespace luff::shell {

/// W = c/2 (e^Q - 1),  Q = E.A E, with E = (E_ff, E_cc, 2 E_fc) along and across the fibre [fung_1993_biomechanics,
/// tong_1976_stress].
struct Fung {
  double c = 0;           ///< [M/(L T^2)], > 0
  Mat3 A = Mat3::Zero();  ///< [-], symmetric, positive definite, in the frame of the fibre
  double largest_exponent = default_largest_exponent;

  double energy(const Vec3& E, const Fibre& a) const
  {
    const Vec3 e = to_fibre(a) * E;
    return 0.5 * c * GuardedExponential(e.dot(A * e), largest_exponent).value();
  }

  Response response(const Vec3& E, const Fibre& a) const
  {
    const Mat3 T = to_fibre(a);
    const Mat3 B = T.transpose() * A * T;
    const Vec3 q = B * E;
    return exponential_response(0.5 * c, {E.dot(q), 2 * q, 2 * B}, largest_exponent);
  }

  Vec3 stress(const Vec3& E, const Fibre& a) const { return response(E, a).stress; }
  Mat3 tangent(const Vec3& E, const Fibre& a) const { return response(E, a).tangent; }

  /// Of an isotropic material with Poisson's ratio 1/2 and the mean of the two normal moduli c A11 and c A22.
  Mat3 reference_moduli() const { return incompressible_plane_stress(c * (A(0, 0) + A(1, 1)) / 8); }

 private:
  /// Rotation of a strain into the frame of the fibre.
  static Mat3 to_fibre(const Fibre& a)
  {
    const double cc = a[0] * a[0], ss = a[1] * a[1], cs = a[0] * a[1];
    Mat3 T;
    T << cc, ss, cs, ss, cc, -cs, -2 * cs, 2 * cs, cc - ss;
    return T;
  }
};

}  // namespace luff::shell
