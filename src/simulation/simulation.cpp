// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulation.hpp"

#include <utility>

#include "core/error.hpp"

namespace luff::simulation {

void Simulation::run(const Observer& observe)
{
  bool wanted = true;
  while (wanted && !clock_.finished()) {
    const StepRates rates = surroundings_->step_rates();
    const TimeStep step = clock_.next(rates);       // t^n -> t^{n+1}
    Eigen::VectorXd d = structure_->predict(step);  // d^0
    const std::optional<coupling::FixedPointReport> outcome = try_step(step, d);
    if (!outcome)
      continue;
    const int halvings = clock_.rejections();
    const std::string trouble = std::exchange(trouble_, {});
    structure_->accept(step, d);  // may find the shell folded
    surroundings_->accept();
    clock_.accept(step);
    wanted = observe({step, rates, *outcome, surroundings_->report(), halvings, trouble});
  }
}

/// The outcome of a step, or nothing when it must be repeated with half its length.
std::optional<coupling::FixedPointReport> Simulation::try_step(const TimeStep& step, Eigen::VectorXd& d)
{
  try {
    const coupling::FixedPointReport report = advance(step, d);
    if (acceptable(report))
      return report;
    reject(step, report);
  } catch (const NonConvergence& error) {  // of the shell or the pressure, inside a coupling iteration
    const bool loose = policy_.scheme == Scheme::Loose && surroundings_->flow() != nullptr;
    if (loose || d.size() == 0 || clock_.rejections() >= policy_.halvings)
      throw;
    acceleration_->end_step(/*converged=*/false);
    trouble_ = error.what();
    clock_.reject();
  }
  return std::nullopt;
}

/// Loose coupling takes one iteration for what it is; a value that is no number is never taken.
bool Simulation::acceptable(const coupling::FixedPointReport& report) const
{
  return report.converged() ||
         (policy_.scheme == Scheme::Loose && report.outcome != coupling::FixedPointOutcome::NotFinite);
}

/// Without a flow the first solution is the last.
coupling::FixedPointReport Simulation::advance_alone(const TimeStep& step, Eigen::VectorXd& d)
{
  const immersed::SheetLoads none = surroundings_->loads(structure_->velocity(d, step));
  const auto timer = profile_.time(Phase::Shell);
  d = structure_->solve(step, none, d);
  return {.outcome = coupling::FixedPointOutcome::Converged, .iterations = 1, .residual = 0.0, .history = {0.0}};
}

/// The fixed point d = S(F(d)) of one step, from the accepted states of flow and structure.
coupling::FixedPointReport Simulation::advance(const TimeStep& step, Eigen::VectorXd& d)
{
  if (surroundings_->flow() == nullptr)
    return advance_alone(step, d);
  surroundings_->begin_step(step, structure_->motion(d, step));  // the geometry stays frozen at d^0
  const coupling::InterfaceMap flow_then_structure = [&](const Eigen::VectorXd& guess) {
    const immersed::SheetLoads loads = surroundings_->loads(structure_->velocity(guess, step));  // F
    const auto timer = profile_.time(Phase::Shell);
    Eigen::VectorXd image = structure_->solve(step, loads, guess);  // S
    residual_ = image - guess;
    return image;
  };
  return coupling::solve_fixed_point(flow_then_structure, d, *acceleration_, policy_.criterion,
                                     coupling::displacement_norm(structure_->length()));
}

void Simulation::reject(const TimeStep& step, const coupling::FixedPointReport& report)
{
  if (clock_.rejections() >= policy_.halvings || report.outcome == coupling::FixedPointOutcome::NotFinite)
    fail_run(
        "step {}, t = {:.6g}: the coupling of flow and structure did not converge: residual {:.2e} after {} iterations "
        "(tolerance {:.1e}), largest at {}, the step halved {} times; a smaller time.step, coupling.acceleration = "
        "\"aitken\" with a smaller coupling.relaxation, or more coupling.max_iterations may help",
        step.index, step.t_new, report.residual, report.iterations, policy_.criterion.tolerance,
        structure_->place_of(residual_), clock_.rejections());
  trouble_ = fmt::format("the coupling's residual was {:.2e} after {} iterations", report.residual, report.iterations);
  clock_.reject();
}

}  // namespace luff::simulation
