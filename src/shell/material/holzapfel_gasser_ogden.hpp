// SPDX-License-Identifier: BSD-3-Clause
// Holzapfel, Gasser and Ogden's law with two families of dispersed fibres, incompressible, in plane stress.
#pragma once

#include <array>
#include <cmath>

#include "shell/material/guarded_exponential.hpp"
#include "shell/material/invariants.hpp"

namespace luff::shell {

/// W = mu/2 (I1 - 3) + k1/(2 k2) sum_i (e^{k2 <F_i>^2} - 1),  F_i = kappa (I1 - 3) + (1 - 3 kappa)(I4_i - 1),
///
/// i = 1, 2: the families at +- angle to the fibre [holzapfel_2000_new, gasser_2006_hyperelastic]. <F> = max(F, 0): a
/// family carries tension only. At F = 0, as at rest, stresses are continuous, but the tangent jumps by
/// k1 F_i' F_i'^T; there it is that of tension.
struct HolzapfelGasserOgden {
  double shear_modulus = 0;  ///< mu [M/(L T^2)], > 0
  double k1 = 0;             ///< [M/(L T^2)], >= 0
  double k2 = 0;             ///< [-], > 0
  double dispersion = 0;     ///< kappa [-], 0 (all fibres alike) to 1/3 (no direction)
  double angle = 0;          ///< [rad]; 0: the two families are one of twice the weight
  double largest_exponent = default_largest_exponent;

  double energy(const Vec3& E, const Fibre& a) const
  {
    const double I = FirstInvariant(E).excess();
    double W = 0.5 * shear_modulus * I;
    for (const Fibre& b : families(a)) {
      const double F = std::fmax(dispersion * I + (1 - 3 * dispersion) * fibre_excess(E, b), 0);
      W += 0.5 * k1 / k2 * GuardedExponential(k2 * F * F, largest_exponent).value();
    }
    return W;
  }

  Response response(const Vec3& E, const Fibre& a) const
  {
    const FirstInvariant I1(E);
    const double I = I1.excess();
    const Vec3 i1 = I1.gradient();
    const Mat3 I1_hessian = I1.hessian();
    Response r{0.5 * shear_modulus * i1, 0.5 * shear_modulus * I1_hessian};
    for (const Fibre& b : families(a)) {
      const double F = dispersion * I + (1 - 3 * dispersion) * fibre_excess(E, b);
      if (F >= 0)
        add_family(F, dispersion * i1 + (1 - 3 * dispersion) * fibre_gradient(b), dispersion * I1_hessian, r);
    }
    return r;
  }

  Vec3 stress(const Vec3& E, const Fibre& a) const { return response(E, a).stress; }
  Mat3 tangent(const Vec3& E, const Fibre& a) const { return response(E, a).tangent; }
  /// Of the matrix between the fibres.
  Mat3 reference_moduli() const { return incompressible_plane_stress(shear_modulus); }

 private:
  std::array<Fibre, 2> families(const Fibre& a) const
  {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Fibre(c * a[0] - s * a[1], c * a[1] + s * a[0]), Fibre(c * a[0] + s * a[1], c * a[1] - s * a[0])};
  }

  /// Q = k2 F^2
  void add_family(double F, const Vec3& gradient, const Mat3& hessian, Response& r) const
  {
    const Exponent Q{k2 * F * F, 2 * k2 * F * gradient, 2 * k2 * (gradient * gradient.transpose() + F * hessian)};
    const Response family = exponential_response(0.5 * k1 / k2, Q, largest_exponent);
    r.stress += family.stress;
    r.tangent += family.tangent;
  }
};

}  // namespace luff::shell
