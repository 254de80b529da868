// SPDX-License-Identifier: BSD-3-Clause
// What is read from a case file, what is written back, and what the command line changes.
#include <sstream>

#include "case_text.hpp"

namespace luff::config {
namespace {

Case every_key()
{
  return load_case(data_folder / "every-key.toml");
}

std::string written(const Case& options)
{
  std::ostringstream out;
  write_case(options, out);
  return out.str();
}

TEST(ACaseFile, SetsTimeFluidGridAndBoundary)
{
  const Case c = every_key();
  EXPECT_EQ(c.title, "Every key");
  EXPECT_EQ(c.time, (TimeOptions{20.0, 0.004, 0.5, TimeScheme::Rk3}));
  ASSERT_TRUE(c.fluid);
  EXPECT_EQ(c.fluid->density, 2.0);
  EXPECT_EQ(c.fluid->viscosity, 0.005);
  EXPECT_DOUBLE_EQ(c.fluid->body_force.evaluate(Vec3::Zero(), 0.5)[2], 3.0);
  EXPECT_EQ(c.fluid->initial.velocity.evaluate(Vec3(2.0, 3.0, 0.0), 0.0), Vec3(1.0, 7.0, 0.0));
  EXPECT_EQ(c.grid.axes[0], (AxisOptions{-2.0, 8.0, 160, RefineOptions{-0.3, 1.6, 0.02}}));
  EXPECT_EQ(c.grid.axes[2], (AxisOptions{-2.0, 2.0, 100, std::nullopt}));
  EXPECT_EQ(c.boundary.sides[0].type, SideType::Velocity);
  EXPECT_EQ(c.boundary.sides[0].value->evaluate(Vec3(0.0, 2.0, 0.0), 0.0), Vec3(-3.0, 0.0, 0.0));
  EXPECT_EQ(c.boundary.sides[1].type, SideType::Outflow);
  EXPECT_EQ(c.boundary.sides[2].type, SideType::Wall);
  EXPECT_EQ(c.boundary.sides[3].type, SideType::Slip);
  EXPECT_EQ(c.boundary.sides[5].type, SideType::Periodic);
}

TEST(ACaseFile, SetsShellsAndBodies)
{
  const Case c = every_key();
  ASSERT_EQ(c.shells.size(), 6u);
  const ShellOptions& flag = c.shells[0];
  EXPECT_EQ(flag.name, "flag");
  EXPECT_EQ(flag.mesh.shape, MeshShape::Rectangle);
  EXPECT_EQ(flag.mesh.origin, Vec3(0.0, 0.0, -0.5));
  EXPECT_EQ(flag.mesh.divisions, (std::array<int, 2>{20, 10}));
  EXPECT_EQ(flag.mesh.pattern, MeshPattern::Alternating);
  EXPECT_EQ(flag.placement.rotate, (RotateOptions{Vec3(0, 0, 1), 18.0, Vec3(0, 0, 1)}));
  EXPECT_EQ(flag.placement.scale, 0.5);
  EXPECT_EQ(flag.placement.translate, Vec3(0.25, 0.0, 0.0));
  EXPECT_EQ(flag.material, (MaterialOptions{MaterialModel::SaintVenantKirchhoff, 1e6, 0.4}));
  EXPECT_EQ(flag.bending, BendingElement::Patch4);
  EXPECT_EQ(flag.membrane, MembraneElement::Smoothed);
  EXPECT_EQ(flag.damping, (DampingOptions{0.1, 1e-3}));
  EXPECT_EQ(flag.gravity, Vec3(0.0, -9.81, 0.0));
  EXPECT_EQ(flag.supports[0].type, SupportType::Clamped);
  EXPECT_EQ(flag.supports[1].fixed, (std::vector{Component::X, Component::Z}));
  EXPECT_EQ(flag.mass, MassMatrix::Lumped);
  EXPECT_EQ(flag.supports[1].motion->translation.evaluate(Vec3(2, 0, 0), 3.0), Vec3(0.0, 0.0, 0.1 * 3.0 * 2.0));
  EXPECT_EQ(flag.supports[1].motion->rotation->angle.evaluate(Vec3::Zero(), 0.5), 10.0);
  EXPECT_EQ(flag.supports[2].type, SupportType::Elastic);
  EXPECT_EQ(flag.supports[2].stiffness, Vec3(1, 2, 3));
  EXPECT_EQ(flag.supports[2].turning_stiffness, 4);
  EXPECT_EQ((*flag.supports[1].where.box)[1], Vec3(1.0, 1.0, -0.5));
  EXPECT_EQ(flag.loads[0].force->evaluate(Vec3::Zero(), 2.0), Vec3(0.0, 80.0, 0.0));
  EXPECT_EQ(flag.loads[1].pressure->evaluate(Vec3::Zero(), 1.0), 2.0);
  EXPECT_EQ(flag.loads[1].where.plane->normal, Vec3(0.0, 1.0, 0.0));
  EXPECT_EQ(c.shells[1].bending, BendingElement::Qavg);
  EXPECT_EQ(c.shells[1].membrane, MembraneElement::Cst);
  EXPECT_EQ(flag.loads[3].edge_force->evaluate(Vec3(0, 0, 3), 0.0), Vec3(0.0, 3.0, 0.0));
  EXPECT_EQ(flag.loads[4].edge_moment->evaluate(Vec3::Zero(), 2.0), 4.0);
  EXPECT_EQ(c.shells[1].mesh.file, data_folder / "leaflet.stl");
  const MotionOptions& motion = c.bodies.at(0).motion;
  EXPECT_EQ(motion.type, MotionType::Prescribed);
  EXPECT_EQ(motion.translation.evaluate(Vec3::Zero(), 0.5), Vec3(-0.2, 0.0, 0.0));
  EXPECT_EQ(motion.rotation->angle.evaluate(Vec3::Zero(), 2.0), 20.0);
}

TEST(ACaseFile, SetsMaterialsAndTheirFibres)
{
  const Case c = every_key();
  const MaterialOptions& leaflet = c.shells[1].material;
  EXPECT_EQ(leaflet.model, MaterialModel::MayNewmanYin);
  EXPECT_EQ((std::array{leaflet.c0, leaflet.c1, leaflet.c2, leaflet.c10}), (std::array{399.0, 4.325, 1446.5, 1000.0}));
  EXPECT_TRUE(leaflet.tension_only);
  EXPECT_EQ(leaflet.largest_exponent, 12.0);
  EXPECT_EQ(leaflet.thickness_points, 4);
  EXPECT_EQ(leaflet.fibre->circumference, (CircumferenceOptions{Vec3(0, 0, 1), Vec3(0.1, 0, 0)}));
  EXPECT_EQ(c.shells[2].material.shear_modulus, 1e5);
  EXPECT_EQ(c.shells[3].material.weight, 0.5);
  EXPECT_EQ(c.shells[3].material.fibre->direction, Vec3(1, 1, 0));
  EXPECT_EQ(c.shells[4].material.a23, 0.15);
  EXPECT_EQ(c.shells[4].material.fibre->field, "grain");
  EXPECT_EQ(c.shells[5].material.angle, 29.0);
}

TEST(ACaseFile, SetsSolversAndOutput)
{
  const Case c = every_key();
  EXPECT_EQ(c.structure.solver, StructureSolver::Cg);
  EXPECT_EQ(c.structure.scheme, StructureScheme::GeneralisedAlpha);
  EXPECT_EQ(c.structure.rho_inf, 0.5);
  EXPECT_EQ(c.pressure, (PressureOptions{PressureSolver::Petsc, PressureTolerance::Fast, 77}));
  EXPECT_EQ(c.coupling, (CouplingOptions{CouplingScheme::Loose, CouplingAcceleration::Aitken, 0.25, 1e-6, 12}));
  EXPECT_EQ(c.output.fields->what, (std::vector{FlowField::Velocity, FlowField::QCriterion}));
  EXPECT_EQ(c.output.shells->every, 0.1);
  EXPECT_TRUE(c.output.plots);
  EXPECT_EQ(c.output.probes[0], (ProbeOptions{"tip", "flag", Vec3(1.0, 0.0, 0.0)}));
  EXPECT_EQ(c.output.probes[1].shell, std::nullopt);
}

TEST(ASide, HasAFlowRateWithAProfileOrAPressure)
{
  const std::string text = R"case(
[time]
end = 1.0
step = 0.1
[fluid]
density = 1000
viscosity = 1e-3
[grid]
x = { from = 0, to = 1, cells = 4 }
y = { from = 0, to = 1, cells = 4 }
z = { from = 0, to = 1, cells = 4 }
[boundary]
x_min = { type = "velocity", flow_rate = "1 + sin(2*pi*t)", profile = "womersley", period = 1 }
x_max = { type = "pressure", pressure = "100*t", entering = "developed" }
y_min = { type = "wall" }
y_max = { type = "wall" }
z_min = { type = "velocity", flow_rate = 2 }
z_max = { type = "pressure", pressure = 3 }
)case";
  const Case c = load_text(text);
  const auto& sides = c.boundary.sides;
  EXPECT_EQ(sides[0].value, std::nullopt);
  EXPECT_EQ(sides[0].flow_rate->evaluate(Vec3::Zero(), 0.25), 2.0);
  EXPECT_EQ(sides[0].profile, InflowShape::Womersley);
  EXPECT_EQ(sides[0].period, 1.0);
  EXPECT_EQ(sides[1].pressure.evaluate(Vec3::Zero(), 2.0), 200.0);
  EXPECT_EQ(sides[1].entering, EnteringFluid::Developed);
  EXPECT_EQ(sides[4].profile, InflowShape::Plug);
  EXPECT_EQ(sides[5].entering, EnteringFluid::Reservoir);
  EXPECT_EQ(load_text(written(c)), c);
}

TEST(AFileOfTimes, MayBeSmoothAndPeriodic)
{
  const TemporaryFolder folder;
  folder.write("wave.csv", "0, 1\n0.5, 2\n1, 1\n");
  const auto file = folder.write("case.toml", R"(
[time]
end = 1.0
step = 0.1
[fluid]
density = 1
viscosity = 1
body_force = [{ file = "wave.csv", scale = 3, smooth = true, periodic = true }, 0, 0]
[grid]
x = { from = 0, to = 1, cells = 4 }
y = { from = 0, to = 1, cells = 4 }
z = { from = 0, to = 1, cells = 4 }
[boundary]
x_min = { type = "wall" }
x_max = { type = "wall" }
y_min = { type = "wall" }
y_max = { type = "wall" }
z_min = { type = "wall" }
z_max = { type = "wall" }
)");
  const Case c = load_case(file);
  EXPECT_NEAR(c.fluid->body_force.component[0].evaluate(Vec3::Zero(), 7.5), 6.0, 1e-13);
  EXPECT_EQ(load_text(written(c)), c);
}

const std::string strip =
    "[[shell]]\nname = \"strip\"\nthickness = 0.1\ndensity = 1\n"
    "mesh = { shape = \"rectangle\", origin = [0, 0, 0], a = [10, 0, 0], b = [0, 1, 0], divisions = [32, 4] }\n"
    "material = { model = \"saint-venant-kirchhoff\", young = 1.2e6, poisson = 0 }\n";

TEST(AShellAlone, MayFollowItsPathOfEquilibria)
{
  const Case arc = load_text(strip + "[structure]\nanalysis = \"arc-length\"\nsteps = 8\nmax_steps = 70\n");
  EXPECT_EQ(arc.structure.analysis, Analysis::ArcLength);
  EXPECT_EQ(arc.structure.max_steps, 70);
  EXPECT_EQ(load_text(written(arc)), arc);
  const Case control =
      load_text(strip +
                "[structure]\nanalysis = \"displacement-control\"\ncontrol = { where = { point = [10, 0, "
                "0] }, component = \"y\", displacement = -2.5 }\n");
  EXPECT_EQ(control.structure.control.component, Component::Y);
  EXPECT_EQ(control.structure.control.displacement, -2.5);
  EXPECT_EQ(load_text(written(control)), control);
  const Case damped = load_text(strip + "[structure]\nanalysis = \"static\"\nstabilisation = \"damping\"\n");
  EXPECT_EQ(damped.structure.stabilisation, StructureStabilisation::Damping);
  EXPECT_EQ(load_text(written(damped)), damped);
}

TEST(AShellAlone, MayVibrate)
{
  const Case c = load_text(strip + "[structure]\nanalysis = \"modes\"\nmodes = 3\n");
  EXPECT_EQ(c.structure.analysis, Analysis::Modes);
  EXPECT_EQ(c.structure.modes, 3);
  EXPECT_EQ(load_text(written(c)), c);
  const Case loaded = load_text(strip + "[structure]\nanalysis = \"modes\"\npreload = true\nsteps = 8\n");
  EXPECT_TRUE(loaded.structure.preload);
  EXPECT_EQ(loaded.structure.modes, 10);
  EXPECT_EQ(loaded.structure.steps, 8);
  EXPECT_EQ(load_text(written(loaded)), loaded);
}

TEST(AShellAlone, NeedsNoFluidNoGridAndNoBoundary)
{
  const Case c = load_text(strip + "[structure]\nanalysis = \"static\"\nsteps = 8\n");
  EXPECT_FALSE(c.fluid);
  EXPECT_EQ(c.structure.analysis, Analysis::Static);
  EXPECT_EQ(c.structure.steps, 8);
  EXPECT_EQ(load_text(written(c)), c);
}

TEST(AShellAlone, MayBeOfHenckysMaterial)
{
  const Case c = load_text(changed(strip, "saint-venant-kirchhoff", "hencky") + "[structure]\nanalysis = \"static\"\n");
  EXPECT_EQ(c.shells[0].material, (MaterialOptions{MaterialModel::Hencky, 1.2e6, 0.0}));
  EXPECT_EQ(load_text(written(c)), c);
}

TEST(AShellAlone, LeavesCheckpointsEverySoManyEquilibria)
{
  const std::string loaded = strip + "[structure]\nanalysis = \"static\"\n[output]\ncheckpoint = { every = 3 }\n";
  EXPECT_EQ(load_text(loaded).output.checkpoint->every, 3.0);
  EXPECT_EQ(complaint_about(changed(loaded, "every = 3", "every = 2.5")),
            "case.toml:10: output.checkpoint.every = 2.5 must be a whole number of equilibria unless "
            "`structure.analysis = \"dynamic\"`");
  EXPECT_EQ(complaint_about(changed(loaded, "\"static\"", "\"modes\"")),
            "case.toml:10: output.checkpoint must be left out with `structure.analysis = \"modes\"`: they are found at "
            "once");
}

TEST(AShellWithoutStiffnessAtRest, IsRefusedInAStaticAnalysis)
{
  const std::string leaflet =
      changed(strip, "model = \"saint-venant-kirchhoff\", young = 1.2e6, poisson = 0",
              "model = \"may-newman-yin\", c0 = 399, c1 = 4, c2 = 300, c10 = 0, fibre = { direction = [1, 0, 0] }") +
      "[structure]\nanalysis = \"static\"\n";
  EXPECT_EQ(complaint_about(leaflet),
            "case.toml:6: shell.0.material.c10 = 0 must be greater than 0 unless `structure.analysis = \"dynamic\"`: "
            "without it the material has no stiffness at rest");
  EXPECT_EQ(complaint_about(changed(leaflet, "c10 = 0,", "c10 = 399,")), "");
}

TEST(AWrittenCase, ReadsAsTheSameOptions)
{
  EXPECT_EQ(load_text(written(every_key())), every_key());
  EXPECT_EQ(load_text(written(load_text(small_case))), load_text(small_case));
}

TEST(AWrittenCase, KeepsEveryDigitAndAnyTitle)
{
  Case c = load_text(small_case);
  c.title = "quotes \" \\ and\nlines\tand \x01";
  c.time.end = 1.0 / 3.0;
  c.time.step = 1e-300;
  EXPECT_EQ(load_text(written(c)), c);
}

TEST(AWrittenCase, StatesTheDefaults)
{
  const auto text = written(load_text(small_case));
  for (const char* line : {"scheme = \"rk3\"", "acceleration = \"quasi-newton\"",
                           "what = [\"velocity\", \"pressure\", "
                           "\"vorticity\", \"q_criterion\"]",
                           "[shell.damping]", "solver = \"multigrid\""})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST(Assignments, ReplaceAndAddKeys)
{
  const Case c = load_text(small_case, {.sets = {"time.end = 3.5", "coupling.scheme=\"loose\"", "time.cfl=0.5",
                                                 "grid.y={ from = -1, to = 1, cells = 7 }"}});
  EXPECT_EQ(c.time.end, 3.5);
  EXPECT_EQ(c.time.cfl, 0.5);
  EXPECT_EQ(c.coupling.scheme, CouplingScheme::Loose);
  EXPECT_EQ(c.grid.axes[1], (AxisOptions{-1.0, 1.0, 7, std::nullopt}));
}

TEST(Assignments, ReachListsByIndexAndByName)
{
  const Case c =
      load_text(small_case, {.sets = {"shell.0.thickness=0.02", "shell.flag.density=3", "output.probe.0.name=end",
                                      "shell.0.load.0.force=[1, 2, \"t\"]", "shell.flag.mesh.divisions.1=5"}});
  EXPECT_EQ(c.shells[0].thickness, 0.02);
  EXPECT_EQ(c.shells[0].density, 3.0);
  EXPECT_EQ(c.output.probes[0].name, "end");
  EXPECT_EQ(c.shells[0].loads[0].force->evaluate(Vec3::Zero(), 7.0), Vec3(1.0, 2.0, 7.0));
  EXPECT_EQ(c.shells[0].mesh.divisions, (std::array<int, 2>{20, 5}));
}

TEST(Assignments, TakeWordsWithoutQuotesAndTheLastOneCounts)
{
  const Case c = load_text(small_case, {.sets = {"coupling.scheme=strong", "coupling.scheme=loose", "title=A-title"}});
  EXPECT_EQ(c.coupling.scheme, CouplingScheme::Loose);
  EXPECT_EQ(c.title, "A-title");
}

TEST(WrongAssignments, AreToldWithTheArgument)
{
  const std::pair<const char*, const char*> table[] = {
      {"time.end=-1", "time.end = -1 must be a number > 0"},
      {"time.edn=1", "time.edn is not a key of [time] (did you mean 'end'?)"},
      {"tme.end=1", "tme is not a key of a case (did you mean 'time'?)"},
      {"coupling.scheme=loos", "coupling.scheme = \"loos\" must be \"strong\" or \"loose\" (did you mean \"loose\"?)"},
      {"shell.1.density=1", "there is no entry '1': the case has 1, numbered from 0 (known: flag)"},
      {"shell.flug.density=1", "there is no entry 'flug': the case has 1, numbered from 0 (did you mean 'flag'?)"},
      {"time.end.x=1", "'x' cannot be set inside 2, which is not a table"},
      {"time.end", "must be key=value, as in time.end=2"},
      {"time.end=", "must be key=value, as in time.end=2"},
      {"time.end=[1", "Error while parsing array: encountered end-of-file"},
      {"time.end=1\ntime.step=2", "must be one key and one value"},
      {"shell=3", "shell = 3 must be a list of tables: [[shell]]"},
  };
  for (const auto& [assignment, complaint] : table)
    EXPECT_EQ(complaint_about(small_case, {.sets = {assignment}}), fmt::format("--set {}: {}", assignment, complaint));
}

TEST(Resolution, ScalesCellsDivisionsSpacingsAndTheStep)
{
  const Case c = load_text(small_case, {.sets = {"time.cfl=0.5"}, .resolution = 0.5});
  EXPECT_EQ(c.time.step, 0.02);
  EXPECT_EQ(c.time.cfl, 0.5);
  EXPECT_EQ(c.time.end, 2.0);
  EXPECT_EQ(c.grid.axes[0].cells, 50);
  EXPECT_EQ(c.grid.axes[0].refine, (RefineOptions{-0.5, 1.5, 0.08}));
  EXPECT_EQ(c.grid.axes[1].cells, 40);
  EXPECT_EQ(c.shells[0].mesh.divisions, (std::array<int, 2>{10, 5}));
  EXPECT_EQ(c.bodies[0].mesh.divisions, (std::array<int, 2>{4, 2}));
}

TEST(Resolution, LeavesOneCellAtLeast)
{
  const Case c = load_text(small_case, {.resolution = 0.001});
  EXPECT_EQ(c.grid.axes[2].cells, 1);
  EXPECT_EQ(c.bodies[0].mesh.divisions, (std::array<int, 2>{1, 1}));
}

TEST(Resolution, IsRefusedUnlessPositiveAndSensible)
{
  for (const double factor : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(complaint_about(small_case, {.resolution = factor}),
              fmt::format("--resolution {}: must be a number > 0", factor));
  EXPECT_EQ(complaint_about(small_case, {.resolution = 1e9}),
            "--resolution 1000000000: makes 100000000000 cells of 100, too many");
}

TEST(TheGuide, ShowsACaseThatIsValid)
{
  const auto guide = contents_of(std::filesystem::path(LUFF_SOURCE_DIR) / "docs/user/case-file.md");
  const std::string opening = "```toml\n";
  const auto begin = guide.find(opening) + opening.size();
  const auto example = guide.substr(begin, guide.find("```", begin) - begin);
  EXPECT_EQ(complaint_about(example), "");
  EXPECT_EQ(load_text(example).shells.at(0).name, "flag");
}

TEST(TheReference, IsTheCommittedPageOfTheManual)
{
  std::ostringstream page;
  write_reference(page, Format::Markdown);
  EXPECT_EQ(page.str(), contents_of(std::filesystem::path(LUFF_SOURCE_DIR) / "docs/user/options.md"))
      << "write it anew with: luff options --markdown > docs/user/options.md";
}

TEST(TheReference, NamesEveryKeyOfACase)
{
  std::ostringstream page;
  write_reference(page, Format::Text);
  std::istringstream text(written(every_key()));
  for (std::string line; std::getline(text, line);)
    if (const auto equals = line.find(" = "); equals != std::string::npos) {
      EXPECT_NE(page.str().find("\n  " + line.substr(0, equals) + ": "), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace luff::config
