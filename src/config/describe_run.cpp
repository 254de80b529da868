// SPDX-License-Identifier: BSD-3-Clause
// Keys of the case as a whole, of how it is solved, and of what is written.
#include "config/describe.hpp"

namespace luff::config {

void describe(Schema& s, Case& options)
{
  s.key("title", options.title, {.doc = "One line that says what the case is."});
  s.table("structure", options.structure, {.doc = "How shells are solved."});
  s.when(options.structure.analysis == Analysis::Dynamic, "`structure.analysis = \"dynamic\"`",
         [&] { s.table("time", options.time, {.doc = "From when to when, and in which steps.", .required = true}); });
  s.table("fluid", options.fluid, {.doc = "The fluid. Absent: shells alone."});
  s.when(options.fluid.has_value(), "`[fluid]`", [&] {
    s.table("grid", options.grid, {.doc = "Where the flow is computed.", .required = true});
    s.table("boundary", options.boundary, {.doc = "Conditions on the six sides of the grid.", .required = true});
  });
  s.list("shell", options.shells, {.doc = "A thin flexible shell; any number of them."});
  s.list("body", options.bodies, {.doc = "A thin rigid sheet; any number of them."});
  s.table("pressure", options.pressure, {.doc = "How the pressure is solved for."});
  s.table("immersed", options.immersed, {.doc = "How the flow sees surfaces."});
  s.table("coupling", options.coupling, {.doc = "How flow and shells find each other in a time step."});
  s.table("output", options.output,
          {.doc = "What is written, besides `log.txt`, `steps.csv`, forces and `summary.json`."});
}

void describe(Schema& s, StructureOptions& structure)
{
  s.key("analysis", structure.analysis,
        {.doc = "`dynamic`, or `static`: equilibrium under loads that grow in proportion from nothing to what they are "
                "at t = 1; "
                "only without a fluid."});
  s.when(structure.analysis == Analysis::Static, "`analysis = \"static\"`",
         [&] { s.key("steps", structure.steps, {.doc = "Equal load steps.", .range = at_least_one}); });
  s.key("solver", structure.solver,
        {.doc = "Linear solver in Newton's method: sparse Cholesky, or conjugate gradients."});
  s.key("fold_limit", structure.fold_limit,
        {.doc = "The run ends where a shell folds by more than this over an edge of its mesh. The element resists a "
                "fold most at 90 degrees and less beyond: above 75, refine the mesh, or know what you do.",
         .unit = "degrees",
         .range = {.low = 0.0, .high = 180.0, .with_low = false}});
}

void describe(Schema& s, PressureOptions& pressure)
{
  s.key("solver", pressure.solver, {.doc = "luff's own multigrid, or PETSc as an independent check."});
  s.key("tolerance", pressure.tolerance,
        {.doc = "`default`: divergence-free to round-off; `fast`: as far as the accuracy of the flow needs."});
  s.key("max_iterations", pressure.max_iterations,
        {.doc = "The run fails if more iterations are needed.", .range = at_least_one});
}

void describe(Schema& s, ImmersedOptions& immersed)
{
  s.key("scheme", immersed.scheme, {.doc = "Cut links: differences across a surface end on it."});
}

void describe(Schema& s, CouplingOptions& coupling)
{
  s.key("scheme", coupling.scheme,
        {.doc = "`strong`: iterate in each step until flow and shell agree; `loose`: one iteration, unstable for light "
                "shells."});
  s.key(
      "acceleration", coupling.acceleration,
      {.doc =
           "How the next iterate is found: interface quasi-Newton (IQN-ILS), Aitken's factor, or a constant factor."});
  s.key("relaxation", coupling.relaxation,
        {.doc = "The factor of `constant`; the first factor of the other two.",
         .range = {.low = 0.0, .high = 1.0, .with_low = false}});
  s.key("tolerance", coupling.tolerance,
        {.doc = "Largest un-relaxed residual of the displacement in a step, relative to the size of the largest shell.",
         .range = {.low = 0.0, .high = 1.0, .with_low = false, .with_high = false}});
  s.key("max_iterations", coupling.max_iterations,
        {.doc = "The run fails if more iterations are needed.", .range = at_least_one});
}

void describe(Schema& s, OutputOptions& output)
{
  s.table("fields", output.fields, {.doc = "The flow, for ParaView. Absent: not written."});
  s.table("shells", output.shells,
          {.doc = "Shells and bodies, for ParaView: displacement, velocity, traction and shear on each side. Absent: "
                  "not written."});
  s.key("plots", output.plots, {.doc = "Make the pictures of `luff plot` when the run ends."});
  s.list("probe", output.probes, {.doc = "A point whose history is written in every step."});
  s.later({"checkpoint"});
}

void describe(Schema& s, FieldOutputOptions& fields)
{
  s.key("every", fields.every, {.doc = "Time between two files.", .unit = "s", .range = positive, .required = true});
  s.key("what", fields.what, {.doc = "Fields to write."});
}

void describe(Schema& s, ShellOutputOptions& shells)
{
  s.key("every", shells.every, {.doc = "Time between two files.", .unit = "s", .range = positive, .required = true});
}

void describe(Schema& s, ProbeOptions& probe)
{
  describe_name(s, probe.name, "Its name in messages and in the name of its file; no two probes share one.");
  s.key("shell", probe.shell, {.doc = "The shell or body it sits on. Absent: it stands in the flow."});
  s.key("point", probe.point,
        {.doc = "Where: with `shell`, its vertex nearest to this point in the reference configuration.",
         .unit = "m",
         .required = true});
}

}  // namespace luff::config
