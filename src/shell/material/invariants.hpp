// SPDX-License-Identifier: BSD-3-Clause
// Strain invariants of a sheet in plane stress, with their derivatives in E = (E11, E22, 2 E12).
#pragma once

#include <cmath>
#include <limits>

#include "shell/material/response.hpp"

namespace luff::shell {

/// J = det C = C11 C22 - C12^2 with C = 1 + 2E, the squared ratio of areas. Not a number where C isn't positive
/// definite: there is no such sheet, and a solver that sees energies and forces that aren't finite takes a shorter
/// step.
class SquaredArea {
 public:
  explicit SquaredArea(const Vec3& E)
      : E_(E), excess_(2 * (E[0] + E[1]) + 4 * E[0] * E[1] - E[2] * E[2]), J_(1 + excess_)
  {
    if (!(J_ > 0 && 1 + 2 * E[0] > 0))
      J_ = std::numeric_limits<double>::quiet_NaN();
  }

  bool is_positive() const { return !std::isnan(J_); }
  double value() const { return J_; }
  /// J - 1, of which no digits cancel at small strain
  double excess() const { return excess_; }
  /// ln J, as exact
  double logarithm() const { return is_positive() ? std::log1p(excess_) : J_; }
  /// j = dJ/dE
  Vec3 gradient() const { return {2 + 4 * E_[1], 2 + 4 * E_[0], -2 * E_[2]}; }
  static Mat3 hessian()
  {
    Mat3 H;
    H << 0, 4, 0, 4, 0, 0, 0, 0, -2;
    return H;
  }

 private:
  Vec3 E_;
  double excess_;
  double J_;
};

/// I1 = C11 + C22 + 1/J, where C33 = 1/J keeps the volume. Written with d = J - 1, so that no digits cancel at small
/// strain. I1 is convex in E, infinite where C isn't positive definite.
class FirstInvariant {
 public:
  explicit FirstInvariant(const Vec3& E) : E_(E), area_(E) {}

  /// I1 - 3 = (2(E11 + E22) d - 4 E11 E22 + C12^2)/J >= 0
  double excess() const
  {
    if (!area_.is_positive())
      return std::numeric_limits<double>::infinity();
    return (2 * (E_[0] + E_[1]) * area_.excess() - 4 * E_[0] * E_[1] + E_[2] * E_[2]) / area_.value();
  }

  /// (2, 2, 0) - j/J^2
  Vec3 gradient() const
  {
    const double J = area_.value(), J_squared_less_one = area_.excess() * (2 + area_.excess());
    return 2 / (J * J) * Vec3(J_squared_less_one - 2 * E_[1], J_squared_less_one - 2 * E_[0], E_[2]);
  }

  /// 2 j j'/J^3 - J''/J^2
  Mat3 hessian() const
  {
    const double J = area_.value();
    const Vec3 j = area_.gradient();
    return 2 / (J * J * J) * (j * j.transpose()) - 1 / (J * J) * SquaredArea::hessian();
  }

 private:
  Vec3 E_;
  SquaredArea area_;
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
