// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of a shell under slowly growing loads.
#include "shell/statics.hpp"

#include "core/error.hpp"

namespace luff::shell {

StaticStep solve_static(const Shell& shell, const std::vector<Load>& load_list, const StaticOptions& options,
                        const std::function<void(const StaticStep&)>& on_step)
{
  if (options.steps < 1)
    fail_input("shell \"{}\": static analysis with steps = {} must have at least 1", shell.name(), options.steps);
  const Loads loads(shell, load_list);
  KeptTangent tangent(shell, options.linear_solver);
  StaticStep now;
  now.positions = shell.reference_positions();
  for (now.step = 1; now.step <= options.steps; ++now.step) {
    const double factor = static_cast<double>(now.step) / options.steps;
    now.load_factor = factor;
    const Equilibrium equilibrium{
        .residual = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return factor * loads.force(x, options.time) - shell.internal_force(x);
        },
        .tangent =
            [&](const Eigen::VectorXd& x, BlockMatrix& K) {
              shell.add_tangent(x, K);
              loads.subtract_stiffness(x, options.time, factor, K);
            },
    };
    const std::string when = fmt::format("static step {} of {}, load factor {:.6g}", now.step, options.steps, factor);
    tangent.valid = false;
    now.report = newton(shell, equilibrium, options.newton, tangent, now.positions, when);
    now.folds = check_folds(shell, now.positions, when);
    if (on_step)
      on_step(now);
  }
  now.step = options.steps;
  return now;
}

}  // namespace luff::shell
