// SPDX-License-Identifier: BSD-3-Clause
// Amplitude and frequency of a signal that goes to and fro.
#pragma once

#include <optional>
#include <span>

namespace luff::output {

struct Oscillation {
  double peak_to_peak = 0;  ///< largest minus smallest value over the whole periods, unit of the signal
  double frequency = 0;     ///< periods per time [1/T]
  double mean = 0;          ///< over the whole periods, unit of the signal
  int periods = 0;          ///< whole ones in the window
};

/// From the times at which the signal rises through its mean, interpolated between samples; a rise counts once the
/// signal has been a twentieth of its range below the mean, so that ripples don't. Nothing when fewer than two periods
/// fit.
///
/// t increases and has as many values as x; only from <= t <= to counts.
std::optional<Oscillation> oscillation(std::span<const double> t, std::span<const double> x, double from, double to);

}  // namespace luff::output
