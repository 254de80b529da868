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
