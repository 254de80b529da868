// SPDX-License-Identifier: BSD-3-Clause
// Static analysis in which a displacement is prescribed and the load follows.
#include <cmath>

#include "core/error.hpp"
#include "shell/path_following.hpp"
#include "shell/proportional_load.hpp"
#include "shell/step_length.hpp"

namespace luff::shell {

namespace {

class DisplacementPath {
 public:
  DisplacementPath(const Shell& shell, const std::vector<Load>& loads, const ControlledDisplacement& controlled,
                   const StaticOptions& options)
      : controlled_(controlled),
        options_(options),
        problem_(shell, loads, options.time),
        tangent_(shell, LinearSolverKind::Direct),
        length_(1.0 / options.steps, options.max_halvings)
  {
    now_.positions = shell.reference_positions();
    if (options.from)
      go_on(*options.from);
  }

  const StaticStep& now() const { return now_; }

  /// The equilibrium at step / steps of the displacement.
  const StaticStep& reach(int step)
  {
    now_.step = step;
    now_.iterations = 0;
    const double mark = static_cast<double>(step) / options_.steps;
    while (part_ < mark)
      advance(length_.end(part_, mark));
    now_.folds = check_folds(problem_.shell(), now_.positions, options_.fold_limit, when(mark));
    now_.control = {.length = length_.now(), .successes = length_.successes()};
    return now_;
  }

 private:
  void go_on(const PathPoint& from)
  {
    set_equilibrium(from, now_);
    length_.restore(from.control.length, from.control.successes);
    part_ = static_cast<double>(now_.step) / options_.steps;
  }

  /// To this part of the displacement, or nowhere with a shorter step for the next attempt.
  void advance(double part)
  {
    Eigen::VectorXd x = now_.positions;
    double factor = now_.load_factor;
    try {
      now_.report = solve(x, factor, part);
      if (has_jumped(now_.positions, x, (part - part_) * path_tangent(x),
                     options_.newton.round_off * problem_.shell().size()))
        fail_to_converge("{}: shell '{}' has no equilibrium near", when(part), problem_.shell().name());
    } catch (const RunError& error) {
      if (length_.halve())
        return;
      fail_to_converge(
          "{}. Where the path snaps back in the controlled displacement, use analysis = \"arc-length\" or control "
          "another "
          "displacement",
          error.what());
    }
    now_.iterations += now_.report.iterations;
    now_.positions = x;
    now_.load_factor = factor;
    part_ = part;
    length_.succeeded();
  }

  /// Newton's method for x and the load factor, the border of the tangent eliminated: with the mean displacement q(u)
  /// and its prescribed value,
  ///
  ///   increment of x = K^-1 r + d K^-1 f,        q(x + increment - X) = prescribed.
  NewtonReport solve(Eigen::VectorXd& x, double& factor, double part)
  {
    const double prescribed = part * controlled_.end;
    Equilibrium equilibrium = problem_.equilibrium(factor);
    equilibrium.increment = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& r, LinearSolver& solver) {
      const Eigen::VectorXd by_residual = solver.solve(r), by_load = solver.solve(problem_.load(y));
      const Eigen::VectorXd u = y - problem_.shell().reference_positions();
      const double increment = (prescribed - mean(u) - mean(by_residual)) / mean(by_load);
      if (!std::isfinite(increment))
        fail_run("the loads don't move the controlled displacement; control one that they move");
      factor += increment;
      return Eigen::VectorXd(by_residual + increment * by_load);
    };
    tangent_.valid = false;
    return newton(problem_.shell(), equilibrium, options_.newton, tangent_, x, when(part));
  }

  /// d x / d part along the path, with the last tangent.
  Eigen::VectorXd path_tangent(const Eigen::VectorXd& x) const
  {
    const Eigen::VectorXd by_load = tangent_.solver->solve(problem_.load(x));
    return controlled_.end / mean(by_load) * by_load;
  }

  double mean(const Eigen::VectorXd& u) const
  {
    double sum = 0;
    for (const int v : controlled_.vertices)
      sum += u[3 * v + controlled_.component];
    return sum / static_cast<double>(controlled_.vertices.size());
  }

  std::string when(double part) const
  {
    return fmt::format("displacement step {} of {}, displacement {:.6g}, load factor {:.6g}", now_.step, options_.steps,
                       part * controlled_.end, now_.load_factor);
  }

  const ControlledDisplacement& controlled_;
  const StaticOptions& options_;
  ProportionalLoad problem_;
  KeptTangent tangent_;
  StepLength length_;
  double part_ = 0;  ///< of the displacement reached
  StaticStep now_;
};

}  // namespace

void check_controllable(const Shell& shell, const ControlledDisplacement& controlled)
{
  if (controlled.vertices.empty() || controlled.component < 0 || controlled.component > 2 || controlled.end == 0 ||
      !std::isfinite(controlled.end))
    fail_input(
        "shell '{}': displacement control needs at least one vertex, component 0, 1 or 2 and a displacement that is "
        "not "
        "0; it has {} vertices, component {}, displacement {}",
        shell.name(), controlled.vertices.size(), controlled.component, controlled.end);
  for (const int v : controlled.vertices) {
    if (v < 0 || v >= shell.n_vertices())
      fail_input("shell '{}': displacement control of vertex {}, not in 0..{}", shell.name(), v,
                 shell.n_vertices() - 1);
    if (shell.held()[3 * v + controlled.component])
      fail_input("shell '{}': the controlled displacement {} of vertex {} is held by a support; control a free one",
                 shell.name(), "xyz"[controlled.component], v);
  }
}

StaticStep control_displacement(const Shell& shell, const std::vector<Load>& loads,
                                const ControlledDisplacement& controlled, const StaticOptions& options,
                                const OnStaticStep& on_step)
{
  check_static(shell, options);
  check_supports_rest(shell, "displacement-control");
  check_controllable(shell, controlled);
  DisplacementPath path(shell, loads, controlled, options);
  StaticStep last = path.now();
  for (int step = path.now().step + 1; step <= options.steps; ++step) {
    last = path.reach(step);
    if (on_step)
      on_step(last);
  }
  return last;
}

}  // namespace luff::shell
