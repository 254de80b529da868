// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "grid/axis.hpp"
#include "simulation/build.hpp"

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
    case config::SideType::Outflow:
      break;
  }
  return fluid::SideKind::Outflow;
}

fluid::VectorFunction function_of(const config::VectorExpression& expression, double factor = 1.0)
{
  return {[expression, factor](const Vec3& x, double t) -> Vec3 { return factor * expression.evaluate(x, t); },
          expression.is_constant()};
}

fluid::FlowOptions flow_options(const config::Case& options)
{
  const config::FluidOptions& fluid = *options.fluid;
  fluid::FlowOptions flow;
  flow.density = fluid.density;
  flow.viscosity = fluid.viscosity / fluid.density;
  flow.acceleration = function_of(fluid.body_force, 1.0 / fluid.density);
  if (options.pressure.tolerance == config::PressureTolerance::Fast)
    flow.divergence = 1e-10;
  flow.max_iterations = options.pressure.max_iterations;
  return flow;
}

bool sheets_may_end_on(config::SideType type)
{
  return type == config::SideType::Symmetry || type == config::SideType::Slip || type == config::SideType::Periodic;
}

}  // namespace

std::array<std::vector<double>, 3> build_coordinates(const config::GridOptions& options)
{
  std::array<std::vector<double>, 3> faces;
  for (int a = 0; a < 3; ++a) {
    const config::AxisOptions& axis = options.axes[a];
    grid::AxisSpec spec{.from = axis.from, .to = axis.to, .cells = axis.cells, .refine = std::nullopt};
    if (axis.refine)
      spec.refine = grid::Refinement{axis.refine->from, axis.refine->to, axis.refine->spacing};
    faces[a] = grid::face_coordinates(spec, std::string(1, "xyz"[a]));
  }
  return faces;
}

fluid::Boundaries build_boundaries(const config::BoundaryOptions& options)
{
  fluid::Boundaries boundaries;
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end) {
      const config::SideOptions& side = options.sides[2 * a + end];
      boundaries[a][end] = {kind_of(side.type), function_of(side.value)};
    }
  return boundaries;
}

void check_sheets_inside(const config::Case& options, const Structure& structure)
{
  if (!options.fluid)
    return;
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  for (const SheetRange& sheet : structure.sheets())
    for (int v = 0; v < sheet.vertices; ++v)
      for (int a = 0; a < 3; ++a)
        for (int end = 0; end < 2; ++end) {
          const config::AxisOptions& axis = options.grid.axes[a];
          const Vec3& x = positions[sheet.first_vertex + v];
          const double inside = end == 0 ? x[a] - axis.from : axis.to - x[a];
          // Vertices on a plane carry the rounding of its coordinate.
          const double rounding = 1e-9 * (axis.to - axis.from);
          const bool may_touch = sheets_may_end_on(options.boundary.sides[2 * a + end].type);
          if (inside > rounding || (may_touch && inside >= -rounding))
            continue;
          fail_input(
              "{} '{}': vertex {} at ({:.6g}, {:.6g}, {:.6g}) {} side {} of the grid at {} = {:.6g}; move the "
              "sheet, or let the grid reach further (sheets may end on symmetry, slip and periodic sides only)",
              sheet.deforms ? "shell" : "body", sheet.name, v, x[0], x[1], x[2],
              inside < -rounding ? "lies beyond" : "touches", config::side_names[2 * a + end], "xyz"[a],
              end == 0 ? axis.from : axis.to);
        }
}

std::unique_ptr<Surroundings> build_surroundings(MPI_Comm comm, const config::Case& options)
{
  if (!options.fluid)
    return std::make_unique<Surroundings>();
  const fluid::Boundaries boundaries = build_boundaries(options.boundary);
  auto grid = std::make_unique<grid::Grid>(comm, build_coordinates(options.grid), fluid::periodic_axes(boundaries));
  const poisson::SolverOptions solver{.kind = options.pressure.solver == config::PressureSolver::Petsc ? "petsc"
                                                                                                       : "multigrid"};
  auto flow = std::make_unique<fluid::FlowSolver>(
      *grid, flow_options(options), boundaries,
      poisson::make_pressure_solver(*grid, fluid::pressure_conditions(boundaries), solver));
  flow->start(function_of(options.fluid->initial.velocity), 0.0);
  return std::make_unique<Flow>(std::move(grid), std::move(flow));
}

}  // namespace luff::simulation
