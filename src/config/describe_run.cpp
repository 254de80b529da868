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
    options.boundary.curvilinear = is_curvilinear(options.grid.kind);
    s.table("boundary", options.boundary, {.doc = "Conditions on the six sides of the grid.", .required = true});
  });
  s.list("shell", options.shells, {.doc = "A thin flexible shell; any number of them."});
  s.list("body", options.bodies, {.doc = "A rigid thin sheet or closed body; any number of them."});
  const Analysis analysis = options.structure.analysis;
  s.when(analysis == Analysis::Dynamic || analysis == Analysis::Static,
         "`structure.analysis = \"dynamic\"` or `\"static\"`", [&] {
           s.table(
               "contact", options.contact,
               {.doc = "Contact of shells with each other, with themselves and with bodies. Absent: they pass through "
                       "each other unnoticed."});
         });
  s.table("pressure", options.pressure, {.doc = "How the pressure is solved for."});
  s.table("immersed", options.immersed, {.doc = "How the flow sees surfaces."});
  s.table("coupling", options.coupling, {.doc = "How flow and shells find each other in a time step."});
  s.table("output", options.output,
          {.doc = "What is written, besides `log.txt`, `steps.csv`, forces and `summary.json`."});
}

namespace {

void describe_equilibria(Schema& s, StructureOptions& structure)
{
  const bool modes = structure.analysis == Analysis::Modes;
  s.when(modes, "`analysis = \"modes\"`", [&] {
    s.key("modes", structure.modes, {.doc = "How many, the lowest ones.", .range = at_least_one});
    s.key("preload", structure.preload,
          {.doc = "Vibrations about the equilibrium under the loads, found as by `static`, instead of the reference "
                  "configuration without loads."});
  });
  s.when(structure.analysis != Analysis::Dynamic && (!modes || structure.preload),
         "`static`, `arc-length`, `displacement-control` or `preload`", [&] {
           s.key("steps", structure.steps,
                 {.doc = "Equal steps; shortened where one fails, and lengthened again. `arc-length`: the first step "
                         "is as long "
                         "as the first of so many load steps would be.",
                  .range = at_least_one});
         });
  s.when(structure.analysis == Analysis::Static, "`analysis = \"static\"`", [&] {
    s.key("stabilisation", structure.stabilisation,
          {.doc = "Where the shell cannot carry more: `none`, the run fails; `damping`, it moves on, damped, until it "
                  "rests in the next stable equilibrium."});
  });
  s.when(structure.analysis == Analysis::ArcLength, "`analysis = \"arc-length\"`", [&] {
    s.key("max_steps", structure.max_steps,
          {.doc = "The run fails when so many steps do not reach the whole load.", .range = at_least_one});
  });
  s.when(structure.analysis == Analysis::DisplacementControl, "`analysis = \"displacement-control\"`", [&] {
    s.table("control", structure.control,
            {.doc = "The displacement that is prescribed; only with a single shell.", .required = true});
  });
}

void describe_time_scheme(Schema& s, StructureOptions& structure)
{
  s.when(structure.analysis == Analysis::Dynamic, "`analysis = \"dynamic\"`", [&] {
    s.key("scheme", structure.scheme,
          {.doc =
               "Scheme in time: `newmark`, the average acceleration; `generalised-alpha`, which damps what the steps "
               "do not resolve; `midpoint`, which keeps linear and angular momentum; `auto`, `generalised-alpha` where "
               "there is a flow, else `newmark`."});
    s.when(structure.scheme == StructureScheme::Newmark, "`scheme = \"newmark\"`", [&] {
      s.key(
          "numerical_damping", structure.numerical_damping,
          {.doc = "a in beta = (1 + a)^2/4, gamma = 1/2 + a: damps all frequencies and leaves the scheme first order; "
                  "0: none, second order.",
           .range = {.low = 0.0, .high = 1.0}});
    });
    s.when(structure.scheme == StructureScheme::GeneralisedAlpha, "`scheme = \"generalised-alpha\"`", [&] {
      s.key("rho_inf", structure.rho_inf,
            {.doc = "What a step leaves of the frequencies it does not resolve.", .range = {.low = 0.0, .high = 1.0}});
    });
  });
}

}  // namespace

void describe(Schema& s, StructureOptions& structure)
{
  s.key("analysis", structure.analysis,
        {.doc = "`dynamic`: motion in time. The others, only without a fluid, find equilibria under loads that grow in "
                "proportion from nothing to what they are at t = 1. `static`: by equal load steps. `arc-length`: along "
                "the path of equilibria, through limit points and snap-back, until it first reaches the whole load. "
                "`displacement-control`: by equal steps of a displacement, the load following. `modes`: natural "
                "frequencies and modes."});
  describe_equilibria(s, structure);
  s.key(
      "solver", structure.solver,
      {.doc = "Linear solver in Newton's method: a sparse factorisation, conjugate gradients, or these with incomplete "
              "Cholesky. The iterative ones only where shells neither buckle nor snap."});
  describe_time_scheme(s, structure);
  s.key("fold_limit", structure.fold_limit,
        {.doc = "The run ends where a shell folds by more than this over an edge of its mesh. The element resists a "
                "fold most at 90 degrees and less beyond: above 75, refine the mesh, or know what you do.",
         .unit = "degrees",
         .range = {.low = 0.0, .high = 180.0, .with_low = false}});
}

void describe(Schema& s, ContactOptions& contact)
{
  s.mark(contact.mark);
  s.key("distance", contact.distance,
        {.doc = "Distance of two surfaces where they begin to push each other apart; at most the mean edge length of a "
                "shell's mesh. About the thickness is a good choice.",
         .unit = "m",
         .range = positive,
         .required = true});
  s.key(
      "stiffness", contact.stiffness,
      {.doc = "Pressure between surfaces at about half that distance; more, the closer they come. The largest pressure "
              "that will press them together is a good choice.",
       .unit = "Pa",
       .range = positive,
       .required = true});
  s.key("self", contact.self,
        {.doc = "Whether parts of one connected surface push each other, too, or only different surfaces."});
}

void describe(Schema& s, ControlOptions& control)
{
  s.mark(control.mark);
  s.table("where", control.where, {.doc = "Vertices whose mean displacement is prescribed.", .required = true});
  s.key("component", control.component, {.doc = "Which component of it.", .required = true});
  s.key("displacement", control.displacement, {.doc = "Its value at the last step.", .unit = "m", .required = true});
  s.rule(control.displacement != 0.0, "displacement", "must not be 0");
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
  s.key("scheme", immersed.scheme,
        {.doc = "`cut-link`: differences across a surface end on it. `curvib`: the velocity of the cells beside a "
                "surface is reconstructed along its normal."});
  s.key("edges", immersed.edges,
        {.doc = "What free edges of sheets cover. `whole`: the faces of the grid whose link of centres the sheet "
                "crosses, so that its length is a whole number of cells. `partial`: the sheet fades out over one cell "
                "beyond its edge; sheets that move feel quieter forces, and errors fall evenly as grids are refined."});
  s.rule(immersed.scheme == ImmersedScheme::CutLink || immersed.edges == EdgeCover::Whole, "edges",
         "must be \"whole\" with `scheme = \"curvib\"`");
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
  s.table("walls", output.walls,
          {.doc = "Sides of type `wall`, for ParaView: shear stress and pressure by face. Absent: not written."});
  s.table("checkpoint", output.checkpoint,
          {.doc = "Everything that the run can go on from, with `luff run CASE --restart RUN`; the last two are kept. "
                  "Absent: only when a run is stopped or fails. Not of modes."});
  s.key("audit", output.audit,
        {.doc = "Steps between audits of the forces of the flow: their sum over a surface against the momentum of the "
                "fluid around it (`audit.csv`, `force_mismatch` in `steps.csv`, `audit` in the summary), and of what "
                "changes the flow's energy. 0: none.",
         .range = not_negative});
  s.key("plots", output.plots, {.doc = "Make the pictures of `luff plot` when the run ends."});
  s.list("probe", output.probes, {.doc = "A point whose history is written in every step."});
  s.table("statistics", output.statistics,
          {.doc = "Means over time: velocity and pressure with their fluctuations, and the shear on surfaces and walls "
                  "whose files are written. Absent: none."});
  s.list("rake", output.rakes, {.doc = "Velocity and pressure at points in a row."});
  s.list("section", output.sections, {.doc = "Force of the flow on strips of a shell or body, per length."});
  s.list("slice", output.slices, {.doc = "The flow in a plane, for ParaView."});
  s.list("isosurface", output.isosurfaces, {.doc = "The surface where a field has one value, for ParaView."});
}

namespace {

void describe_every(Schema& s, double& every, std::string_view doc = "Time between two files.")
{
  s.key("every", every, {.doc = doc, .unit = "s", .range = positive, .required = true});
}

constexpr std::string_view every_instant = "Time between two instants.";

}  // namespace

void describe(Schema& s, FieldOutputOptions& fields)
{
  describe_every(s, fields.every);
  s.key("what", fields.what, {.doc = "Fields to write."});
}

void describe(Schema& s, ShellOutputOptions& shells)
{
  describe_every(s, shells.every);
}

void describe(Schema& s, WallOutputOptions& walls)
{
  describe_every(s, walls.every);
}

void describe(Schema& s, CheckpointOutputOptions& checkpoint)
{
  s.key("every", checkpoint.every,
        {.doc = "Time between two checkpoints; under a growing load, the number of equilibria, over all shells, from "
                "one to the next.",
         .unit = "s or -",
         .range = positive,
         .required = true});
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

void describe(Schema& s, StatisticsOptions& statistics)
{
  s.key("start", statistics.start,
        {.doc = "They begin with the first step from then on: after what the start of the run leaves has gone.",
         .unit = "s",
         .range = not_negative});
  s.key(
      "every", statistics.every,
      {.doc = "Time between two files of the flow's. Absent: one when the run ends.", .unit = "s", .range = positive});
}

void describe(Schema& s, RakeOptions& rake)
{
  describe_name(s, rake.name, "Its name in messages and in the name of its file; no two rakes share one.");
  s.key("from", rake.from, {.doc = "First point.", .unit = "m", .required = true});
  s.key("to", rake.to, {.doc = "Last point.", .unit = "m", .required = true});
  s.key("points", rake.points,
        {.doc = "How many, evenly spaced, both ends among them.", .range = {.low = 2}, .required = true});
  describe_every(s, rake.every, every_instant);
}

void describe(Schema& s, SectionOptions& section)
{
  describe_name(s, section.name, "Its name in messages and in the name of its file; no two sections share one.");
  s.key("shell", section.shell, {.doc = "The shell or body.", .required = true});
  s.key("axis", section.axis,
        {.doc = "Direction, of any length, that the surface is divided along.", .required = true});
  s.rule(!section.axis.isZero(0.0), "axis", "must not be zero");
  s.key("bins", section.bins,
        {.doc = "Strips of equal width from one end of the undeformed surface to the other. They are of material: they "
                "move with it.",
         .range = at_least_one,
         .required = true});
  describe_every(s, section.every, every_instant);
}

void describe(Schema& s, SliceOptions& slice)
{
  describe_name(s, slice.name, "Its name in messages and in the names of its files; no two slices share one.");
  s.key("point", slice.point, {.doc = "A point of the plane.", .unit = "m", .required = true});
  s.key("normal", slice.normal, {.doc = "Its normal, of any length.", .required = true});
  s.rule(!slice.normal.isZero(0.0), "normal", "must not be zero");
  s.key("what", slice.what, {.doc = "Fields to write."});
  describe_every(s, slice.every);
}

void describe(Schema& s, IsosurfaceOptions& isosurface)
{
  describe_name(s, isosurface.name,
                "Its name in messages and in the names of its files; no two isosurfaces share one.");
  s.key("of", isosurface.of, {.doc = "The field; of a vector its magnitude."});
  s.key("value", isosurface.value, {.doc = "Its value on the surface.", .required = true});
  s.key("what", isosurface.what, {.doc = "Fields to write on it."});
  describe_every(s, isosurface.every);
}

}  // namespace luff::config
