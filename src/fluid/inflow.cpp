// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/inflow.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"

namespace luff::fluid {

namespace {

using Complex = std::complex<double>;

/// Samples of a period: harmonics up to 32 are free of aliases of those up to 96.
constexpr int samples = 128;
constexpr int most_harmonics = 32;

std::vector<Complex> plug(const Section& section)
{
  const std::vector<double>& areas = section.areas();
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  return std::vector<Complex>(areas.size(), 1.0 / whole);
}

/// Fourier coefficients Q_0 ... of one period of a function, Q(t) = Re sum_n Q_n exp(2 pi i n t/period).
std::vector<Complex> fourier_coefficients(const std::function<double(double)>& function, double period)
{
  std::vector<Complex> coefficients(most_harmonics + 1);
  for (int m = 0; m < samples; ++m) {
    const double value = function(period * m / samples);
    for (int n = 0; n <= most_harmonics; ++n)
      coefficients[n] +=
          (n == 0 ? 1.0 : 2.0) / samples * value * std::polar(1.0, -2.0 * std::numbers::pi * n * m / samples);
  }
  return coefficients;
}

}  // namespace

InflowProfile::InflowProfile(const Section& section, FlowRate rate, double viscosity) : rate_(std::move(rate))
{
  if (rate_.profile == FlowProfile::Plug) {
    harmonics_.push_back({0.0, {}, plug(section)});
    return;
  }
  if (!section.has_wall())
    fail_input(
        "no wall touches the rim of this side, so that its section has no developed flow: profile = \"plug\" is left, "
        "or a side next to it must be a wall");
  harmonics_.push_back({0.0, {}, section.developed_flow(0.0)});
  if (rate_.profile == FlowProfile::Womersley)
    add_harmonics(section, viscosity);
}

void InflowProfile::add_harmonics(const Section& section, double viscosity)
{
  const double T = rate_.period;
  const std::vector<Complex> coefficients = fourier_coefficients(rate_.into, T);
  double largest = 0.0;
  for (const Complex& Q : coefficients)
    largest = std::max(largest, std::abs(Q));
  for (const double t : {0.0, 0.3 * T}) {
    // A millionth: what the numbers of a file, written with six digits, can tell.
    const double change = std::abs(rate_.into(t + T) - rate_.into(t));
    if (change > 1e-6 * largest)
      fail_input("the flow rate is {:.6g} at t = {:.6g}, but {:.6g} one period of {:.6g} later: it must be periodic",
                 rate_.into(t), t, rate_.into(t + T), T);
  }
  harmonics_.front().rate = coefficients[0];
  for (int n = 1; n <= most_harmonics; ++n) {
    if (std::abs(coefficients[n]) <= 1e-6 * largest)
      continue;
    const double omega = 2.0 * std::numbers::pi * n / T;
    harmonics_.push_back({omega, coefficients[n], section.developed_flow(Complex(0.0, omega / viscosity))});
  }
}

std::vector<double> InflowProfile::velocities(double t) const
{
  std::vector<double> w(harmonics_.front().shape.size(), 0.0);
  double carried = 0.0;
  for (std::size_t n = 0; n < harmonics_.size(); ++n) {
    const Harmonic& harmonic = harmonics_[n];
    Complex amplitude = harmonic.rate * std::polar(1.0, harmonic.omega * t);
    if (n + 1 == harmonics_.size())
      amplitude += rate_.into(t) - carried - amplitude.real();
    carried += amplitude.real();
    for (std::size_t f = 0; f < w.size(); ++f)
      w[f] += (amplitude * harmonic.shape[f]).real();
  }
  return w;
}

}  // namespace luff::fluid
