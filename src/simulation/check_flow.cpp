// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/check_flow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/ranges.h>

#include "core/error.hpp"
#include "fluid/boundary.hpp"
#include "grid/locate.hpp"
#include "simulation/build.hpp"
#include "simulation/refusal.hpp"
#include "surface/topology.hpp"

namespace luff::simulation {

bool sheets_may_end_on(config::SideType type)
{
  return type == config::SideType::Symmetry || type == config::SideType::Slip || type == config::SideType::Periodic;
}

namespace {

void check_sheet_inside(const config::Case& options, const SheetRange& sheet, std::span<const Vec3> positions)
{
  for (int v = 0; v < sheet.vertices; ++v)
    for (int a = 0; a < 3; ++a)
      for (int end = 0; end < 2; ++end) {
        const config::AxisOptions& axis = options.grid.axes[a];
        const Vec3& x = positions[v];
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

/// The first side that a point stands on and that `wanted` says of.
std::optional<std::string> side_under(const grid::Standing& standing, const config::BoundaryOptions& boundary,
                                      const std::function<bool(config::SideType)>& wanted)
{
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      if (standing.on_side[a][end] && wanted(boundary.sides[2 * a + end].type))
        return std::string(boundary.names()[2 * a + end]);
  return std::nullopt;
}

void check_sheet_in_grid(const config::Case& options, const SheetRange& sheet, std::span<const Vec3> positions,
                         std::span<const grid::Standing> standings)
{
  const std::string owner = fmt::format("{} '{}'", sheet.deforms ? "shell" : "body", sheet.name);
  for (int v = 0; v < sheet.vertices; ++v) {
    const auto touched =
        side_under(standings[v], options.boundary, [](config::SideType type) { return !sheets_may_end_on(type); });
    if (standings[v].inside && !touched)
      continue;
    const Vec3& x = positions[v];
    fail_input(
        "{}: vertex {} at ({:.6g}, {:.6g}, {:.6g}) {}; move the sheet, or let the grid reach further (sheets may end "
        "on symmetry, slip and periodic sides only; one that is to close off a part of the fluid ends less than half a "
        "cell from a wall)",
        owner, v, x[0], x[1], x[2], touched ? "touches side " + *touched : "lies outside the grid");
  }
  if (sheet.deforms || !options.bodies[sheet.part].closed.value_or(false))
    return;
  for (const surface::TriangleEdge& edge : surface::topology(sheet.reference).boundary) {
    const auto [a, b] = surface::edge_vertices(sheet.reference.triangles[edge.triangle], edge.edge);
    for (const int v : {a, b})
      if (!side_under(standings[v], options.boundary, sheets_may_end_on))
        fail_input(
            "{}: declared closed, but it leaks through an edge at ({:.6g}, {:.6g}, {:.6g}) that has a triangle on one "
            "side only and lies on no side of the grid that sheets may end on; close the mesh, or leave `closed` out",
            owner, positions[v][0], positions[v][1], positions[v][2]);
  }
}

/// One number, or the three of a vector, somewhere at t = 0.
using ValueAt = std::function<std::vector<double>(const Vec3& x)>;

ValueAt at_start(const config::VectorExpression& vector)
{
  return [&vector](const Vec3& x) {
    const Vec3 v = vector.evaluate(x, 0.0);
    return std::vector<double>{v[0], v[1], v[2]};
  };
}

ValueAt at_start(const config::Expression& scalar)
{
  return [&scalar](const Vec3& x) { return std::vector<double>{scalar.evaluate(x, 0.0)}; };
}

bool all_finite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Throws, on every rank, if the value is no number at the centre of one of the cells (global indices; each rank looks
/// at its own).  Sides look at the centres of the cells beside them.
void check_finite(const grid::Grid& grid, const IndexBox& cells, const ValueAt& value, const std::string& key)
{
  const auto& n = grid.cells();
  const double none = std::numeric_limits<double>::max();
  double first = none;
  const IndexBox mine = intersection(cells, grid.owned());
  for_each_cell_in_order(mine, [&](int i, int j, int k) {
    const double number = i + double(n[0]) * (j + double(n[1]) * k);
    if (number < first && !all_finite(value(grid.centre(i, j, k))))
      first = number;
  });
  first = -grid.ranks().max(-first);
  if (first == none)
    return;
  const auto number = static_cast<long>(first);
  const Vec3 x = grid.centre_of_any({static_cast<int>(number % n[0]), static_cast<int>(number / n[0] % n[1]),
                                     static_cast<int>(number / n[0] / n[1])});
  const std::vector<double> values = value(x);
  const std::string shown = fmt::format("{}", fmt::join(values, ", "));
  fail_input(
      "{} is {} at ({:.6g}, {:.6g}, {:.6g}), t = 0; it must be a number everywhere: guard the formula there, "
      "as in \"x > 0 ? 1/x : 0\"",
      key, values.size() > 1 ? "[" + shown + "]" : shown, x[0], x[1], x[2]);
}

/// The owned cells beside a side of the domain.
IndexBox cells_beside(const grid::Grid& grid, int axis, int end)
{
  IndexBox box = grid.ranks().domain();
  (end == 0 ? box.hi : box.lo)[axis] = end == 0 ? 1 : grid.cells()[axis] - 1;
  return box;
}

void check_initial_velocity(const grid::Grid& grid, const config::InitialOptions& initial)
{
  const IndexBox cells = initial.velocity.is_constant() ? IndexBox{{0, 0, 0}, {1, 1, 1}} : grid.ranks().domain();
  refusing_at(initial.mark, [&] { check_finite(grid, cells, at_start(initial.velocity), "fluid.initial.velocity"); });
}

void check_side(const grid::Grid& grid, const config::Case& options, int axis, int end)
{
  const config::SideOptions& side = options.boundary.sides[2 * axis + end];
  const IndexBox cells = cells_beside(grid, axis, end);
  const std::string key = fmt::format("boundary.{}.", options.boundary.names()[2 * axis + end]);
  if (side.value)
    check_finite(grid, cells, at_start(*side.value), key + "value");
  if (side.flow_rate)
    check_finite(grid, cells, at_start(*side.flow_rate), key + "flow_rate");
  check_finite(grid, cells, at_start(side.pressure), key + "pressure");
}

void check_sides(const grid::Grid& grid, const config::Case& options)
{
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      check_side(grid, options, a, end);
  // A flow that grows from rest brings in nothing at t = 0.
  fluid::BoundaryConditions conditions(grid, build_boundaries(options),
                                       options.fluid->viscosity / options.fluid->density);
  for (const double t : {0.0, options.time.step, 0.5 * options.time.end, options.time.end})
    conditions.evaluate_at(t);
}

}  // namespace

void check_sheets_inside(const config::Case& options, const Structure& structure)
{
  if (!options.fluid || config::is_curvilinear(options.grid.kind))
    return;
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  for (const SheetRange& sheet : structure.sheets()) {
    const config::MeshOptions& mesh = sheet.deforms ? options.shells[sheet.part].mesh : options.bodies[sheet.part].mesh;
    refusing_at(mesh.mark, [&] {
      check_sheet_inside(options, sheet, std::span(positions).subspan(sheet.first_vertex, sheet.vertices));
    });
  }
}

void check_sheets_inside(const grid::Grid& grid, const config::Case& options, const Structure& structure)
{
  if (grid.kind() != grid::Kind::Curvilinear)
    return;
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  const std::vector<grid::Standing> standings = grid::standings(grid, positions);
  for (const SheetRange& sheet : structure.sheets()) {
    const config::MeshOptions& mesh = sheet.deforms ? options.shells[sheet.part].mesh : options.bodies[sheet.part].mesh;
    refusing_at(mesh.mark, [&] {
      check_sheet_in_grid(options, sheet, std::span(positions).subspan(sheet.first_vertex, sheet.vertices),
                          std::span(standings).subspan(sheet.first_vertex, sheet.vertices));
    });
  }
}

void check_flow(const grid::Grid& grid, const config::Case& options)
{
  check_initial_velocity(grid, options.fluid->initial);
  refusing_at(options.boundary.mark, [&] { check_sides(grid, options); });
}

}  // namespace luff::simulation
