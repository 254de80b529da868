// SPDX-License-Identifier: BSD-3-Clause
// Forces of the flow at the ends of steps, known when the next step is done.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "output/csv.hpp"
#include "simulation/simulation.hpp"

namespace luff::simulation {

/// Per vertex, of an accepted step, as the sheets feel them [M L/T^2].
struct StepLoads {
  immersed::SheetLoads at_end;           ///< with the pressure extrapolated to the end of the step
  immersed::SheetLoads pressure_at_end;  ///< what the pressure does of that
  immersed::SheetLoads pressure;         ///< what it does in the middle of the step, where it is solved for
};

/// Halos of the flow are filled.  Collective.
[[nodiscard]] StepLoads loads_of_step(Simulation& simulation);

/// Sums over loads at the end t^n of a step.  The pressure is solved for in the middle of steps, so that its part P is
/// known at t^n when the next step is done,
///
///   L^n = F^n + (dt' P^{n-1/2} + dt P^{n+1/2})/(dt + dt'),   dt = t^n - t^{n-1}, dt' = t^{n+1} - t^n,
///
/// F^n the sums without pressure.  Extrapolation, which sheets have to be content with, takes 3/2 and -1/2 of two
/// pressures, with three times the error, and makes what is not smooth in time half as large again.
class LateSums {
 public:
  LateSums() = default;
  /// The sums over loads_of_step(), each the same list.
  LateSums(const TimeStep& step, std::vector<double> at_end, const std::vector<double>& pressure_at_end,
           std::vector<double> pressure);

  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] std::vector<double> interpolated(const TimeStep& next, std::span<const double> next_pressure) const;
  [[nodiscard]] const std::vector<double>& extrapolated() const { return at_end_; }

  /// Everything as one list, from which the same comes back; nothing from an empty one.
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] static std::optional<LateSums> of(std::span<const double> numbers);

 private:
  double t_ = 0.0;
  double dt_ = 0.0;
  std::vector<double> at_end_;
  std::vector<double> rest_;  ///< F^n
  std::vector<double> pressure_;
};

}  // namespace luff::simulation
