// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/added_mass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "surface/mesh.hpp"

namespace luff::simulation {

namespace {

/// Along the normals, of unit length, where nothing is held; bodies stay.
Eigen::VectorXd along_normals(const shell::Shell& shell, Eigen::Index unknowns)
{
  const surface::TriangleMesh& mesh = shell.reference();
  Eigen::VectorXd d = Eigen::VectorXd::Zero(Eigen::Index{3} * mesh.n_vertices());
  for (const auto& [a, b, c] : mesh.triangles)
    for (const int corner : {a, b, c})
      d.segment<3>(Eigen::Index{3} * corner) +=
          surface::area_vector(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  for (int n = 0; n < mesh.n_vertices(); ++n)
    d.segment<3>(Eigen::Index{3} * n).normalize();
  shell.clear_held(d);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(unknowns);
  all.head(d.size()) = d;
  return all;
}

immersed::SheetLoads difference(immersed::SheetLoads a, const immersed::SheetLoads& b)
{
  for (std::size_t n = 0; n < a.minus.size(); ++n) {
    a.minus[n] -= b.minus[n];
    a.plus[n] -= b.plus[n];
  }
  return a;
}

}  // namespace

double added_mass_ratio(Simulation& simulation)
{
  constexpr int most_projections = 10;
  constexpr double enough = 0.02;
  constexpr double small = 1e-5;  // of a displacement over the shells' length: their answer is linear
  Structure& structure = simulation.structure();
  Surroundings& flow = simulation.surroundings();
  const shell::Shell& shell = *structure.shells().shell;
  const shell::TimeScheme& scheme = structure.shells().dynamics->scheme();
  const double answer_to_own_mass = scheme.gamma() * (1 - scheme.alpha_f()) / (1 - scheme.alpha_m());
  const TimeStep step = simulation.clock().next(flow.step_rates());
  const Eigen::VectorXd d_0 = structure.predict(step);
  Eigen::VectorXd d = along_normals(shell, d_0.size());
  // Predicted to move: a fluid still at rest has no speed of its own that its divergence could be small against.
  flow.begin_step(step, structure.motion(d_0 + small * structure.length() * d, step));
  const immersed::SheetLoads loads_0 = flow.loads(structure.velocity(d_0, step));
  const Eigen::VectorXd unloaded = structure.solve(step, difference(loads_0, loads_0), d_0);

  const auto of_shells = [n = Eigen::Index{3} * shell.n_vertices()](const Eigen::VectorXd& all) { return all.head(n); };
  double ratio = 0.0;
  for (int n = 0; n < most_projections; ++n) {
    d *= small * structure.length() / d.lpNorm<Eigen::Infinity>();
    const immersed::SheetLoads change = difference(flow.loads(structure.velocity(d_0 + d, step)), loads_0);
    const Eigen::VectorXd answer = structure.solve(step, change, d_0) - unloaded;
    const Eigen::VectorXd momentum = shell.mass_times(of_shells(d));
    const double before =
        std::exchange(ratio, -momentum.dot(of_shells(answer)) / (answer_to_own_mass * momentum.dot(of_shells(d))));
    if (std::abs(ratio - before) <= enough * std::abs(ratio))
      break;
    d = answer;
  }
  return ratio;
}

namespace {

/// Spectral radius of the loose scheme's recursion for the acceleration of a mass in a fluid mu times as heavy:
///
///   (1-alpha_m) a^{n+1} + alpha_m a^n = (1-alpha_f) F^{n+1} + alpha_f F^n,   F^{n+1} = -mu (3/2 A^{n+1} - 1/2 A^n),
///   A^{n+1} = (1+gamma) a^n - gamma a^{n-1},
///
/// A the mean acceleration of the fluid in the step, which sees the predictor's velocity v^n + dt a^n.
double growth_of_loose_scheme(const shell::TimeScheme& scheme, double mu)
{
  const double gamma = scheme.gamma();
  using Row = Eigen::RowVector4d;  // of a^n, a^{n-1}, a^{n-2}, a^{n-3}
  const Row force = -mu * Row(1.5 * (1 + gamma), -1.5 * gamma - 0.5 * (1 + gamma), 0.5 * gamma, 0.0);
  const Row force_before(0.0, force[0], force[1], force[2]);
  Eigen::MatrixXd recursion = Eigen::MatrixXd::Zero(4, 4);
  recursion.row(0) =
      ((1 - scheme.alpha_f()) * force + scheme.alpha_f() * force_before - scheme.alpha_m() * Row::Unit(0)) /
      (1 - scheme.alpha_m());
  recursion.bottomLeftCorner(3, 3).setIdentity();
  return recursion.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

double loose_limit(const shell::TimeScheme& scheme)
{
  constexpr int halvings = 40;
  constexpr double round_off = 1e-10;
  double stable = 0.0;
  double unstable = 4.0;
  for (int n = 0; n < halvings; ++n) {
    const double middle = 0.5 * (stable + unstable);
    (growth_of_loose_scheme(scheme, middle) <= 1.0 + round_off ? stable : unstable) = middle;
  }
  return stable;
}

double borrowed_mass(double added_mass_ratio)
{
  constexpr double heaviest_fluid = 10.0;
  return std::max(0.0, added_mass_ratio / heaviest_fluid - 1.0);
}

std::string describe_coupling(double added_mass_ratio, Simulation& simulation)
{
  const double limit = loose_limit(simulation.structure().shells().dynamics->scheme());
  const std::string mass =
      fmt::format("fluid that moves with the shells: up to {:.3g} times their own mass (added mass)", added_mass_ratio);
  if (added_mass_ratio < limit)
    return fmt::format("{}: loose coupling is stable, its limit is {:.2g}", mass, limit);
  if (simulation.policy().scheme == Scheme::Loose)
    return fmt::format(
        "WARNING: {}: loose coupling is unstable above {:.2g}, however short the steps; set coupling.scheme = "
        "\"strong\"",
        mass, limit);
  const double borrowed = borrowed_mass(added_mass_ratio);
  return fmt::format(
      "{}: loose coupling would be unstable, its limit is {:.2g}; strong coupling is right{}", mass, limit,
      borrowed > 0.0 ? fmt::format(", with shells {:.3g} times heavier between iterations", 1.0 + borrowed) : "");
}

}  // namespace luff::simulation
