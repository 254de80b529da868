// SPDX-License-Identifier: BSD-3-Clause
// Newton's method for the equilibrium of a shell.
#include "shell/newton.hpp"

#include <cmath>

#include "core/error.hpp"

namespace luff::shell {

namespace {

[[noreturn]] void fail(const Shell& shell, const NewtonReport& report, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& dx, const std::string& when)
{
  Eigen::Index worst = 0;
  if (dx.allFinite())
    dx.cwiseAbs().maxCoeff(&worst);
  else
    while (std::isfinite(dx[worst]))
      ++worst;
  const int v = static_cast<int>(worst / 3);
  const PieceRange& piece = shell.piece_of_vertex(v);
  const Vec3 X = shell.reference().vertices[v], now = x.segment<3>(3 * v);
  fail_to_converge(
      "{}: shell '{}' found no equilibrium in {} iterations: last increment {:.2e} of its size, at vertex {} "
      "(reference ({:.6g}, {:.6g}, {:.6g}), now ({:.6g}, {:.6g}, {:.6g})); take smaller steps, add damping or "
      "refine the mesh there",
      when, piece.name, report.iterations, report.increment, v - piece.first_vertex, X.x(), X.y(), X.z(), now.x(),
      now.y(), now.z());
}

void check_finite(const Shell& shell, const Eigen::VectorXd& r, const Eigen::VectorXd& x, const std::string& when)
{
  if (r.allFinite())
    return;
  Eigen::Index first = 0;
  while (std::isfinite(r[first]))
    ++first;
  const int v = static_cast<int>(first / 3);
  const PieceRange& piece = shell.piece_of_vertex(v);
  const Vec3 now = x.segment<3>(3 * v);
  fail_to_converge(  // a shorter step may: tissue that a trial step turns inside out has no finite force
      "{}: shell '{}': the force on vertex {} at ({:.6g}, {:.6g}, {:.6g}) is no number: a load's formula gives none "
      "there, or the run diverged; mend the formula or take smaller steps",
      when, piece.name, v - piece.first_vertex, now.x(), now.y(), now.z());
}

void renew(const Shell& shell, const Equilibrium& equilibrium, const Eigen::VectorXd& x, KeptTangent& tangent)
{
  tangent.K.set_zero();
  equilibrium.tangent(x, tangent.K);
  shell.supports().decouple(tangent.K);
  tangent.factorisation = tangent.solver->factorise(tangent.K);
  tangent.valid = true;
}

/// Growing, or shrinking by less than the wanted rate per iteration over the last two.
bool is_slow(const std::vector<double>& increments, double rate)
{
  const std::size_t n = increments.size();
  return (n >= 2 && increments[n - 1] > increments[n - 2]) ||
         (n >= 3 && increments[n - 1] > rate * rate * increments[n - 3]);
}

/// By more than half in the last iteration.
bool is_shrinking(const std::vector<double>& increments)
{
  const std::size_t n = increments.size();
  return n < 2 || increments[n - 1] < 0.5 * increments[n - 2];
}

}  // namespace

NewtonReport newton(const Shell& shell, const Equilibrium& equilibrium, const NewtonPolicy& policy,
                    KeptTangent& tangent, Eigen::VectorXd& x, const std::string& when)
{
  NewtonReport report;
  while (true) {
    Eigen::VectorXd r = equilibrium.residual(x);
    shell.clear_held(r);
    check_finite(shell, r, x, when);
    report.residual = r.norm();
    report.residuals.push_back(report.residual);
    const bool renewed = !tangent.valid;
    Eigen::VectorXd dx;
    try {
      if (renewed)
        renew(shell, equilibrium, x, tangent);
      dx = equilibrium.increment ? equilibrium.increment(x, r, *tangent.solver) : tangent.solver->solve(r);
      report.negative_pivots = tangent.factorisation.negative_pivots;
    } catch (const RunError& error) {
      fail_run("{}: shell '{}': {}", when, shell.name(), error.what());
    }
    report.factorisations += renewed ? 1 : 0;
    report.increment = dx.lpNorm<Eigen::Infinity>() / shell.size();
    report.increments.push_back(report.increment);
    ++report.iterations;
    if (!dx.allFinite())
      fail(shell, report, x, dx, when);
    if (report.increment > policy.max_increment)
      dx *= policy.max_increment / report.increment;
    const Eigen::VectorXd before = x;
    x += dx;
    report.rounding = dx - (x - before);
    if (report.increment <= policy.tolerance)
      return report;
    if (renewed && report.increment < policy.round_off && !is_shrinking(report.increments)) {
      report.stopped_at_round_off = true;
      return report;
    }
    if (report.iterations == policy.max_iterations)
      fail(shell, report, x, dx, when);
    tangent.valid = policy.slow > 0 && !is_slow(report.increments, policy.slow);
  }
}

}  // namespace luff::shell
