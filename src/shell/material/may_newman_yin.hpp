// SPDX-License-Identifier: BSD-3-Clause
// May-Newman and Yin's law of valve leaflets, incompressible, in plane stress.
#pragma once

#include "shell/material/guarded_exponential.hpp"
#include "shell/material/invariants.hpp"

namespace luff::shell {

/// W = c0 (e^Q - 1) + c10 (I1 - 3),  Q = c1 (I1 - 3)^2 + c2 (alpha - 1)^4,  alpha = sqrt(I4) the fibre's stretch
/// [maynewman_1998_constitutive]; the term with c10 is ours.
///
/// With c10 = 0 stress AND stiffness are zero at rest: a static analysis cannot start there.
struct MayNewmanYin {
  double c0 = 0;              ///< [M/(L T^2)], > 0
  double c1 = 0;              ///< [-], >= 0
  double c2 = 0;              ///< [-], >= 0
  double c10 = 0;             ///< [M/(L T^2)], >= 0: half the shear modulus at rest
  bool tension_only = false;  ///< fibres carry no compression
  double largest_exponent = default_largest_exponent;

  double energy(const Vec3& E, const Fibre& a) const
  {
    const double I = FirstInvariant(E).excess(), s = lengthening(E, a);
    return c0 * GuardedExponential(c1 * I * I + c2 * s * s * s * s, largest_exponent).value() + c10 * I;
  }

  Response response(const Vec3& E, const Fibre& a) const
  {
    const FirstInvariant I1(E);
    const Vec3 i1 = I1.gradient();
    const Mat3 I1_hessian = I1.hessian();
    Response r =
        exponential_response(c0, exponent(I1.excess(), i1, I1_hessian, lengthening(E, a), a), largest_exponent);
    r.stress += c10 * i1;
    r.tangent += c10 * I1_hessian;
    return r;
  }

  Vec3 stress(const Vec3& E, const Fibre& a) const { return response(E, a).stress; }
  Mat3 tangent(const Vec3& E, const Fibre& a) const { return response(E, a).tangent; }

  /// Of an isotropic material with shear modulus 2 (c10 + c0 c1): that of the law at rest and, since it may be zero,
  /// what the exponential's isotropic part grows to when I1 - 3 is of order one.
  Mat3 reference_moduli() const { return incompressible_plane_stress(2 * (c10 + c0 * c1)); }

 private:
  /// alpha - 1 = (I4 - 1)/(alpha + 1)
  double lengthening(const Vec3& E, const Fibre& a) const
  {
    const double I4_less_one = fibre_excess(E, a);
    if (tension_only && I4_less_one <= 0)
      return 0;
    return I4_less_one / (std::sqrt(1 + I4_less_one) + 1);
  }

  /// Q_1 = 2 c1 (I1 - 3), Q_11 = 2 c1, Q_4 = 2 c2 (alpha - 1)^3/alpha, Q_44 = c2 (alpha - 1)^2 (2 alpha + 1)/alpha^3
  Exponent exponent(double I, const Vec3& i1, const Mat3& I1_hessian, double s, const Fibre& a) const
  {
    const double alpha = 1 + s;
    const double Q4 = 2 * c2 * s * s * s / alpha;
    const double Q44 = c2 * s * s * (2 * alpha + 1) / (alpha * alpha * alpha);
    const Vec3 i4 = fibre_gradient(a);
    return {c1 * I * I + c2 * s * s * s * s, 2 * c1 * I * i1 + Q4 * i4,
            2 * c1 * (i1 * i1.transpose() + I * I1_hessian) + Q44 * i4 * i4.transpose()};
  }
};

}  // namespace luff::shell
