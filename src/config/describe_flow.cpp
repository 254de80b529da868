// SPDX-License-Identifier: BSD-3-Clause
// Keys of [time], [fluid], [grid] and [boundary].
#include "config/describe.hpp"

#include <cmath>

#include <fmt/core.h>

namespace luff::config {

void describe(Schema& s, TimeOptions& time)
{
  s.key("end", time.end,
        {.doc = "The run starts at t = 0 and ends here.", .unit = "s", .range = positive, .required = true});
  s.key("step", time.step,
        {.doc = "Time step; with `cfl`, its upper bound.",
         .unit = "s",
         .range = positive,
         .required = true,
         .scaling = Scaling::Size});
  s.key("cfl", time.cfl,
        {.doc = "Choose the step so that the largest sum of |U_d| dt / h_d over the directions stays at this number. "
                "Absent: the step is constant.",
         .range = positive});
  s.key("scheme", time.scheme, {.doc = "Time scheme of the flow: three-stage Runge-Kutta with implicit cut links."});
}

void describe(Schema& s, FluidOptions& fluid)
{
  s.key("density", fluid.density, {.doc = "Density.", .unit = "kg/m^3", .range = positive, .required = true});
  s.key("viscosity", fluid.viscosity,
        {.doc = "Dynamic viscosity.", .unit = "Pa s", .range = positive, .required = true});
  s.key("body_force", fluid.body_force, {.doc = "Force per volume.", .unit = "N/m^3"});
  s.table("initial", fluid.initial, {.doc = "The flow at t = 0."});
  s.later({"turbulence"});
}

void describe(Schema& s, InitialOptions& initial)
{
  s.mark(initial.mark);
  s.key("velocity", initial.velocity, {.doc = "Velocity at t = 0; it is made divergence-free.", .unit = "m/s"});
}

void describe(Schema& s, GridOptions& grid)
{
  s.mark(grid.mark);
  static constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  s.key("kind", grid.kind, {.doc = "A box with cells of the sizes that its three axes give."});
  s.tables(axes, grid.axes, {.doc = "Cells along this axis.", .required = true});
  s.later({"path"});
}

void describe(Schema& s, AxisOptions& axis)
{
  s.mark(axis.mark);
  s.key("from", axis.from, {.doc = "Low end.", .unit = "m", .required = true});
  s.key("to", axis.to, {.doc = "High end.", .unit = "m", .required = true});
  s.key("cells", axis.cells,
        {.doc = "Number of cells, those of `refine` included. A flow in a plane: one cell, or a few, between sides of "
                "symmetry.",
         .range = at_least_one,
         .required = true,
         .scaling = Scaling::Count});
  s.rule(axis.from < axis.to, "to", "must be greater than `from`");
  s.table("refine", axis.refine,
          {.doc = "A stretch of equal cells; outside, cells grow towards the ends. Absent: all cells are equal."});
  if (!axis.refine)
    return;
  const auto& refine = *axis.refine;
  const double cells = std::ceil((refine.to - refine.from) / refine.spacing * (1.0 - 1e-12));
  const double cells_outside = (refine.from > axis.from ? 1 : 0) + (refine.to < axis.to ? 1 : 0);
  s.rule(refine.from >= axis.from && refine.to <= axis.to, "refine", "must lie between `from` and `to`");
  s.rule(cells + cells_outside <= axis.cells, "refine", "must leave a cell for each end",
         fmt::format(": it takes {} of the {} cells", cells, axis.cells));
}

void describe(Schema& s, RefineOptions& refine)
{
  s.key("from", refine.from, {.doc = "Low end of the stretch.", .unit = "m", .required = true});
  s.key("to", refine.to, {.doc = "High end of the stretch.", .unit = "m", .required = true});
  s.key("spacing", refine.spacing,
        {.doc = "Size of its cells.", .unit = "m", .range = positive, .required = true, .scaling = Scaling::Size});
  s.rule(refine.from < refine.to, "to", "must be greater than `from`");
}

void describe(Schema& s, BoundaryOptions& boundary)
{
  s.mark(boundary.mark);
  s.tables(side_names, boundary.sides, {.doc = "Condition on this side of the grid.", .required = true});
}

void describe(Schema& s, SideOptions& side)
{
  s.key("type", side.type,
        {.doc = "`velocity`: given by `value` or `flow_rate`; `wall`: no slip, moving with `value`; `slip`: no flow "
                "through, no shear; `symmetry`: mirror plane; `periodic`: joined to the opposite side; `outflow`: zero "
                "gradient, corrected to conserve mass; `pressure`: given, the fluid goes in or out.",
         .required = true});
  const bool has_value = side.type == SideType::Velocity || side.type == SideType::Wall;
  s.when(has_value, "`type = \"velocity\"` or `type = \"wall\"`", [&] {
    s.key("value", side.value,
          {.doc = "Velocity of the fluid, or of the wall. Absent on a wall: it is at rest.", .unit = "m/s"});
  });
  s.when(side.type == SideType::Velocity, "`type = \"velocity\"`", [&] {
    s.key("flow_rate", side.flow_rate,
          {.doc = "Volume that enters per time, spread over the side by `profile`; negative: that leaves.",
           .unit = "m^3/s",
           .time_only = true});
    s.rule(side.value.has_value() != side.flow_rate.has_value(), "flow_rate",
           "or `value` must be given, one of the two");
  });
  s.when(side.flow_rate.has_value(), "`flow_rate`", [&] {
    s.key("profile", side.profile,
          {.doc = "`plug`: the same velocity everywhere; `parabolic`: the developed steady flow of the section, "
                  "whatever its shape, zero at the walls around it; `womersley`: the developed periodic flow."});
  });
  s.when(side.profile == InflowShape::Womersley, "`profile = \"womersley\"`", [&] {
    s.key("period", side.period, {.doc = "Period of the flow rate.", .unit = "s", .range = positive, .required = true});
  });
  s.when(side.type == SideType::Pressure, "`type = \"pressure\"`", [&] {
    s.key("pressure", side.pressure,
          {.doc = "Pressure on the side, counted from any level; `outflow` is 0.", .unit = "Pa", .required = true});
    s.key(
        "entering", side.entering,
        {.doc = "Fluid that enters comes from a `reservoir` at rest, whose pressure (total) is given: stable whatever "
                "the flow does; or it is `developed`, with the velocity that it has inside, and the pressure is the "
                "static one: for a flow that keeps its direction."});
  });
}

}  // namespace luff::config
