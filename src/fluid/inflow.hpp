// SPDX-License-Identifier: BSD-3-Clause
// A flow rate through a side, and how it is spread over the section.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "fluid/section.hpp"

namespace luff::fluid {

/// Plug: the same everywhere.  Parabolic: the developed steady flow of the section, whatever its shape.  Womersley: the
/// developed periodic flow.
enum class FlowProfile { Plug, Parabolic, Womersley };

struct FlowRate {
  std::function<double(double t)> into;  ///< volume per time that enters the domain; negative: leaves it [L^3/T]
  bool constant = true;
  FlowProfile profile = FlowProfile::Plug;
  double period = 0.0;  ///< of `into`, for Womersley [T]
};

/// Normal velocities through the faces of a section, towards the inside, whose sum times the areas is the flow rate to
/// round-off.
///
/// Womersley's: with Q(t) = Q_0 + Re sum_n Q_n exp(i omega_n t), omega_n = 2 pi n/period,
///
///   w(t) = Q_0 w_0 + Re sum_n Q_n w_n exp(i omega_n t),   w_n = section.developed_flow(i omega_n/nu).
///
/// Harmonics below a millionth of the largest are left out; what they would carry goes with the last one kept.
class InflowProfile {
 public:
  /// Throws InputError when nothing holds the fluid along the rim of the section, which has no developed flow then, or
  /// when `into` isn't periodic though the profile needs it.
  InflowProfile(const Section& section, FlowRate rate, double viscosity);

  [[nodiscard]] bool constant() const { return rate_.constant; }
  /// At all faces of the section [L/T].
  [[nodiscard]] std::vector<double> velocities(double t) const;

 private:
  struct Harmonic {
    double omega = 0.0;
    std::complex<double> rate;
    std::vector<std::complex<double>> shape;
  };
  void add_harmonics(const Section& section, double viscosity);

  FlowRate rate_;
  std::vector<Harmonic> harmonics_;  ///< the steady one first
};

}  // namespace luff::fluid
