// SPDX-License-Identifier: BSD-3-Clause
// The iteration to the fixed point of one time step.
#include "coupling/fixed_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace luff::coupling {

namespace {

// A maximum alone would pass over NaN.
double max_abs(const Eigen::VectorXd& r)
{
  return r.allFinite() ? r.lpNorm<Eigen::Infinity>() : std::numeric_limits<double>::quiet_NaN();
}

/// Evaluates the map, records the residual, and says whether and why the iteration ends; d becomes the image or,
/// if it goes on, the next guess.
bool iterate(const InterfaceMap& map, Eigen::VectorXd& d, Acceleration& acceleration,
             const ConvergenceCriterion& criterion, const ResidualNorm& norm, FixedPointReport& report)
{
  Eigen::VectorXd d_tilde = map(d);
  ensure(d_tilde.size() == d.size(), "an interface map must return a vector of the length it was given");
  report.residual = norm(d_tilde - d);
  report.history.push_back(report.residual);
  ++report.iterations;
  if (!std::isfinite(report.residual)) {
    report.outcome = FixedPointOutcome::NotFinite;
    return true;
  }
  const bool converged = report.residual <= criterion.tolerance;
  if (converged)
    report.outcome = FixedPointOutcome::Converged;
  const bool last = converged || report.iterations >= criterion.max_iterations;
  d = last ? std::move(d_tilde) : acceleration.next(d, d_tilde);
  return last;
}

}  // namespace

ResidualNorm displacement_norm(double length)
{
  ensure(length > 0, "the scale of a residual is positive");
  return [length](const Eigen::VectorXd& r) { return max_abs(r) / length; };
}

ResidualNorm displacement_and_velocity_norm(double length, double velocity, double rate)
{
  ensure(length > 0 && velocity > 0 && rate >= 0, "the scales of a residual are positive");
  return [=](const Eigen::VectorXd& r) { return max_abs(r) * std::max(1 / length, rate / velocity); };
}

FixedPointReport solve_fixed_point(const InterfaceMap& map, Eigen::VectorXd& d, Acceleration& acceleration,
                                   const ConvergenceCriterion& criterion, const ResidualNorm& norm)
{
  ensure(criterion.max_iterations >= 1, "a fixed point needs at least one iteration");
  FixedPointReport report;
  acceleration.begin_step();
  while (!iterate(map, d, acceleration, criterion, norm, report)) {
  }
  acceleration.end_step(report.converged());
  return report;
}

}  // namespace luff::coupling
