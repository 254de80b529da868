// SPDX-License-Identifier: BSD-3-Clause
// The coupled time loop.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "coupling/acceleration.hpp"
#include "coupling/fixed_point.hpp"
#include "simulation/clock.hpp"
#include "simulation/structure.hpp"
#include "simulation/surroundings.hpp"

namespace luff::simulation {

enum class Scheme { Strong, Loose };

struct CouplingPolicy {
  Scheme scheme = Scheme::Strong;
  coupling::ConvergenceCriterion criterion;
  int halvings = 3;  ///< how often a step that does not converge is repeated with half its length
};

/// What the loop tells its observer after each accepted step.
struct StepRecord {
  TimeStep step;
  StepRates rates;  ///< of the flow at the start of the step
  coupling::FixedPointReport coupling;
  FlowReport flow;
  int halvings = 0;
  std::string trouble;  ///< why it was halved last; empty when it was not
};

/// Marches flow and structure from t = 0 to the end, strongly coupled, Dirichlet-Neumann: the flow sees the motion of
/// the sheets, the sheets see the traction of the flow (docs/numerics/coupling.md).
class Simulation {
 public:
  /// Called after each accepted step; false ends the run.
  using Observer = std::function<bool(const StepRecord&)>;

  Simulation(Clock clock, std::unique_ptr<Surroundings> surroundings, std::unique_ptr<Structure> structure,
             std::unique_ptr<coupling::Acceleration> acceleration, const CouplingPolicy& policy)
      : clock_(clock),
        surroundings_(std::move(surroundings)),
        structure_(std::move(structure)),
        acceleration_(std::move(acceleration)),
        policy_(policy)
  {
  }

  /// Throws RunError when a step cannot be made; the accepted state is still the last good one.
  void run(const Observer& observe);

  [[nodiscard]] const CouplingPolicy& policy() const { return policy_; }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] Clock& clock() { return clock_; }
  [[nodiscard]] coupling::Acceleration& acceleration() { return *acceleration_; }
  [[nodiscard]] Structure& structure() { return *structure_; }
  [[nodiscard]] Surroundings& surroundings() { return *surroundings_; }
  /// Seconds in the structure's solver since the last reset.
  [[nodiscard]] Profile& profile() { return profile_; }

 private:
  [[nodiscard]] std::optional<coupling::FixedPointReport> try_step(const TimeStep& step, Eigen::VectorXd& d);
  [[nodiscard]] coupling::FixedPointReport advance(const TimeStep& step, Eigen::VectorXd& d);
  [[nodiscard]] coupling::FixedPointReport advance_alone(const TimeStep& step, Eigen::VectorXd& d);
  [[nodiscard]] bool acceptable(const coupling::FixedPointReport& report) const;
  void reject(const TimeStep& step, const coupling::FixedPointReport& report);

  Clock clock_;
  std::unique_ptr<Surroundings> surroundings_;
  std::unique_ptr<Structure> structure_;
  std::unique_ptr<coupling::Acceleration> acceleration_;
  CouplingPolicy policy_;
  Eigen::VectorXd residual_;  ///< S(F(d)) - d of the last coupling iteration
  Profile profile_;
  std::string trouble_;
};

}  // namespace luff::simulation
