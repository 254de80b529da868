// SPDX-License-Identifier: BSD-3-Clause
#include "grid/quality.hpp"
#include "simulation/build.hpp"
#include "simulation/build_nodes.hpp"
#include "simulation/check_flow.hpp"
#include "simulation/refusal.hpp"

namespace luff::simulation {

namespace {

fluid::SideKind kind_of(config::SideType type)
{
  switch (type) {
    case config::SideType::Velocity:
      return fluid::SideKind::Velocity;
    case config::SideType::Wall:
      return fluid::SideKind::Wall;
    case config::SideType::Slip:
      return fluid::SideKind::Slip;
    case config::SideType::Symmetry:
      return fluid::SideKind::Symmetry;
    case config::SideType::Periodic:
      return fluid::SideKind::Periodic;
    case config::SideType::Pressure:
      return fluid::SideKind::Pressure;
    case config::SideType::Outflow:
      break;
  }
  return fluid::SideKind::Outflow;
}

fluid::FlowProfile profile_of(config::InflowShape shape)
{
  switch (shape) {
    case config::InflowShape::Parabolic:
      return fluid::FlowProfile::Parabolic;
    case config::InflowShape::Womersley:
      return fluid::FlowProfile::Womersley;
    case config::InflowShape::Plug:
      break;
  }
  return fluid::FlowProfile::Plug;
}

fluid::VectorFunction function_of(const config::VectorExpression& expression, double factor = 1.0)
{
  return {[expression, factor](const Vec3& x, double t) -> Vec3 { return factor * expression.evaluate(x, t); },
          expression.is_constant()};
}

fluid::SideBoundary side_of(const config::SideOptions& options, double density)
{
  fluid::SideBoundary side{.kind = kind_of(options.type)};
  if (options.value)
    side.velocity = function_of(*options.value);
  if (options.flow_rate)
    side.flow_rate = fluid::FlowRate{.into = [Q = *options.flow_rate](double t) { return Q.evaluate(Vec3::Zero(), t); },
                                     .constant = options.flow_rate->is_constant(),
                                     .profile = profile_of(options.profile),
                                     .period = options.period};
  side.pressure = {[p = options.pressure, density](const Vec3& x, double t) { return p.evaluate(x, t) / density; },
                   options.pressure.is_constant()};
  side.entering =
      options.entering == config::EnteringFluid::Developed ? fluid::Entering::Developed : fluid::Entering::Reservoir;
  return side;
}

}  // namespace

fluid::TimeScheme time_scheme(config::TimeScheme scheme)
{
  return scheme == config::TimeScheme::NewtonKrylov ? fluid::TimeScheme::NewtonKrylov : fluid::TimeScheme::Rk3;
}

namespace {

fluid::FlowOptions flow_options(const config::Case& options)
{
  const config::FluidOptions& fluid = *options.fluid;
  fluid::FlowOptions flow;
  flow.scheme = time_scheme(options.time.scheme);
  if (options.immersed.scheme == config::ImmersedScheme::Curvib)
    flow.immersed = fluid::ImmersedScheme::Curvib;
  flow.edges_cover_in_part = options.immersed.edges == config::EdgeCover::Partial;
  flow.density = fluid.density;
  flow.viscosity = fluid.viscosity / fluid.density;
  flow.acceleration = function_of(fluid.body_force, 1.0 / fluid.density);
  if (options.pressure.tolerance == config::PressureTolerance::Fast)
    flow.divergence = 1e-10;
  flow.max_iterations = options.pressure.max_iterations;
  return flow;
}

}  // namespace

fluid::Boundaries build_boundaries(const config::Case& options)
{
  fluid::Boundaries boundaries;
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      boundaries[a][end] = side_of(options.boundary.sides[2 * a + end], options.fluid->density);
  return boundaries;
}

namespace {

std::unique_ptr<grid::Grid> build_curvilinear(MPI_Comm comm, const config::GridOptions& options,
                                              const std::array<bool, 3>& periodic)
{
  const grid::CurvilinearNodes nodes = build_nodes(options);
  return refusing_at(options.mark, [&] {
    auto grid = std::make_unique<grid::Grid>(comm, nodes.cells, nodes.source, periodic);
    grid::require_sound(grid::measure_quality(*grid));
    grid::require_periodic_sides(*grid, nodes.source);
    return grid;
  });
}

}  // namespace

std::unique_ptr<grid::Grid> build_grid(MPI_Comm comm, const config::Case& options)
{
  const auto periodic = fluid::periodic_axes(build_boundaries(options));
  if (is_curvilinear(options.grid.kind))
    return build_curvilinear(comm, options.grid, periodic);
  auto coordinates = build_coordinates(options.grid);
  return refusing_at(options.grid.mark,
                     [&] { return std::make_unique<grid::Grid>(comm, std::move(coordinates), periodic); });
}

std::unique_ptr<Surroundings> build_surroundings(MPI_Comm comm, const config::Case& options, const Structure& structure)
{
  if (!options.fluid)
    return std::make_unique<Surroundings>();
  const fluid::Boundaries boundaries = build_boundaries(options);
  auto grid = build_grid(comm, options);
  check_flow(*grid, options);
  const poisson::SolverOptions solver{.kind = options.pressure.solver == config::PressureSolver::Petsc ? "petsc"
                                                                                                       : "multigrid"};
  auto flow = std::make_unique<fluid::FlowSolver>(
      *grid, flow_options(options), boundaries,
      poisson::make_pressure_solver(*grid, fluid::pressure_conditions(boundaries), solver));
  flow->start(function_of(options.fluid->initial.velocity), 0.0);
  return std::make_unique<Flow>(std::move(grid), std::move(flow),
                                immersed::VertexPatches(structure.triangles(), structure.shell_vertices()));
}

}  // namespace luff::simulation
