// SPDX-License-Identifier: BSD-3-Clause
// The ledger of the flow's kinetic energy.
#pragma once

#include <optional>
#include <vector>

#include "core/time_step.hpp"
#include "fluid/flow_energy.hpp"

namespace luff::simulation {

/// Means over a step of what changes the flow's energy [M L^2/T^3], and the energy at its end.
struct AuditedEnergy {
  double kinetic = 0.0;  ///< [M L^2/T^2]
  double growth = 0.0;   ///< dE/dt
  double dissipation = 0.0;
  double sides = 0.0;     ///< power of the sides of the domain on the fluid
  double surfaces = 0.0;  ///< power of shells and bodies on the fluid
  double body_force = 0.0;

  /// What the discretisation takes, or gives where it is negative.
  [[nodiscard]] double missing() const { return sides + surfaces + body_force - dissipation - growth; }
  /// What comes in, which is what goes out: half of all, without signs.
  [[nodiscard]] double turnover() const;
};

struct EnergyVerdict {
  AuditedEnergy mean;
  double mismatch = 0.0;   ///< |missing|/turnover, means of all audits
  double deviation = 0.0;  ///< root mean square of missing over that turnover
  long audits = 0;
};

/// Every few steps the growth of the energy over a step against the mean of the powers at its ends.
class EnergyAudit {
 public:
  explicit EnergyAudit(int every) : every_(every) {}

  /// Of an accepted step; nothing where none is due.  `power_on_surfaces`: of the flow on shells and bodies at its end.
  /// Halos filled by fill_halos().  Collective.
  std::optional<AuditedEnergy> record(const TimeStep& step, const fluid::FlowSolver& flow, double power_on_surfaces);
  [[nodiscard]] EnergyVerdict verdict() const;

  /// Everything that a run has to go on with; always as many numbers.
  [[nodiscard]] std::vector<double> numbers() const;
  static constexpr std::size_t size = 14;
  void restore(const double* numbers);

 private:
  /// At the end of a step.
  struct Instant {
    long step = 0;  ///< whose end it is; 0: none
    fluid::FlowEnergy flow;
    double surfaces = 0.0;
  };

  int every_;
  Instant before_;
  AuditedEnergy sum_;
  double square_ = 0.0;  ///< sum of missing^2
  long audits_ = 0;
};

}  // namespace luff::simulation
