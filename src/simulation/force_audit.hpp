// SPDX-License-Identifier: BSD-3-Clause
// Forces on surfaces, by the traction on them and by the momentum of the fluid around them; work that the flow does on
// shells, as both sides count it.
#pragma once

#include <string>
#include <vector>

#include "fluid/flow_solver.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Of one surface in one step; with the surfaces whose surroundings touch its own, which no box of cells parts.
struct AuditedForce {
  Vec3 by_traction = Vec3::Zero();  ///< mean of both ends of the step [M L/T^2]
  Vec3 by_momentum = Vec3::Zero();  ///< mean over the step
};

/// What the audits of one surface come to.
struct AuditVerdict {
  Vec3 by_traction = Vec3::Zero();  ///< mean of all audits
  Vec3 by_momentum = Vec3::Zero();
  double scale = 0.0;      ///< root mean square of the force by momentum
  double mismatch = 0.0;   ///< |difference of the means|/scale
  double deviation = 0.0;  ///< root mean square of the difference/scale
  long audits = 0;
};

/// Balance of momentum in the box of cells that is `margin` cells wider than a surface, every few steps:
///
///   F = -rho { d/dt int u dV + sum_f [U u_f + p_f S_f - nu (grad u . S)_f] - int f dV },
///
/// for closed bodies without the momentum and the body force of the fluid that they displace.  The work that the flow
/// does on shells is int sum_v F_v . v_v dt, in every step.
class ForceAudit {
 public:
  static constexpr int margin = 4;  ///< cells

  ForceAudit(int every, const Structure& structure);

  /// Of an accepted step; one entry per surface where an audit is due, else none.  Collective.
  std::vector<AuditedForce> record(const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure);

  [[nodiscard]] std::vector<AuditVerdict> verdicts() const;
  /// Work that the flow has done on shells, by forces and velocities at the ends of steps [M L^2/T^2].
  [[nodiscard]] double flow_work() const { return flow_work_; }
  /// The same without signs: what goes to and fro between flow and shells.
  [[nodiscard]] double exchanged() const { return exchanged_; }

  /// Of the flow on all surfaces at the end of the last step [M L^2/T^3].
  [[nodiscard]] double power() const;

  /// Everything that a run has to go on with.
  [[nodiscard]] std::vector<double> numbers() const;
  void restore(const std::vector<double>& numbers);

 private:
  /// Of one surface at an instant.
  struct Instant {
    Vec3 force = Vec3::Zero();
    Vec3 displaced_momentum = Vec3::Zero();  ///< int u_b dV of a closed body [L^4/T]
    double power = 0.0;                      ///< of the flow on a shell
    Vec3 inner_force = Vec3::Zero();         ///< of the fluid inside of a skin on it
    double inner_power = 0.0;
  };
  struct Sums {
    Vec3 by_traction = Vec3::Zero();
    Vec3 by_momentum = Vec3::Zero();
    double square = 0.0;
    double square_of_difference = 0.0;
  };
  [[nodiscard]] std::vector<Instant> instants(const Structure& structure, const TimeStep& step) const;
  [[nodiscard]] std::vector<IndexBox> boxes(const fluid::FlowSolver& flow, const Structure& structure) const;
  [[nodiscard]] std::vector<AuditedForce> audit(const std::vector<Instant>& now, const TimeStep& step,
                                                fluid::FlowSolver& flow, const Structure& structure) const;
  [[nodiscard]] AuditedForce share(std::size_t surface, const Instant& now, const TimeStep& step,
                                   const fluid::FlowOptions& flow, const Structure& structure) const;

  int every_;
  std::vector<double> displaced_volume_;  ///< of closed bodies; 0 of other surfaces
  std::vector<Instant> before_;           ///< at the end of the step before; nothing at the start of a run
  std::vector<Sums> sums_;
  long audits_ = 0;
  double flow_work_ = 0.0;
  double exchanged_ = 0.0;
};

}  // namespace luff::simulation
