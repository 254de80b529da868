// SPDX-License-Identifier: BSD-3-Clause
// The exponential of tissue laws, kept from overflowing.
#pragma once

#include <cmath>

#include "shell/material/response.hpp"

namespace luff::shell {

/// Largest exponent that tissue laws evaluate as it stands: their stiffness has grown by e^10 = 22 000 there, beyond
/// what any tissue bears, while with e^20 a single step of a Newton iteration overflows.
inline constexpr double default_largest_exponent = 10;

/// f(Q) = e^Q - 1 up to Q_max; beyond, the quadratic with the same value, slope and curvature:
///
///   f = e^{Q_max} (1 + d + d^2/2) - 1,  d = Q - Q_max.
///
/// f, f' and f'' are continuous and positive, so that a convex Q gives a convex energy on both sides. Only the ratio of
/// stresses to their scale enters Q, so that the guard is the same in all units.
class GuardedExponential {
 public:
  GuardedExponential(double exponent, double largest)
      : exponent_(std::fmin(exponent, largest)), beyond_(exponent - exponent_)
  {
  }

  double value() const
  {
    // No digits cancel in expm1 near rest, and the added term is zero up to Q_max.
    return std::expm1(exponent_) + std::exp(exponent_) * beyond_ * (1 + 0.5 * beyond_);
  }
  double slope() const { return std::exp(exponent_) * (1 + beyond_); }
  double curvature() const { return std::exp(exponent_); }

 private:
  double exponent_;
  double beyond_;
};

/// An exponent Q with its derivatives in the strain.
struct Exponent {
  double value;
  Vec3 gradient;
  Mat3 hessian;
};

/// Stress and tangent of W = c f(Q): S = c f' Q', D = c (f'' Q' Q'^T + f' Q'').
inline Response exponential_response(double c, const Exponent& Q, double largest)
{
  const GuardedExponential f(Q.value, largest);
  return {c * f.slope() * Q.gradient,
          c * (f.curvature() * Q.gradient * Q.gradient.transpose() + f.slope() * Q.hessian)};
}

}  // namespace luff::shell
