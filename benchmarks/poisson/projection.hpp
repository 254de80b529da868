// SPDX-License-Identifier: BSD-3-Clause
// Projections by luff, timed.
#pragma once

#include <algorithm>
#include <memory>

#include "poisson/flow.hpp"

namespace luff::benchmark {

constexpr double reduction = 1e-10;

struct Timing {
  int iterations = 0;
  double set_up = 1e30;
  double solve = 1e30;
  bool converged = false;
};

/// Set-up is the change from no sheet to the sheet.
class Luff {
 public:
  explicit Luff(const Flow& flow) : flow_(flow), solver_(poisson::make_pressure_solver(flow.grid, flow.sides)) {}

  void run(Timing& best)
  {
    Field3<double> U = flow_.U;
    Field<double> p(flow_.grid.owned());
    solver_->set_blocked({});
    const double start = thread_time();
    solver_->set_blocked(flow_.blocked);
    const double ready = thread_time();
    const auto report = solver_->project(views(U), p.view(), 1.0, {.relative = reduction});
    const double done = thread_time();
    best.set_up = std::min(best.set_up, ready - start);
    best.solve = std::min(best.solve, done - ready);
    best.iterations = report.iterations;
    best.converged = report.converged;
  }

 private:
  const Flow& flow_;
  std::unique_ptr<poisson::PressureSolver> solver_;
};

}  // namespace luff::benchmark
