// SPDX-License-Identifier: BSD-3-Clause
// Lee and Sacks' law of pericardium and valve leaflets, incompressible, in plane stress.
#pragma once

#include "shell/material/guarded_exponential.hpp"
#include "shell/material/invariants.hpp"

namespace luff::shell {

/// W = c0/2 (I1 - 3) + c1/2 [w e^{c2 (I1 - 3)^2} + (1 - w) e^{c3 (I4 - 1)^2} - 1]  [lee_2014_inverse;
/// wu_2018_anisotropic].
struct LeeSacks {
  double c0 = 0;              ///< shear modulus at rest of the isotropic part [M/(L T^2)], > 0
  double c1 = 0;              ///< [M/(L T^2)], >= 0
  double c2 = 0;              ///< [-], >= 0
  double c3 = 0;              ///< [-], >= 0
  double weight = 1;          ///< w [-], 0 <= w <= 1; 1: isotropic
  bool tension_only = false;  ///< fibres carry no compression; the tangent jumps where I4 passes 1
  double largest_exponent = default_largest_exponent;

  double energy(const Vec3& E, const Fibre& a) const
  {
    const double I = FirstInvariant(E).excess(), F = fibre_part(E, a);
    return 0.5 * c0 * I + 0.5 * c1 *
                              (weight * GuardedExponential(c2 * I * I, largest_exponent).value() +
                               (1 - weight) * GuardedExponential(c3 * F * F, largest_exponent).value());
  }

  Response response(const Vec3& E, const Fibre& a) const
  {
    const FirstInvariant I1(E);
    const double I = I1.excess();
    const Vec3 i1 = I1.gradient();
    const Mat3 I1_hessian = I1.hessian();
    const Exponent isotropic{c2 * I * I, 2 * c2 * I * i1, 2 * c2 * (i1 * i1.transpose() + I * I1_hessian)};
    Response r = exponential_response(0.5 * c1 * weight, isotropic, largest_exponent);
    r.stress += 0.5 * c0 * i1;
    r.tangent += 0.5 * c0 * I1_hessian;
    if (weight < 1)
      add_fibre(E, a, r);
    return r;
  }

  Vec3 stress(const Vec3& E, const Fibre& a) const { return response(E, a).stress; }
  Mat3 tangent(const Vec3& E, const Fibre& a) const { return response(E, a).tangent; }
  /// Of the isotropic part at rest.
  Mat3 reference_moduli() const { return incompressible_plane_stress(c0); }

 private:
  double fibre_part(const Vec3& E, const Fibre& a) const
  {
    const double F = fibre_excess(E, a);
    return tension_only && F < 0 ? 0 : F;
  }

  void add_fibre(const Vec3& E, const Fibre& a, Response& r) const
  {
    const double F = fibre_excess(E, a);
    if (tension_only && F < 0)
      return;
    const Vec3 i4 = fibre_gradient(a);
    const Response fibre = exponential_response(
        0.5 * c1 * (1 - weight), {c3 * F * F, 2 * c3 * F * i4, 2 * c3 * i4 * i4.transpose()}, largest_exponent);
    r.stress += fibre.stress;
    r.tangent += fibre.tangent;
  }
};

}  // namespace luff::shell
