// SPDX-License-Identifier: BSD-3-Clause
// A small three-dimensional flow with everything in it: vortices, stretched cells, a sheet that moves.
#pragma once

#include "support/flow.hpp"
#include "surface/generators.hpp"

namespace luff::test {

/// Units of length and time, in those of the case: 1 and 1 for the non-dimensional one.
struct Units {
  double length = 1.0;
  double time = 1.0;
  [[nodiscard]] double speed() const { return length / time; }
};

/// Vortices in a stream along x through a box with outlet, periodic along z; density 1 and viscosity 0.01.
inline std::unique_ptr<TestFlow> make_stretched_flow(MPI_Comm comm, const Units& unit = {},
                                                     fluid::FlowOptions options = {})
{
  using fluid::SideBoundary;
  using fluid::SideKind;
  const double L = unit.length;
  const auto scaled = [L](std::vector<double> faces) {
    for (double& x : faces)
      x *= L;
    return faces;
  };
  const fluid::VectorFunction stream{fluid::VectorFunction::uniform(unit.speed() * Vec3::UnitX())};
  const SideBoundary slip{.kind = SideKind::Slip};
  const SideBoundary wall{.kind = SideKind::Wall};
  const SideBoundary periodic{.kind = SideKind::Periodic};
  const fluid::Boundaries sides{{{SideBoundary{SideKind::Velocity, stream}, SideBoundary{.kind = SideKind::Outflow}},
                                 {wall, slip},
                                 {periodic, periodic}}};
  options.viscosity = 0.01 * unit.length * unit.speed();
  auto flow = std::make_unique<TestFlow>(
      std::array{scaled(stretched_faces(-1, 2, 36, 0.3)), scaled(stretched_faces(-1, 1, 24, -0.3)),
                 scaled(stretched_faces(0, 1, 16, 0.2))},
      sides, options, comm);
  const double pi = std::numbers::pi;
  flow->solver.start({[unit, pi](const Vec3& X, double) -> Vec3 {
                        const Vec3 x = X / unit.length;
                        return unit.speed() * Vec3(1.0 + 0.3 * std::sin(pi * x[0]) * std::cos(pi * x[1]),
                                                   -0.3 * std::cos(pi * x[0]) * std::sin(pi * x[1]),
                                                   0.2 * std::cos(2.0 * pi * x[2]) * std::sin(pi * x[1]));
                      },
                      false},
                     0.0);
  return flow;
}

/// A sheet of side 0.6 at 60 degrees to the stream that heaves along y.
inline immersed::SheetMotion heaving_sheet(double t, const Units& unit = {})
{
  surface::TriangleMesh mesh = surface::rectangle(
      {.origin = {-0.3, 0.0, -0.3}, .a = 0.6 * Vec3::UnitX(), .b = 0.6 * Vec3::UnitZ(), .divisions = {8, 8}});
  surface::rotate(mesh, Vec3::UnitZ(), 60.0);
  surface::rotate(mesh, Vec3::UnitX(), 10.0);
  const double phase = 2.0 * t / unit.time;
  surface::translate(mesh, {0.1, 0.07 + 0.2 * std::sin(phase), 0.51});
  for (Vec3& x : mesh.vertices)
    x *= unit.length;
  const std::size_t n = mesh.vertices.size();
  return {mesh.vertices, std::vector<Vec3>(n, 0.4 * std::cos(phase) * unit.speed() * Vec3::UnitY()),
          std::vector<Vec3>(n, -0.8 * std::sin(phase) * unit.speed() / unit.time * Vec3::UnitY()), mesh.triangles};
}

/// What a run is compared by: velocity and pressure at a few cells, momentum, energy, force on the sheet; in units of
/// the case, the same on every rank.
struct Signature {
  std::vector<double> values;

  /// Largest difference, relative to the largest value of either of the two kinds, speeds and pressures.
  [[nodiscard]] double difference(const Signature& other) const
  {
    double largest = 0.0;
    double scale = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
      largest = std::max(largest, std::abs(values[n] - other.values[n]));
      scale = std::max(scale, std::abs(values[n]));
    }
    return largest / scale;
  }
};

inline Signature run_stretched_flow(MPI_Comm comm, int steps, bool with_sheet, const Units& unit = {},
                                    const fluid::FlowOptions& options = {})
{
  const auto flow = make_stretched_flow(comm, unit, options);
  const double dt = 0.01 * unit.time;
  Vec3 force = Vec3::Zero();
  for (int n = 0; n < steps; ++n) {
    const immersed::SheetMotion sheet = with_sheet ? heaving_sheet(flow->t + dt, unit) : immersed::SheetMotion{};
    flow->step(dt, sheet);
    const immersed::SheetLoads loads = flow->solver.loads();
    force.setZero();
    for (std::size_t v = 0; v < loads.plus.size(); ++v)
      force += loads.force(v);
    flow->solver.accept();
  }
  const auto u = views(flow->solver.state().u);
  const auto p = flow->solver.state().p.view();
  const grid::Grid& grid = flow->grid;
  const double U = unit.speed();
  Signature signature;
  const auto add = [&](double local) { signature.values.push_back(grid.ranks().sum(local)); };
  for (const Index3& probe : {Index3{20, 12, 8}, Index3{14, 11, 3}, Index3{30, 20, 15}, Index3{2, 1, 0}}) {
    const bool mine = grid.owned().contains(probe);
    for (int d = 0; d < 3; ++d)
      add(mine ? u[d](probe) / U : 0.0);
    add(mine ? p(probe) / (U * U) : 0.0);
  }
  const double volume = 6.0 * std::pow(unit.length, 3);
  for (int d = 0; d < 3; ++d)
    add(sum_cells(grid.owned(), [&, v = u[d]](int i, int j, int k) { return grid.volume(i, j, k) * v(i, j, k); }) /
        (volume * U));
  add(sum_cells(grid.owned(),
                [&](int i, int j, int k) {
                  return grid.volume(i, j, k) * Vec3(u[0](i, j, k), u[1](i, j, k), u[2](i, j, k)).squaredNorm();
                }) /
      (volume * U * U));
  for (int d = 0; d < 3; ++d)
    signature.values.push_back(force[d] / (U * U * unit.length * unit.length));
  return signature;
}

}  // namespace luff::test
