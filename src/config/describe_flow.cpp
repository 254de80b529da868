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
        {.doc = "`velocity`: given by `value`; `wall`: no slip, moving with `value`; `slip`: no flow through, no "
                "shear; `symmetry`: mirror plane; `periodic`: joined to the opposite side; `outflow`: zero gradient, "
                "corrected to conserve mass.",
         .required = true});
  const bool has_value = side.type == SideType::Velocity || side.type == SideType::Wall;
  s.when(has_value, "`type = \"velocity\"` or `type = \"wall\"`", [&] {
    s.key("value", side.value,
          {.doc = "Velocity of the fluid (`velocity`, where it must be given) or of the wall.",
           .unit = "m/s",
           .required = side.type == SideType::Velocity});
  });
  s.later({"flow_rate", "profile"});
}

}  // namespace luff::config
