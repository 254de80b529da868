// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of a shell under slowly growing loads.
#include "shell/statics.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/error.hpp"
#include "shell/proportional_load.hpp"
#include "shell/settling.hpp"
#include "shell/step_length.hpp"
#include "shell/vertex_areas.hpp"

namespace luff::shell {

namespace {

/// The three translations and three small rotations about the centre, columns of unit length.
Eigen::Matrix<double, Eigen::Dynamic, 6> rigid_motions(const Shell& shell)
{
  const auto& X = shell.reference().vertices;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : X)
    centre += x / static_cast<double>(X.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> R(3 * X.size(), 6);
  for (std::size_t v = 0; v < X.size(); ++v)
    for (int d = 0; d < 3; ++d) {
      R.block<3, 1>(3 * v, d) = Vec3::Unit(d);
      R.block<3, 1>(3 * v, 3 + d) = Vec3::Unit(d).cross(X[v] - centre);
    }
  R.colwise().normalize();
  return R;
}

/// Follows the equilibrium as the load factor grows.
class LoadPath {
 public:
  LoadPath(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options)
      : options_(options),
        problem_(shell, loads, options.time),
        tangent_(shell, options.linear_solver),
        length_(1.0 / options.steps,
                options.stabilisation == Stabilisation::Damping ? few_halvings : options.max_halvings)
  {
    now_.positions = shell.reference_positions();
    if (options.contact)
      start_contact(*options.contact);
    if (options.from)
      go_on(*options.from);
  }

  const StaticStep& now() const { return now_; }

  /// The equilibrium at load factor step / steps.
  const StaticStep& reach(int step)
  {
    now_.step = step;
    now_.iterations = now_.damped_iterations = 0;
    const double mark = static_cast<double>(step) / options_.steps;
    while (now_.load_factor < mark)
      advance(length_.end(now_.load_factor, mark));
    now_.folds = check_folds(problem_.shell(), now_.positions, options_.fold_limit, when(mark), options_.time, mark);
    now_.control = {.length = length_.now(), .successes = length_.successes()};
    return now_;
  }

 private:
  /// A snap is found at a failed step; shorter ones would only place it more sharply.
  static constexpr int few_halvings = 3;

  void go_on(const PathPoint& from)
  {
    set_equilibrium(from, now_);
    length_.restore(from.control.length, from.control.successes);
    if (contact_)
      contact_->restore(now_.positions, now_.load_factor);
  }

  /// To this load factor, or to none with a shorter step for the next attempt.
  void advance(double factor)
  {
    Eigen::VectorXd x = now_.positions;
    try {
      move_supports(factor, x);
      contact_ ? touch(x, factor) : equilibrate(x, factor);
    } catch (const RunError& error) {
      if (length_.halve())
        return;
      if (options_.stabilisation == Stabilisation::None)
        fail(factor, error);
      x = now_.positions;
      move_supports(factor, x);
      snap(x, factor);
    }
    now_.positions = x;
    now_.load_factor = factor;
    limit_met_ = false;
    length_.succeeded();
  }

  /// Moves what is held by d, and the rest as the linear shell would follow, K u = -K d: a clamp that moved alone would
  /// leave the triangles at it stretched beyond what Newton's method returns from.
  void move_supports(double factor, Eigen::VectorXd& x)
  {
    const Shell& shell = problem_.shell();
    if (!shell.supports().moves())
      return;
    const Eigen::VectorXd before = x;
    problem_.place_supports(factor, x);
    tangent_.K.set_zero();
    problem_.add_tangent(before, now_.load_factor, tangent_.K);
    Eigen::VectorXd r = -(tangent_.K * (x - before));
    shell.clear_held(r);
    shell.supports().decouple(tangent_.K);
    tangent_.solver->factorise(tangent_.K);
    x += tangent_.solver->solve(r);
  }

  /// Newton's method. An equilibrium off the path counts as none; with damping to hand, an unstable one does too.
  void equilibrate(Eigen::VectorXd& x, double factor)
  {
    tangent_.valid = false;
    Equilibrium equilibrium = problem_.equilibrium(factor);
    equilibrium.increment = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& r, LinearSolver& solver) {
      limit_met_ = limit_met_ || tangent_.factorisation.negative_pivots.value_or(0) > 0;
      return problem_.has_skew_stiffness() ? solve_with_skew(solver, problem_.skew_stiffness(y, factor), r)
                                           : solver.solve(r);
    };
    now_.report = newton(problem_.shell(), equilibrium, options_.newton, tangent_, x, when(factor));
    now_.iterations += now_.report.iterations;
    const bool unstable = options_.stabilisation == Stabilisation::Damping && now_.report.negative_pivots != 0;
    const double increment = factor - now_.load_factor;
    // What a moving support takes along says nothing about a jump.
    const bool jumped = !problem_.shell().supports().moves() &&
                        has_jumped(now_.positions, x, increment * tangent_.solver->solve(problem_.load(x)),
                                   options_.newton.round_off * problem_.shell().size());
    if (unstable || jumped) {
      limit_met_ = true;
      fail_to_converge("{}: shell '{}' is unstable", when(factor), problem_.shell().name());
    }
  }

  void start_contact(ContactOptions contact)
  {
    // A step may be long: Newton's method goes down the energy from far away, and a fold may need any resistance.
    // Surfaces slide along each other against little else than what the Gauss-Newton part of the Hessian leaves out.
    contact.newton.hessian = ContactHessian::Exact;
    contact.newton.max_iterations = 200;
    contact.newton.most_shifts = 10;
    contact.newton.shift_ratio = 10;
    contact_ = std::make_unique<ContactStep>(problem_.shell(), contact, options_.linear_solver, now_.positions, 0.0);
    areas_ = vertex_areas(problem_.shell());
    viscosity_ = least_viscosity();
  }

  /// Per area, of no consequence to what is stiff: a part of the mean stiffness of the reference.
  double least_viscosity()
  {
    constexpr double part = 1e-9;
    tangent_.K.set_zero();
    problem_.add_tangent(now_.positions, 0, tangent_.K);
    return part * tangent_.K.trace() / (3 * areas_.sum());
  }

  /// Down the potential energy of shell, loads and contact to an equilibrium.
  void touch(Eigen::VectorXd& x, double factor)
  {
    ContactNewton::Result result = contact_->solve(balance(factor), x, factor, when(factor));
    x = result.positions;
    now_.report = std::move(result.report);
    now_.iterations += now_.report.iterations;
    contact_->accept(x, factor);
    now_.contact = {contact_->report(), contact_->energy(), contact_->crossings().count};
  }

  SmoothBalance balance(double factor)
  {
    SmoothBalance balance;
    balance.elastic_energy = [this, factor](const Eigen::VectorXd& x) { return problem_.elastic_energy(x, factor); };
    balance.elastic_force = [this, factor](const Eigen::VectorXd& x) { return problem_.internal_force(x, factor); };
    balance.other_forces = [this, factor](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return factor * problem_.load(x);
    };
    balance.tangent = [this, factor](const Eigen::VectorXd& x, BlockMatrix& K) { problem_.add_tangent(x, factor, K); };
    if (problem_.has_skew_stiffness())
      balance.skew = [this, factor](const Eigen::VectorXd& x) { return problem_.skew_stiffness(x, factor); };
    balance.add_resistance = [this](double part, BlockMatrix& K) { K.add_diagonal(part * viscosity_, areas_); };
    balance.force_scale = factor * problem_.load(now_.positions).norm();
    balance.energy = problem_.elastic_energy(now_.positions, now_.load_factor);
    return balance;
  }

  void snap(Eigen::VectorXd& x, double factor)
  {
    const SettlingReport settled = settle(problem_, factor, {.newton = options_.newton}, tangent_, x, when(factor));
    now_.report = settled.newton;
    now_.iterations += settled.newton.iterations;
    now_.damped_iterations += settled.iterations;
  }

  [[noreturn]] void fail(double factor, const RunError& error) const
  {
    if (!limit_met_ || now_.load_factor == 0)
      throw error;
    fail_to_converge(
        "{}: shell '{}' has met a limit point near load factor {:.4g} under load control: beyond, its stiffness has "
        "negative pivots and no equilibrium is near; use analysis = \"arc-length\" or \"displacement-control\" to "
        "follow it, stabilisation = \"damping\" to snap to the next stable shape, or analysis = \"dynamic\"",
        when(factor), problem_.shell().name(), now_.load_factor);
  }

  std::string when(double factor) const
  {
    return fmt::format("static step {} of {}, load factor {:.6g}", now_.step, options_.steps, factor);
  }

  const StaticOptions& options_;
  ProportionalLoad problem_;
  KeptTangent tangent_;
  StepLength length_;
  bool limit_met_ = false;                ///< unstable states were met since the last equilibrium
  std::unique_ptr<ContactStep> contact_;  ///< null without
  Eigen::VectorXd areas_;                 ///< of vertices, with contact
  double viscosity_ = 0;                  ///< per area, with contact
  StaticStep now_;
};

}  // namespace

/// A rigid motion meets no resistance when neither a held displacement nor a kept slope opposes it.
void check_supported(const Shell& shell)
{
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  double largest = 0;
  for (const double k : K.values())
    largest = std::max(largest, std::abs(k));
  const auto R = rigid_motions(shell);
  Eigen::Matrix<double, 6, 6> resistance;
  for (int j = 0; j < 6; ++j) {
    Eigen::VectorXd opposed = K * Eigen::VectorXd(R.col(j)) / largest;
    Eigen::VectorXd unheld = R.col(j);
    shell.clear_held(unheld);
    opposed += R.col(j) - unheld;
    resistance.col(j) = R.transpose() * opposed;
  }
  // Round-off of the products; the slope kept by a clamp of thickness h opposes with about (h/element)^2 / 100.
  constexpr double none = 1e-14;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(0.5 * (resistance + resistance.transpose()));
  if (modes.eigenvalues()[0] < none)
    fail_input(
        "shell '{}' can move as a rigid body, so it has no static equilibrium; add a support (a hinged edge alone "
        "lets it turn) or analyse its motion in time",
        shell.name());
}

bool has_jumped(const Eigen::VectorXd& start, const Eigen::VectorXd& end, const Eigen::VectorXd& tangent,
                double round_off)
{
  constexpr double much_longer = 5;
  return (end - start).lpNorm<Eigen::Infinity>() > std::max(round_off, much_longer * tangent.lpNorm<Eigen::Infinity>());
}

PathPoint point_of(const StaticStep& step)
{
  return {.step = step.step, .load_factor = step.load_factor, .positions = step.positions, .control = step.control};
}

void set_equilibrium(const PathPoint& point, StaticStep& step)
{
  step.step = point.step;
  step.load_factor = point.load_factor;
  step.positions = point.positions;
}

void check_supports_rest(const Shell& shell, std::string_view analysis)
{
  if (shell.supports().moves())
    fail_input("shell '{}': a support moves, which {} cannot follow; use analysis = \"static\" or \"dynamic\"",
               shell.name(), analysis);
}

void check_static(const Shell& shell, const StaticOptions& options)
{
  if (options.steps < 1)
    fail_input("shell '{}': static analysis with steps = {} must have at least 1", shell.name(), options.steps);
  if (options.stabilisation == Stabilisation::Damping && options.linear_solver != LinearSolverKind::Direct)
    fail_input("shell '{}': stabilisation by damping needs the direct solver, which tells stable from unstable",
               shell.name());
  if (options.stabilisation == Stabilisation::Damping && options.contact)
    fail_input(
        "shell '{}': stabilisation by damping must be left out with contact, which finds stable equilibria anyway",
        shell.name());
  check_supported(shell);
}

StaticStep solve_static(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options,
                        const OnStaticStep& on_step)
{
  check_static(shell, options);
  LoadPath path(shell, loads, options);
  StaticStep last = path.now();
  for (int step = path.now().step + 1; step <= options.steps; ++step) {
    last = path.reach(step);
    if (on_step)
      on_step(last);
  }
  return last;
}

}  // namespace luff::shell
