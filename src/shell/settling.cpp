// SPDX-License-Identifier: BSD-3-Clause
// Damped continuation: a shell out of balance moves as through syrup until it rests.
#include "shell/settling.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "shell/vertex_areas.hpp"

namespace luff::shell {

namespace {

class Settling {
 public:
  Settling(const ProportionalLoad& problem, double factor, const SettlingOptions& options, KeptTangent& tangent,
           Eigen::VectorXd& x, const std::string& when)
      : problem_(problem),
        shell_(problem.shell()),
        factor_(factor),
        options_(options),
        tangent_(tangent),
        x_(x),
        when_(when),
        areas_(vertex_areas(shell_))
  {
  }

  SettlingReport run()
  {
    residual_ = problem_.residual(x_, factor_);
    damping_ = first_damping();
    while (report_.iterations < options_.max_iterations) {
      ++report_.iterations;
      if (const auto moved = move(); moved && *moved < nearly_at_rest && finish())
        return report_;
    }
    fail_to_converge(
        "{}: shell '{}' does not come to rest in {} damped iterations at load factor {:.6g}: last out-of-balance force "
        "{:.3g}; refine the mesh or look at the last step for something that cannot carry load",
        when_, shell_.name(), report_.iterations, factor_, residual_.norm());
  }

 private:
  /// Largest move of an iteration, in sizes, after which undamped iterations are tried.
  static constexpr double nearly_at_rest = 1e-5;

  /// Damping that lets the residual move the shell by a thousandth of its size.
  double first_damping()
  {
    tangent_.K.set_zero();
    problem_.add_tangent(x_, factor_, tangent_.K);
    const double least = 1e-12 * std::abs(tangent_.K.trace()) / areas_.sum();
    return std::max(least, residual_.norm() / std::sqrt(shell_.n_vertices()) /
                               (1e-3 * shell_.size() * areas_.sum() / shell_.n_vertices()));
  }

  /// K + c A, factorised; false where it isn't positive definite.
  bool factorise()
  {
    tangent_.K.set_zero();
    problem_.add_tangent(x_, factor_, tangent_.K);
    tangent_.K.add_diagonal(damping_, areas_);
    shell_.supports().decouple(tangent_.K);
    tangent_.factorisation = tangent_.solver->factorise(tangent_.K);
    tangent_.valid = false;
    return tangent_.factorisation.negative_pivots == 0;
  }

  /// d' A d
  double area_product(const Eigen::VectorXd& d) const
  {
    double sum = 0;
    for (int v = 0; v < shell_.n_vertices(); ++v)
      sum += areas_[v] * d.segment<3>(3 * v).squaredNorm();
    return sum;
  }

  /// One damped iteration and the damping of the next. Returns the largest move in sizes, nothing where it was refused.
  std::optional<double> move()
  {
    constexpr double acceptable = 0.05, good = 0.7, very_good = 0.9;
    if (!factorise()) {
      damping_ *= 3;
      return {};
    }
    const Eigen::VectorXd dx = tangent_.solver->solve(residual_);
    const Eigen::VectorXd next = x_ + dx;
    // A quadratic potential would release r.dx - dx.K.dx / 2, with K dx = r - c A dx.
    const double expected = 0.5 * (residual_.dot(dx) + damping_ * area_product(dx));
    const bool below_round_off = expected < 1e-12 * shell_.elastic_energy(x_);
    const double ratio = below_round_off ? 1 : problem_.released_energy(x_, next, factor_) / expected;
    if (!(ratio > acceptable)) {
      damping_ *= 4;
      return {};
    }
    x_ = next;
    residual_ = problem_.residual(x_, factor_);
    if (ratio > good)
      damping_ /= ratio > very_good ? 8 : 3;
    return dx.lpNorm<Eigen::Infinity>() / shell_.size();
  }

  /// Undamped iterations from here; false where they fail. From an unstable equilibrium x is pushed away instead.
  bool finish()
  {
    Eigen::VectorXd y = x_;
    tangent_.valid = false;
    try {
      report_.newton = newton(shell_, problem_.equilibrium(factor_), options_.newton, tangent_, y, when_);
    } catch (const RunError&) {
      return false;
    }
    if (report_.newton.negative_pivots == 0) {
      x_ = y;
      return true;
    }
    leave_saddle(y);
    return false;
  }

  /// From the unstable equilibrium y, a thousandth of the size along the direction in which it is most unstable: a few
  /// inverse iterations with the least damping that makes K + c A positive definite.
  void leave_saddle(const Eigen::VectorXd& y)
  {
    x_ = y;
    while (!factorise())
      damping_ *= 2;
    Eigen::VectorXd mode(x_.size());
    for (Eigen::Index i = 0; i < mode.size(); ++i)
      mode[i] = std::sin(static_cast<double>(i + 1));  // in no direction of its own
    for (int iteration = 0; iteration < 8; ++iteration) {
      for (int v = 0; v < shell_.n_vertices(); ++v)
        mode.segment<3>(3 * v) *= areas_[v];
      mode = tangent_.solver->solve(mode);
      mode /= mode.lpNorm<Eigen::Infinity>();
    }
    x_ += 1e-3 * shell_.size() * mode;
    residual_ = problem_.residual(x_, factor_);
  }

  const ProportionalLoad& problem_;
  const Shell& shell_;
  double factor_;
  const SettlingOptions& options_;
  KeptTangent& tangent_;
  Eigen::VectorXd& x_;
  const std::string& when_;
  Eigen::VectorXd areas_;
  Eigen::VectorXd residual_;
  double damping_ = 0;
  SettlingReport report_;
};

}  // namespace

SettlingReport settle(const ProportionalLoad& problem, double factor, const SettlingOptions& options,
                      KeptTangent& tangent, Eigen::VectorXd& x, const std::string& when)
{
  return Settling(problem, factor, options, tangent, x, when).run();
}

}  // namespace luff::shell
