// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/added_mass.hpp"

#include <cmath>
#include <utility>
#include <vector>

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
  constexpr double gamma = 0.5;
  Structure& structure = simulation.structure();
  Surroundings& flow = simulation.surroundings();
  const shell::Shell& shell = *structure.shells().shell;
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
    const double before = std::exchange(ratio, -momentum.dot(of_shells(answer)) / (gamma * momentum.dot(of_shells(d))));
    if (std::abs(ratio - before) <= enough * std::abs(ratio))
      break;
    d = answer;
  }
  return ratio;
}

std::string describe_coupling(double added_mass_ratio, Scheme scheme)
{
  const std::string mass =
      fmt::format("fluid that moves with the shells: up to {:.3g} times their own mass (added mass)", added_mass_ratio);
  if (added_mass_ratio < loose_limit)
    return fmt::format("{}: loose coupling is stable, its limit is {}", mass, loose_limit);
  if (scheme == Scheme::Loose)
    return fmt::format(
        "WARNING: {}: loose coupling is unstable above {}, however short the steps; set coupling.scheme = \"strong\"",
        mass, loose_limit);
  return fmt::format("{}: loose coupling would be unstable, its limit is {}; strong coupling is right", mass,
                     loose_limit);
}

}  // namespace luff::simulation
