// SPDX-License-Identifier: BSD-3-Clause
// Strain invariants of an incompressible sheet in plane stress, with their derivatives in E = (E11, E22, 2 E12).
#pragma once

#include <cmath>
#include <limits>

#include "shell/material/response.hpp"

namespace luff::shell {

/// I1 = C11 + C22 + 1/J, where C = 1 + 2E, J = C11 C22 - C12^2 and C33 = 1/J keeps the volume. Written with
/// d = J - 1 = 2(E11 + E22) + 4 E11 E22 - C12^2, so that no digits cancel at small strain. I1 is convex in E.
///
/// Where C isn't positive definite there is no such sheet: I1 is infinite and its derivatives are not numbers, so that
/// a solver sees energies and forces that aren't finite and takes a shorter step.
class FirstInvariant {
 public:
  explicit FirstInvariant(const Vec3& E) : E_(E), d_(2 * (E[0] + E[1]) + 4 * E[0] * E[1] - E[2] * E[2]), J_(1 + d_)
  {
    if (!(J_ > 0 && 1 + 2 * E[0] > 0))
      J_ = std::numeric_limits<double>::quiet_NaN();
  }

  /// I1 - 3 = (2(E11 + E22) d - 4 E11 E22 + C12^2)/J >= 0
  double excess() const
  {
    if (std::isnan(J_))
      return std::numeric_limits<double>::infinity();
    return (2 * (E_[0] + E_[1]) * d_ - 4 * E_[0] * E_[1] + E_[2] * E_[2]) / J_;
  }

  /// (2, 2, 0) - j/J^2,  j = dJ/dE = (2 C22, 2 C11, -2 C12)
  Vec3 gradient() const
  {
    const double J_squared_less_one = d_ * (2 + d_);
    return 2 / (J_ * J_) * Vec3(J_squared_less_one - 2 * E_[1], J_squared_less_one - 2 * E_[0], E_[2]);
  }

  /// 2 j j'/J^3 - J''/J^2
  Mat3 hessian() const
  {
    const Vec3 j(2 + 4 * E_[1], 2 + 4 * E_[0], -2 * E_[2]);
    Mat3 H = 2 / (J_ * J_ * J_) * (j * j.transpose());
    const double inverse_square = 1 / (J_ * J_);
    H(0, 1) -= 4 * inverse_square;
    H(1, 0) -= 4 * inverse_square;
    H(2, 2) += 2 * inverse_square;
    return H;
  }

 private:
  Vec3 E_;
  double d_;
  double J_;
};

/// Derivative of I4 in E: i4 = (2 c^2, 2 s^2, 2 c s).
inline Vec3 fibre_gradient(const Fibre& a)
{
  return 2 * Vec3(a[0] * a[0], a[1] * a[1], a[0] * a[1]);
}

/// I4 - 1 = a.C a - 1 = i4.E, with I4 the squared stretch of the fibre.
inline double fibre_excess(const Vec3& E, const Fibre& a)
{
  return fibre_gradient(a).dot(E);
}

}  // namespace luff::shell
