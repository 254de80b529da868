// SPDX-License-Identifier: BSD-3-Clause
// The cylindrical arc-length method.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "shell/path_following.hpp"
#include "shell/proportional_load.hpp"
#include "shell/vertex_areas.hpp"

namespace luff::shell {

namespace {

/// Mean over the reference area of the product of two displacements, u.v.
class MeanProduct {
 public:
  explicit MeanProduct(const Shell& shell) : weight_(vertex_areas(shell)) { weight_ /= weight_.sum(); }

  double operator()(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const
  {
    double sum = 0;
    for (Eigen::Index i = 0; i < weight_.size(); ++i)
      sum += weight_[i] * u.segment<3>(3 * i).dot(v.segment<3>(3 * i));
    return sum;
  }

 private:
  Eigen::VectorXd weight_;
};

class ArcLengthPath {
 public:
  ArcLengthPath(const Shell& shell, const std::vector<Load>& loads, const ArcLengthOptions& options)
      : options_(options),
        problem_(shell, loads, options.statics.time),
        tangent_(shell, LinearSolverKind::Direct),
        product_(shell)
  {
    now_.positions = shell.reference_positions();
    if (options.statics.from)
      go_on(*options.statics.from);
  }

  const StaticStep& now() const { return now_; }

  bool at_full_load() const { return now_.load_factor == 1; }

  const StaticStep& advance()
  {
    ++now_.step;
    now_.iterations = 0;
    if (now_.step == 1)
      length_ = first_length();
    while (!attempt()) {
      length_ /= 2;
      if (length_ < std::ldexp(first_length_, -options_.statics.max_halvings))
        fail_to_converge(
            "{}: shell '{}' has no equilibrium within the shortest step, {:.3g} of root mean square displacement; last "
            "try: {}",
            when(), problem_.shell().name(), length_, reason_);
    }
    now_.folds = check_folds(problem_.shell(), now_.positions, options_.statics.fold_limit, when());
    now_.control = {.length = length_, .first_length = first_length_, .last_move = previous_};
    return now_;
  }

 private:
  /// A step that takes more iterations is shortened, one that takes fewer is lengthened.
  static constexpr int wanted_iterations = 5;
  static constexpr double longest = 8;  ///< in lengths of the first step

  void go_on(const PathPoint& from)
  {
    set_equilibrium(from, now_);
    length_ = from.control.length;
    first_length_ = from.control.first_length;
    previous_ = from.control.last_move;
  }

  /// Displacement of the first of `steps` load steps, were the shell linear.
  double first_length()
  {
    tangent_.K.set_zero();
    problem_.add_tangent(now_.positions, 0, tangent_.K);
    problem_.shell().supports().decouple(tangent_.K);
    tangent_.solver->factorise(tangent_.K);
    const Eigen::VectorXd u = tangent_.solver->solve(problem_.load(now_.positions));
    first_length_ = std::sqrt(product_(u, u)) / options_.statics.steps;
    if (!(first_length_ > 0))
      fail_input("shell '{}': arc-length analysis needs loads that move it", problem_.shell().name());
    return first_length_;
  }

  /// One step of the present length; false, and the reason kept, where it finds no equilibrium.
  bool attempt()
  {
    Eigen::VectorXd x = now_.positions;
    double factor = now_.load_factor;
    try {
      const NewtonReport report = solve(x, factor);
      const Eigen::VectorXd moved = x - now_.positions;
      if (previous_.size() > 0 && product_(moved, previous_) < 0)
        fail_to_converge("the step turned back");
      if (factor >= 1) {
        end_at_full_load(x);
        return true;
      }
      accept(x, factor, report);
      length_ = std::min(length_ * std::clamp(std::sqrt(double(wanted_iterations) / report.iterations), 0.5, 2.0),
                         longest * first_length_);
      return true;
    } catch (const RunError& error) {
      reason_ = error.what();
      return false;
    }
  }

  /// Newton's method for x and the load factor at the given distance from the last equilibrium.
  NewtonReport solve(Eigen::VectorXd& x, double& factor)
  {
    Equilibrium equilibrium = problem_.equilibrium(factor);
    equilibrium.increment = [&](const Eigen::VectorXd& y, const Eigen::VectorXd& r, LinearSolver& solver) {
      const Eigen::VectorXd by_residual = solver.solve(r), by_load = solver.solve(problem_.load(y));
      const double increment = factor_increment(y - now_.positions, by_residual, by_load);
      factor += increment;
      return Eigen::VectorXd(by_residual + increment * by_load);
    };
    tangent_.valid = false;
    const NewtonReport report = newton(problem_.shell(), equilibrium, options_.statics.newton, tangent_, x, when());
    now_.iterations += report.iterations;
    return report;
  }

  /// Increment d of the load factor for which the step u + a + d b has the length wanted, a = K^-1 r, b = K^-1 f:
  ///
  ///   d^2 <b,b> + 2 d <u + a, b> + <u + a, u + a> = length^2.
  ///
  /// Of the two roots, that which goes on: along the step so far, at its start along the last step.
  double factor_increment(const Eigen::VectorXd& u, const Eigen::VectorXd& a, const Eigen::VectorXd& b) const
  {
    const Eigen::VectorXd v = u + a;
    const double bb = product_(b, b), vb = product_(v, b), vv = product_(v, v);
    const double discriminant = vb * vb - bb * (vv - length_ * length_);
    if (!(discriminant >= 0))
      fail_to_converge("no load factor keeps the length of the step");
    const double root = std::sqrt(discriminant);
    const bool at_start = u.squaredNorm() == 0;
    const double onward = !at_start ? product_(b, u) : previous_.size() > 0 ? product_(b, previous_) : 1.0;
    return (-vb + (onward >= 0 ? root : -root)) / bb;
  }

  void accept(const Eigen::VectorXd& x, double factor, const NewtonReport& report)
  {
    previous_ = x - now_.positions;
    now_.positions = x;
    now_.load_factor = factor;
    now_.report = report;
  }

  /// From an equilibrium beyond it back to load factor 1.
  void end_at_full_load(Eigen::VectorXd x)
  {
    const double full = 1;
    tangent_.valid = false;
    const NewtonReport report =
        newton(problem_.shell(), problem_.equilibrium(full), options_.statics.newton, tangent_, x, when());
    now_.iterations += report.iterations;
    accept(x, full, report);
  }

  std::string when() const
  {
    return fmt::format("arc-length step {}, load factor {:.6g}", now_.step, now_.load_factor);
  }

  const ArcLengthOptions& options_;
  ProportionalLoad problem_;
  KeptTangent tangent_;
  MeanProduct product_;
  double first_length_ = 0;
  double length_ = 0;         ///< root mean square displacement of the next step [L]
  Eigen::VectorXd previous_;  ///< displacement of the last step, empty before the first
  StaticStep now_;
  std::string reason_;
};

}  // namespace

StaticStep follow_arc_length(const Shell& shell, const std::vector<Load>& loads, const ArcLengthOptions& options,
                             const OnStaticStep& on_step)
{
  check_static(shell, options.statics);
  check_supports_rest(shell, "arc-length");
  ArcLengthPath path(shell, loads, options);
  StaticStep last = path.now();
  for (int step = path.now().step + 1; step <= options.max_steps; ++step) {
    last = path.advance();
    if (on_step)
      on_step(last);
    if (path.at_full_load())
      return last;
  }
  fail_run(
      "arc-length step {}: shell '{}' is at load factor {:.4g} and has not reached 1; allow more steps (max_steps), "
      "or longer ones (fewer steps)",
      options.max_steps, shell.name(), last.load_factor);
}

}  // namespace luff::shell
