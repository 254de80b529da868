// SPDX-License-Identifier: BSD-3-Clause
// Keys of [grid].
#include "config/describe.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace luff::config {

namespace {

using enum GridKind;

bool is_one_of(GridKind kind, std::initializer_list<GridKind> kinds)
{
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

void describe_box(Schema& s, GridOptions& grid)
{
  static constexpr std::array<const char*, 3> names{"x", "y", "z"};
  s.when(is_one_of(grid.kind, {Box, MappedBox, Channel}), "`kind = \"box\"`, `\"mapped-box\"` or `\"channel\"`",
         [&] { s.tables(names, grid.axes, {.doc = "Cells along this axis.", .required = true}); });
  s.when(grid.kind == MappedBox, "`kind = \"mapped-box\"`", [&] {
    s.key("map", grid.map,
          {.doc = "Where the node at (x, y, z) of the box goes.", .unit = "m", .required = true, .of = "xyz"});
  });
}

void describe_curve(Schema& s, GridOptions& grid)
{
  s.when(is_one_of(grid.kind, {Pipe, BentPipe, Annulus}), "`kind = \"pipe\"`, `\"bent-pipe\"` or `\"annulus\"`", [&] {
    s.key("start", grid.start, {.doc = "Centre of the first end.", .unit = "m"});
    s.key(
        "direction", grid.direction,
        {.doc = "Direction of the axis, of any length; of a bent pipe where it starts, unless `centreline` says it."});
    s.rule(!grid.direction.isZero(0.0), "direction", "must not be zero");
  });
  s.when(is_one_of(grid.kind, {Pipe, Annulus}), "`kind = \"pipe\"` or `\"annulus\"`", [&] {
    s.key("length", grid.length, {.doc = "Length along the axis.", .unit = "m", .range = positive, .required = true});
  });
  s.when(grid.kind == BentPipe, "`kind = \"bent-pipe\"`", [&] {
    s.exactly_one_of({"piece", "centreline"});
    s.list(
        "piece", grid.pieces,
        {.doc = "A piece of the centreline, which begins where the last one ends and in its direction; any number of "
                "them."});
    s.key("centreline", grid.centreline,
          {.doc = "File of the points through which the centreline goes as a cubic spline: x, y, z on each line."});
  });
}

void describe_pipe(Schema& s, GridOptions& grid)
{
  s.when(is_one_of(grid.kind, {Pipe, BentPipe}), "`kind = \"pipe\"` or `\"bent-pipe\"`", [&] {
    s.key("radius", grid.radius,
          {.doc = "Radius, of the arc length s from the first end.", .unit = "m", .required = true, .of = "s"});
  });
  s.when(is_one_of(grid.kind, {Pipe, BentPipe, Aorta}), "`kind = \"pipe\"`, `\"bent-pipe\"` or `\"aorta\"`", [&] {
    s.key("across", grid.across,
          {.doc = "Cells from wall to wall, in both directions of the section: xi and eta; zeta goes along.",
           .range = at_least_one,
           .required = true,
           .scaling = Scaling::Count});
  });
  s.when(is_one_of(grid.kind, {Pipe, BentPipe, Aorta, Annulus}),
         "`kind = \"pipe\"`, `\"bent-pipe\"`, `\"aorta\"` or `\"annulus\"`", [&] {
           s.table(
               "along", grid.along,
               {.doc = "Cells along the axis, by arc length from the first end (of an aorta: from the annulus, whose "
                       "plane is z = 0).",
                .required = true});
         });
  s.when(grid.kind == Aorta, "`kind = \"aorta\"`", [&] {
    s.key(
        "annulus_radius", grid.annulus_radius,
        {.doc = "Radius of the annulus, to which all sizes of the vessel are in proportion; 0.0127 is a human's. From "
                "1.575 radii before the annulus to 18.15 after it.",
         .unit = "m",
         .range = positive,
         .required = true});
  });
}

void describe_annulus(Schema& s, GridOptions& grid)
{
  s.when(grid.kind == Annulus, "`kind = \"annulus\"`", [&] {
    s.key("inner_radius", grid.inner_radius,
          {.doc = "Radius of the inner cylinder.", .unit = "m", .range = positive, .required = true});
    s.key("outer_radius", grid.outer_radius,
          {.doc = "Radius of the outer cylinder.", .unit = "m", .range = positive, .required = true});
    s.rule(grid.inner_radius < grid.outer_radius, "inner_radius", "must be less than `outer_radius`");
    s.table("outwards", grid.outwards, {.doc = "Cells between the cylinders (xi), by radius.", .required = true});
    s.key("around", grid.around,
          {.doc = "Cells around (eta). All round, `eta_min` and `eta_max` are `periodic`.",
           .range = at_least_one,
           .required = true,
           .scaling = Scaling::Count});
    s.table("angle", grid.angle, {.doc = "A sector about the axis. Absent: all round."});
  });
}

void describe_channel(Schema& s, GridOptions& grid)
{
  s.when(grid.kind == Channel, "`kind = \"channel\"`", [&] {
    s.key(
        "lower", grid.lower,
        {.doc = "y of the lower wall, of x: there goes the low end of `y`.", .unit = "m", .required = true, .of = "x"});
    s.key("upper", grid.upper,
          {.doc = "y of the upper wall, of x: there goes the high end of `y`.",
           .unit = "m",
           .required = true,
           .of = "x"});
  });
}

void describe_refinement(Schema& s, std::optional<RefineOptions>& refine)
{
  s.table("refine", refine,
          {.doc = "A stretch of equal cells; outside, cells grow towards the ends. Absent: all cells are equal."});
}

void describe_count(Schema& s, int& cells)
{
  s.key("cells", cells,
        {.doc = "Number of cells, those of `refine` included. A flow in a plane: one cell, or a few, between sides of "
                "symmetry.",
         .range = at_least_one,
         .required = true,
         .scaling = Scaling::Count});
}

}  // namespace

void describe(Schema& s, GridOptions& grid)
{
  s.mark(grid.mark);
  s.key(
      "kind", grid.kind,
      {.doc = "`box`: cells of the sizes that its three axes give. The others are body-fitted: `mapped-box`, a box put "
              "elsewhere by a formula; `pipe`, round, straight; `bent-pipe`, round, along straight pieces and arcs or "
              "through points; `aorta`, a human's with its root; `annulus`, between two cylinders; `channel`, between "
              "two walls that may diverge; `file`, read."});
  describe_box(s, grid);
  describe_curve(s, grid);
  describe_pipe(s, grid);
  describe_annulus(s, grid);
  describe_channel(s, grid);
  s.when(grid.kind == File, "`kind = \"file\"`", [&] {
    s.key(
        "path", grid.path,
        {.doc = "A structured grid of VTK (.vts, .vtk) or PLOT3D (any other ending): one block, whole; text, binary or "
                "Fortran's records, single or double precision, either byte order.",
         .required = true});
    s.key("scale", grid.scale, {.doc = "Factor on the coordinates of the file.", .range = positive});
  });
}

void describe(Schema& s, AxisOptions& axis)
{
  s.mark(axis.mark);
  s.key("from", axis.from, {.doc = "Low end.", .unit = "m", .required = true});
  s.key("to", axis.to, {.doc = "High end.", .unit = "m", .required = true});
  describe_count(s, axis.cells);
  s.rule(axis.from < axis.to, "to", "must be greater than `from`");
  describe_refinement(s, axis.refine);
  if (!axis.refine)
    return;
  const auto& refine = *axis.refine;
  const double cells = std::ceil((refine.to - refine.from) / refine.spacing * (1.0 - 1e-12));
  const double cells_outside = (refine.from > axis.from ? 1 : 0) + (refine.to < axis.to ? 1 : 0);
  s.rule(refine.from >= axis.from && refine.to <= axis.to, "refine", "must lie between `from` and `to`");
  s.rule(cells + cells_outside <= axis.cells, "refine", "must leave a cell for each end",
         fmt::format(": it takes {} of the {} cells", cells, axis.cells));
}

void describe(Schema& s, CellsOptions& direction)
{
  s.mark(direction.mark);
  describe_count(s, direction.cells);
  describe_refinement(s, direction.refine);
}

void describe(Schema& s, RefineOptions& refine)
{
  s.key("from", refine.from, {.doc = "Low end of the stretch.", .unit = "m", .required = true});
  s.key("to", refine.to, {.doc = "High end of the stretch.", .unit = "m", .required = true});
  s.key("spacing", refine.spacing,
        {.doc = "Size of its cells.", .unit = "m", .range = positive, .required = true, .scaling = Scaling::Size});
  s.rule(refine.from < refine.to, "to", "must be greater than `from`");
}

void describe(Schema& s, PieceOptions& piece)
{
  s.exactly_one_of({"length", "bend"});
  s.key("length", piece.length, {.doc = "Length of a straight piece.", .unit = "m", .range = positive});
  s.table("bend", piece.bend, {.doc = "An arc of a circle."});
}

void describe(Schema& s, BendOptions& bend)
{
  s.key("radius", bend.radius, {.doc = "Radius of the centreline.", .unit = "m", .range = positive, .required = true});
  s.key("angle", bend.angle, {.doc = "By how much it turns.", .unit = "degrees", .range = positive, .required = true});
  s.key("towards", bend.towards,
        {.doc = "Where it turns to; the part along the centreline is of no account.", .required = true});
  s.rule(!bend.towards.isZero(0.0), "towards", "must not be zero");
}

void describe(Schema& s, AngleOptions& angle)
{
  constexpr double turn = 360.0;
  s.key("from", angle.from, {.doc = "Right-handed about `axis`, from `start`.", .unit = "degrees"});
  s.key("to", angle.to, {.doc = "Where it ends.", .unit = "degrees"});
  s.rule(angle.from < angle.to && angle.to - angle.from <= turn, "to", "must be above `from`, by 360 at most");
}

}  // namespace luff::config
