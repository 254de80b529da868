// SPDX-License-Identifier: BSD-3-Clause
// Keys of [time], [fluid] and [boundary].
#include "config/describe.hpp"

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
  s.key("scheme", time.scheme,
        {.doc = "Time scheme of the flow: `rk3`, explicit, with implicit cut links; `newton-krylov`, convection and "
                "diffusion implicit, for cells so thin that an explicit step would be very short."});
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

void describe(Schema& s, BoundaryOptions& boundary)
{
  s.mark(boundary.mark);
  s.tables(
      boundary.names(), boundary.sides,
      {.doc = "Condition on this side of the grid. The sides of all kinds of grid but boxes are named by their index "
              "directions: `xi_min`, `xi_max`, `eta_min`, `eta_max`, `zeta_min`, `zeta_max`.",
       .required = true});
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
