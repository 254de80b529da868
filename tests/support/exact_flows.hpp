// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions of the Navier-Stokes equations.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid/flow_solver.hpp"

namespace luff::test {

/// Taylor-Green's vortices in planes normal to z, carried by a uniform stream; unsteady.  The period
/// along x and y is 2 pi/k.
struct TaylorGreen {
  double viscosity = 0.0;
  Vec3 stream{0.0, 0.0, 0.0};
  double k = 2.0 * std::numbers::pi;

  [[nodiscard]] Vec3 velocity(const Vec3& x, double t) const
  {
    const double decay = std::exp(-2.0 * viscosity * k * k * t);
    const Vec3 X = x - stream * t;
    return stream +
           decay * Vec3(-std::cos(k * X[0]) * std::sin(k * X[1]), std::sin(k * X[0]) * std::cos(k * X[1]), 0.0);
  }
  [[nodiscard]] double pressure(const Vec3& x, double t) const
  {
    const double decay = std::exp(-4.0 * viscosity * k * k * t);
    const Vec3 X = x - stream * t;
    return -0.25 * decay * (std::cos(2.0 * k * X[0]) + std::cos(2.0 * k * X[1]));
  }
  [[nodiscard]] fluid::VectorFunction function() const
  {
    return {[*this](const Vec3& x, double t) { return velocity(x, t); }, false};
  }
};

/// Kovasznay's steady flow behind a row of cylinders, Re = 40 [kovasznay_1948_laminar].
struct Kovasznay {
  double reynolds = 40.0;
  double lambda = 0.5 * reynolds - std::sqrt(0.25 * reynolds * reynolds + 4.0 * std::pow(std::numbers::pi, 2));

  [[nodiscard]] Vec3 velocity(const Vec3& x) const
  {
    constexpr double turn = 2.0 * std::numbers::pi;
    const double e = std::exp(lambda * x[0]);
    return {1.0 - e * std::cos(turn * x[1]), lambda / turn * e * std::sin(turn * x[1]), 0.0};
  }
  [[nodiscard]] double pressure(const Vec3& x) const { return -0.5 * std::exp(2.0 * lambda * x[0]); }
};

/// Ethier and Steinman's fully three-dimensional decaying flow [ethier_1994_exact].
struct EthierSteinman {
  double viscosity = 0.0;
  double a = std::numbers::pi / 4.0;
  double d = std::numbers::pi / 2.0;

  [[nodiscard]] Vec3 velocity(const Vec3& x, double t) const
  {
    Vec3 u;
    for (int c = 0; c < 3; ++c) {
      const double X = x[c];
      const double Y = x[(c + 1) % 3];
      const double Z = x[(c + 2) % 3];
      u[c] = -a * (std::exp(a * X) * std::sin(a * Y + d * Z) + std::exp(a * Z) * std::cos(a * X + d * Y));
    }
    return std::exp(-viscosity * d * d * t) * u;
  }
  [[nodiscard]] double pressure(const Vec3& x, double t) const
  {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double X = x[c];
      const double Y = x[(c + 1) % 3];
      const double Z = x[(c + 2) % 3];
      sum += std::exp(2.0 * a * X) + 2.0 * std::sin(a * X + d * Y) * std::cos(a * Z + d * X) * std::exp(a * (Y + Z));
    }
    return -0.5 * a * a * sum * std::exp(-2.0 * viscosity * d * d * t);
  }
  [[nodiscard]] fluid::VectorFunction function() const
  {
    return {[*this](const Vec3& x, double t) { return velocity(x, t); }, false};
  }
};

}  // namespace luff::test
