// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/build_nodes.hpp"

#include <numbers>

#include "core/error.hpp"
#include "grid/axis.hpp"
#include "grid/files/grid_file.hpp"
#include "grid/files/point_list.hpp"
#include "grid/finite_nodes.hpp"
#include "grid/generators/aorta.hpp"
#include "grid/generators/mapped_box.hpp"
#include "grid/generators/pipe.hpp"
#include "simulation/refusal.hpp"

namespace luff::simulation {

namespace {

using config::GridKind;

std::vector<double> stations(const grid::AxisSpec& spec, const config::Mark& mark, const std::string& name)
{
  return refusing_at(mark, [&] {
    if (spec.refine && (spec.refine->from < spec.from || spec.refine->to > spec.to))
      fail_input("grid.{}.refine = [{:.6g}, {:.6g}] must lie between {:.6g} and {:.6g}", name, spec.refine->from,
                 spec.refine->to, spec.from, spec.to);
    return grid::face_coordinates(spec, name);
  });
}

std::optional<grid::Refinement> refinement(const std::optional<config::RefineOptions>& options)
{
  return options ? std::optional(grid::Refinement{options->from, options->to, options->spacing}) : std::nullopt;
}

std::vector<double> build_stations(const config::CellsOptions& options, double from, double to, const std::string& name)
{
  return stations({from, to, options.cells, refinement(options.refine)}, options.mark, name);
}

double radians(double degrees)
{
  return degrees * std::numbers::pi / 180.0;
}

grid::Centreline build_centreline(const config::GridOptions& options)
{
  if (options.centreline)
    return grid::Centreline::through(grid::read_points(*options.centreline));
  grid::Centreline line(grid::frame_along(options.start, options.direction));
  if (options.kind == GridKind::Pipe)
    line.add_straight(options.length);
  for (const config::PieceOptions& piece : options.pieces)
    if (piece.length)
      line.add_straight(*piece.length);
    else
      line.add_bend(piece.bend->radius, radians(piece.bend->angle), piece.bend->towards);
  return line;
}

grid::CurvilinearNodes build_pipe(const config::GridOptions& options)
{
  const grid::Centreline line = build_centreline(options);
  return grid::make_pipe({.centreline = line,
                          .stations = build_stations(options.along, 0.0, line.length(), "along"),
                          .across = options.across,
                          .radius = [r = options.radius](double s) { return r.evaluate(Vec3::Zero(), s); }});
}

grid::CurvilinearNodes build_aorta(const config::GridOptions& options)
{
  const double R = options.annulus_radius;
  std::vector<double> along = build_stations(options.along, grid::aorta_inlet * R, grid::aorta_outlet() * R, "along");
  for (double& s : along)
    s /= R;
  return grid::make_aorta(along, options.across, R);
}

grid::CurvilinearNodes build_annulus(const config::GridOptions& options)
{
  const double from = radians(options.angle.from);
  const double to = radians(options.angle.to);
  return grid::make_annulus(
      {.start = grid::frame_along(options.start, options.direction),
       .radii = build_stations(options.outwards, options.inner_radius, options.outer_radius, "outwards"),
       .angles = grid::face_coordinates({from, to, options.around, std::nullopt}, "around"),
       .heights = build_stations(options.along, 0.0, options.length, "along")});
}

grid::CurvilinearNodes build_channel(const config::GridOptions& options)
{
  auto [x, y, z] = build_coordinates(options);
  std::vector<double> fractions;
  for (const double value : y)
    fractions.push_back((value - y.front()) / (y.back() - y.front()));
  const auto wall = [](const config::Expression& law) {
    return [law](double at) { return law.evaluate({at, 0.0, 0.0}, 0.0); };
  };
  return grid::make_channel({.x = std::move(x),
                             .fractions = std::move(fractions),
                             .z = std::move(z),
                             .lower = wall(options.lower),
                             .upper = wall(options.upper)});
}

grid::CurvilinearNodes read_nodes(const config::GridOptions& options)
{
  grid::CurvilinearNodes read = grid::open_grid_file(options.path);
  return {read.cells, [source = read.source, scale = options.scale](const IndexBox& box) {
            std::vector<Vec3> nodes = source(box);
            for (Vec3& x : nodes)
              x *= scale;
            return nodes;
          }};
}

grid::CurvilinearNodes build_unchecked(const config::GridOptions& options)
{
  switch (options.kind) {
    case GridKind::Pipe:
    case GridKind::BentPipe:
      return build_pipe(options);
    case GridKind::Aorta:
      return build_aorta(options);
    case GridKind::Annulus:
      return build_annulus(options);
    case GridKind::Channel:
      return build_channel(options);
    case GridKind::File:
      return read_nodes(options);
    case GridKind::Box:
    case GridKind::MappedBox:
      break;
  }
  return grid::make_mapped_box(build_coordinates(options),
                               [map = options.map](const Vec3& x) { return map.evaluate(x, 0.0); });
}

/// What the nodes come from, for messages.
std::string origin(const config::GridOptions& options)
{
  return options.kind == GridKind::File ? options.path.string() : "grid";
}

}  // namespace

std::array<std::vector<double>, 3> build_coordinates(const config::GridOptions& options)
{
  std::array<std::vector<double>, 3> faces;
  for (int a = 0; a < 3; ++a) {
    const config::AxisOptions& axis = options.axes[a];
    faces[a] = stations({axis.from, axis.to, axis.cells, refinement(axis.refine)}, axis.mark, std::string(1, "xyz"[a]));
  }
  return faces;
}

grid::CurvilinearNodes build_nodes(const config::GridOptions& options)
{
  return refusing_at(options.mark, [&]() -> grid::CurvilinearNodes {
    const grid::CurvilinearNodes nodes = build_unchecked(options);
    return {nodes.cells, grid::finite_nodes(nodes.source, origin(options))};
  });
}

Index3 cells_of(const config::GridOptions& options)
{
  if (is_curvilinear(options.kind))
    return build_nodes(options).cells;
  return {options.axes[0].cells, options.axes[1].cells, options.axes[2].cells};
}

}  // namespace luff::simulation
