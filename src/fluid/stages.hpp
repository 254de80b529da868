// SPDX-License-Identifier: BSD-3-Clause
// Stages of the flow's time schemes, and the steps that they bear.
#pragma once

#include <array>
#include <limits>
#include <span>

namespace luff::fluid {

/// How the velocity is carried over a step.
enum class TimeScheme {
  Rk3,           ///< explicit, Wray's three stages; only the diagonal of cut links is implicit
  NewtonKrylov,  ///< convection and diffusion implicit, Alexander's two stages; Newton steps without a Jacobian
};

/// One stage of a Runge-Kutta scheme; times and weights in parts of the step.
struct Stage {
  double new_rate;  ///< gamma, weight of N at `rate_time`
  double old_rate;  ///< zeta, weight of N of the stage before
  double wall;      ///< delta, weight of the terms of cut links at `end`
  double rate_time;
  double end;  ///< c
};

/// Wray's coefficients [spalart_1991_spectral]: delta = gamma + zeta.
inline constexpr std::array<Stage, 3> wray_stages{{{8.0 / 15.0, 0.0, 8.0 / 15.0, 0.0, 8.0 / 15.0},
                                                   {5.0 / 12.0, -17.0 / 60.0, 2.0 / 15.0, 8.0 / 15.0, 2.0 / 3.0},
                                                   {3.0 / 4.0, -5.0 / 12.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}}};

/// gamma = 1 - 1/sqrt 2: second order and L-stable [alexander_1977_diagonally].
inline constexpr double alexander_gamma = 0.29289321881345247560;

/// Alexander's stages, N at the end of each: du_1 = gamma dt N_1,  du_2 = (1 - gamma) dt N_1 + gamma dt N_2.
inline constexpr std::array<Stage, 2> alexander_stages{
    {{alexander_gamma, 0.0, alexander_gamma, alexander_gamma, alexander_gamma},
     {alexander_gamma, 0.0, alexander_gamma, 1.0, 1.0}}};

[[nodiscard]] inline std::span<const Stage> stages_of(TimeScheme scheme)
{
  if (scheme == TimeScheme::NewtonKrylov)
    return alexander_stages;
  return wray_stages;
}

/// Largest recommended sum_d |U_d| dt/h_d and nu dt sum_d 1/h_d^2 (docs/numerics/time-scheme.md).
struct StepLimits {
  double convective;
  double diffusive;
};

[[nodiscard]] constexpr StepLimits step_limits(TimeScheme scheme)
{
  if (scheme == TimeScheme::NewtonKrylov)
    return {5.0, std::numeric_limits<double>::infinity()};
  return {1.2, 0.5};
}

}  // namespace luff::fluid
