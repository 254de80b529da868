// SPDX-License-Identifier: BSD-3-Clause
// What surrounds the structure: a flow, or nothing.
#pragma once

#include <memory>

#include "fluid/flow_solver.hpp"
#include "immersed/vertex_patches.hpp"
#include "simulation/clock.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// What the flow did in the last step.
struct FlowReport {
  int pressure_iterations = 0;  ///< of all coupling iterations together
  int momentum_iterations = 0;  ///< Krylov's, of an implicit scheme
  double divergence = 0.0;      ///< max |div U| h/|U|
};

/// The flow as the time loop sees it.  A structure alone is the same loop in empty surroundings.
class Surroundings {
 public:
  virtual ~Surroundings() = default;
  [[nodiscard]] virtual StepRates step_rates() const { return {}; }
  /// What does not depend on the sheets' current velocity; freezes their geometry.
  virtual void begin_step(const TimeStep&, const immersed::SheetMotion&) {}
  /// Forces on the vertices when the sheets move with these velocities.
  [[nodiscard]] virtual immersed::SheetLoads loads(std::span<const Vec3> sheet_velocity)
  {
    const std::vector<Vec3> none(sheet_velocity.size(), Vec3::Zero());
    return {none, none};
  }
  /// What the pressure alone does of that in the accepted step.  Halos of the flow are filled.
  [[nodiscard]] virtual fluid::PressureLoads pressure_loads() const { return {}; }
  virtual void accept() {}
  [[nodiscard]] virtual FlowReport report() const { return {}; }
  /// Null without a flow.
  [[nodiscard]] virtual fluid::FlowSolver* flow() { return nullptr; }
};

/// Corners of the box around a grid.
struct Reach {
  Vec3 low;
  Vec3 high;
};

class Flow : public Surroundings {
 public:
  /// `patches`: around the vertices of shells.  Throws RunError in begin_step() when a sheet leaves the box around the
  /// grid.  Collective.
  Flow(std::unique_ptr<grid::Grid> grid, std::unique_ptr<fluid::FlowSolver> solver, immersed::VertexPatches patches);
  [[nodiscard]] StepRates step_rates() const override
  {
    return {solver_->convective_rate(), solver_->diffusive_rate(), fluid::step_limits(solver_->options().scheme)};
  }
  void begin_step(const TimeStep& step, const immersed::SheetMotion& predicted) override;
  [[nodiscard]] immersed::SheetLoads loads(std::span<const Vec3> sheet_velocity) override;
  [[nodiscard]] fluid::PressureLoads pressure_loads() const override;
  void accept() override { solver_->accept(); }
  [[nodiscard]] FlowReport report() const override { return report_; }
  [[nodiscard]] fluid::FlowSolver* flow() override { return solver_.get(); }

 private:
  std::unique_ptr<grid::Grid> grid_;
  std::unique_ptr<fluid::FlowSolver> solver_;
  Reach reach_;
  immersed::VertexPatches patches_;  ///< of this step
  FlowReport report_;
};

}  // namespace luff::simulation
