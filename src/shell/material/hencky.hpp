// SPDX-License-Identifier: BSD-3-Clause
// Hencky's law: energy quadratic in the logarithmic strain.
#pragma once

#include <cmath>

#include "shell/material/invariants.hpp"

namespace luff::shell {

/// W = K/2 (ln U1 + ln U2)^2 + G/2 (ln U1 - ln U2)^2,  K = E/(2(1 - nu)),  G = E/(2(1 + nu)),
///
/// with the principal stretches U1, U2: the plane stress of G |dev ln U|^2 + k/2 (tr ln U)^2 [hencky_1928_form,
/// anand_1979_hencky]. In the frame of the triangle, with J = det C and y = ((C11 - C22)^2/4 + C12^2)/J,
///
///   W = K/8 (ln J)^2 + G/2 f(y),  f(y) = asinh^2(sqrt(y)) = (ln U1 - ln U2)^2,
///
/// where f is smooth at equal stretches, y = 0. A stress one way, E ln U/U per reference area, grows without bound in
/// compression and has its largest value at U = e in tension. Where C isn't positive definite W is infinite, stress and
/// tangent are not numbers.
struct Hencky {
  double young = 0;    ///< E [M/(L T^2)], > 0
  double poisson = 0;  ///< nu [-], -1 < nu <= 1/2

  double energy(const Vec3& E, const Fibre&) const
  {
    const SquaredArea J(E);
    if (!J.is_positive())
      return std::numeric_limits<double>::infinity();
    const double log_J = J.logarithm(), difference = Distortion(E, J).difference;
    return 0.125 * areal_modulus() * log_J * log_J + 0.5 * shear_modulus() * difference * difference;
  }

  Response response(const Vec3& E, const Fibre&) const
  {
    const SquaredArea J(E);
    const Distortion shape(E, J);
    const double K_4 = 0.25 * areal_modulus(), G_2 = 0.5 * shear_modulus(), log_J = J.logarithm();
    const Vec3 j = J.gradient() / J.value(), g = shape.gradient();
    const Mat3 areal = (1 - log_J) * (j * j.transpose()) + log_J / J.value() * SquaredArea::hessian();
    const Mat3 shear = shape.curvature() * (g * g.transpose()) + shape.slope() * shape.hessian();
    return {K_4 * log_J * j + G_2 * shape.slope() * g, K_4 * areal + G_2 * shear};
  }

  Vec3 stress(const Vec3& E, const Fibre& a) const { return response(E, a).stress; }
  Mat3 tangent(const Vec3& E, const Fibre& a) const { return response(E, a).tangent; }
  Mat3 reference_moduli() const { return isotropic_plane_stress(young, poisson); }

 private:
  /// y = r^2/J,  r^2 = (E11 - E22)^2 + C12^2, with its derivatives in E and those of f in y.
  struct Distortion {
    Vec3 of_r;  ///< derivative of r^2
    SquaredArea J;
    double y;
    double difference;  ///< ln U1 - ln U2 >= 0

    Distortion(const Vec3& E, const SquaredArea& squared_area)
        : of_r(2 * (E[0] - E[1]), 2 * (E[1] - E[0]), 2 * E[2]), J(squared_area)
    {
      y = ((E[0] - E[1]) * (E[0] - E[1]) + E[2] * E[2]) / J.value();
      difference = std::asinh(std::sqrt(y));
    }

    /// ((r^2)' - y j)/J
    Vec3 gradient() const { return (of_r - y * J.gradient()) / J.value(); }

    /// ((r^2)'' - y J'' - j y'' - y' j')/J
    Mat3 hessian() const
    {
      Mat3 of_r_twice;
      of_r_twice << 2, -2, 0, -2, 2, 0, 0, 0, 2;
      const Mat3 product = J.gradient() * gradient().transpose();
      return (of_r_twice - y * SquaredArea::hessian() - product - product.transpose()) / J.value();
    }

    /// f' = asinh(sqrt(y))/sqrt(y (1 + y))
    double slope() const { return y == 0 ? 1 : difference / std::sqrt(y * (1 + y)); }

    /// f'' = (1 - (1 + 2y) f')/(2y (1 + y)) = -2/3 + 16/15 y - ... The tangent has it times y'y' ~ y, so that neither
    /// the digits lost above the bound nor the terms left out below it reach 1e-15 of the tangent.
    double curvature() const
    {
      constexpr double bound = 1e-5;
      return y < bound ? -2.0 / 3 + 16.0 / 15 * y : (1 - (1 + 2 * y) * slope()) / (2 * y * (1 + y));
    }
  };

  double areal_modulus() const { return young / (2 * (1 - poisson)); }
  double shear_modulus() const { return young / (2 * (1 + poisson)); }
};

}  // namespace luff::shell
