// SPDX-License-Identifier: BSD-3-Clause
// One test for each kind of thing that can be wrong with a case file.
#include "case_text.hpp"

namespace luff::config {
namespace {

struct BadInput {
  const char* name;
  const char* from;  ///< of small_case
  const char* to;
  const char* complaint;
};

void PrintTo(const BadInput& input, std::ostream* out)
{
  *out << input.from << " -> " << input.to;
}

class BadInputIsToldWithFileLineKeyAndRemedy : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputIsToldWithFileLineKeyAndRemedy, When)
{
  const auto& [name, from, to, complaint] = GetParam();
  EXPECT_EQ(complaint_about(changed(small_case, from, to)), complaint);
}

const BadInput keys[] = {
    {"AKeyIsMisspelt", "end = 2.0", "end = 2.0\ncfk = 0.5",
     "case.toml:4: time.cfk is not a key of [time] (did you mean 'cfl'?)"},
    {"AKeyIsUnknown", "end = 2.0", "end = 2.0\nunbelievable = 0.5",
     "case.toml:4: time.unbelievable is not a key of [time] (known: end, step, cfl, scheme)"},
    {"AKeyIsUnknownBesideAnOptionalOne", "end = 2.0", "end = 2.0\ncfl = 1\nunbelievable = 0.5",
     "case.toml:5: time.unbelievable is not a key of [time] (known: end, step, cfl, scheme)"},
    {"ATableIsMisspelt", "[output]", "[outptu]\n[output]",
     "case.toml:36: outptu is not a key of a case (did you mean 'output'?)"},
    {"AKeyOfAnInlineTableIsMisspelt", "poisson = 0.4", "poisson = 0.4, yuong = 2",
     "case.toml:25: shell.material.yuong is not a key of [shell.material] (did you mean 'young'?)"},
    {"AKeyIsMissing", "step = 0.01\n", "", "case.toml:2: time.step is missing: give a number > 0"},
    {"AKeyOfAnInlineTableIsMissing", ", poisson = 0.4", "",
     "case.toml:25: shell.material.poisson is missing: give a number in (-1, 0.5]"},
    {"AWordIsMissing", "type = \"velocity\", ", "",
     "case.toml:14: boundary.x_min.type is missing: give \"velocity\", \"wall\", \"slip\", \"symmetry\", \"periodic\", "
     "\"outflow\" or \"pressure\""},
    {"ATableIsMissing", "[time]\nend = 2.0\nstep = 0.01\n", "", "case.toml: time is missing: give the table [time]"},
    {"ASideHasNoCondition", "y_max = { type = \"slip\" }\n", "",
     "case.toml:13: boundary.y_max is missing: give the table [boundary.y_max]"},
    {"ASideHasTwoConditions", "y_max = { type = \"slip\" }", "y_min = { type = \"wall\" }",
     "case.toml:17: 'y_min' is given twice; keep one"},
    {"AKeyIsGivenTwice", "step = 0.01", "step = 0.01\nstep = 0.02", "case.toml:5: 'step' is given twice; keep one"},
    {"ATableIsGivenTwice", "[grid]", "[time]", "case.toml:9: 'time' is given twice; keep one"},
    {"TheFileIsNotToml", "[time]", "[time", "case.toml:2: Error while parsing table header: expected ']', saw '\\n'"},
    {"ATableIsGivenAsAList", "[time]", "[[time]]",
     "case.toml:2: time = [{ end = 2, step = 0.01 }] must be one table: [time] or { ... }"},
    {"AListIsGivenAsATable", "[[output.probe]]", "[output.probe]",
     "case.toml:38: output.probe = { name = \"tip\", point = [1, 0, 0], shell = \"flag\" } must be a list of tables: "
     "[[output.probe]]"},
    {"AListHoldsSomethingElse", "title = \"Small\"", "body = [3]", "case.toml:32: 'body' is given twice; keep one"},
};

const BadInput values[] = {
    {"ANumberIsAString", "end = 2.0", "end = \"late\"", "case.toml:3: time.end = \"late\" must be a number > 0"},
    {"ANumberIsOutOfRange", "thickness = 0.01", "thickness = -0.01",
     "case.toml:23: shell.thickness = -0.01 must be a number > 0"},
    {"ANumberIsBeyondAClosedEnd", "poisson = 0.4", "poisson = 0.6",
     "case.toml:25: shell.material.poisson = 0.6 must be a number in (-1, 0.5]"},
    {"ANumberIsAtAnOpenEnd", "poisson = 0.4", "poisson = -1",
     "case.toml:25: shell.material.poisson = -1 must be a number in (-1, 0.5]"},
    {"ANumberIsNotFinite", "end = 2.0", "end = inf", "case.toml:3: time.end = inf must be a number > 0"},
    {"ANumberIsNotANumber", "density = 1.0", "density = nan", "case.toml:6: fluid.density = nan must be a number > 0"},
    {"ACountIsNotAnInteger", "cells = 80", "cells = 80.5", "case.toml:11: grid.y.cells = 80.5 must be an integer >= 1"},
    {"ACountIsZero", "cells = 80", "cells = 0", "case.toml:11: grid.y.cells = 0 must be an integer >= 1"},
    {"ACountIsTooLarge", "cells = 80", "cells = 3000000000",
     "case.toml:11: grid.y.cells = 3000000000 must not be beyond 2147483647"},
    {"AnEntryOfAPairIsOutOfRange", "divisions = [20, 10]", "divisions = [20, 0]",
     "case.toml:22: shell.mesh.divisions[1] = 0 must be an integer >= 1"},
    {"AStringIsANumber", "title = \"Small\"", "title = 3", "case.toml:1: title = 3 must be a string"},
    {"AFlagIsANumber", "[output]", "[output]\nplots = 1", "case.toml:37: output.plots = 1 must be true or false"},
    {"APointHasTwoCoordinates", "point = [1, 0, 0]\n", "point = [1, 0]\n",
     "case.toml:41: output.probe.point = [1, 0] must be [x, y, z], three numbers"},
    {"ACoordinateIsAString", "point = [1, 0, 0]\n", "point = [1,\n 0,\n \"a\"]\n",
     "case.toml:43: output.probe.point[2] = \"a\" must be a number"},
    {"AWordIsMisspelt", "\"outflow\"", "\"outfow\"",
     "case.toml:15: boundary.x_max.type = \"outfow\" must be \"velocity\", \"wall\", \"slip\", \"symmetry\", "
     "\"periodic\", \"outflow\" or \"pressure\" (did you mean \"outflow\"?)"},
    {"ABendingIsUnknown", "thickness = ", "bending = \"qvag\"\nthickness = ",
     "case.toml:23: shell.bending = \"qvag\" must be \"qavg\", \"patch4\" or \"hinge\" (did you mean \"qavg\"?)"},
    {"AWordIsANumber", "type = \"clamped\"", "type = 3",
     "case.toml:28: shell.support.type = 3 must be \"clamped\", \"hinged\", \"symmetry\" or \"elastic\""},
    {"AListOfWordsHasAMisspeltOne", "every = 0.5", "every = 0.5, what = [\"velocity\", \"presure\"]",
     "case.toml:37: output.fields.what = [\"velocity\", \"presure\"] must be a list of \"velocity\", \"pressure\", "
     "\"vorticity\" or \"q_criterion\" (did you mean \"pressure\"?)"},
    {"AListOfWordsNamesOneTwice", "type = \"clamped\"", "fixed = [\"x\", \"x\"]",
     "case.toml:28: shell.support.fixed = [\"x\", \"x\"] names \"x\" twice"},
    {"AListOfWordsIsEmpty", "type = \"clamped\"", "fixed = []",
     "case.toml:28: shell.support.fixed = [] must be a list of \"x\", \"y\" or \"z\""},
    {"AVectorOfFormulasIsANumber", "force = [0, \"40*t\", 0]", "force = 40",
     "case.toml:31: shell.load.force = 40 must be [x, y, z], each a number, a formula of x, y, z, t, or { file, "
     "scale }"},
    {"AFormulaIsATruth", "\"40*t\"", "true",
     "case.toml:31: shell.load.force[1] = true must be a number, a formula of x, y, z, t, or { file, scale }"},
    {"AFormulaHasAnUnknownName", "\"sin(y)\"", "\"1 + sni(y)\"",
     "case.toml:8: fluid.initial.velocity[1] = \"1 + sni(y)\": unknown name 'sni' at character 5 (did you mean "
     "'sin'?)"},
    {"AFormulaIsIncomplete", "\"sin(y)\"", "\"1 +\"",
     "case.toml:8: fluid.initial.velocity[1] = \"1 +\": Unexpected end of expression at character 5"},
    {"AFormulaOfTimeUsesPlace", "\"cos(t)\"", "\"cos(x)\"",
     "case.toml:35: body.motion.translation[0] = \"cos(x)\" may change with t, but not with x, y, z"},
};

constexpr auto flag_mesh =
    "shape = \"rectangle\", origin = [0, 0, -0.5], a = [1, 0, 0], b = [0, 0, 1], divisions = [20, 10]";

const BadInput meshes[] = {
    {"AShapeLacksItsRadius", flag_mesh, "shape = \"disk\", rings = 4",
     "case.toml:22: shell.mesh.radius is missing: give a number > 0"},
    {"ADiskHasDivisions", flag_mesh, "shape = \"disk\", radius = 1, rings = 4, divisions = [4, 4]",
     "case.toml:22: shell.mesh.divisions goes only with `rectangle`, `annulus`, `cylinder`, or `sphere-cap` without a "
     "pole"},
    {"AGradingIsNotPositive", "divisions = [20, 10]", "divisions = [20, 10], grading = [2, 0]",
     "case.toml:22: shell.mesh.grading[1] = 0 must be a number > 0"},
    {"AGradedMeshIsSpreadEvenly", "divisions = [20, 10]",
     "divisions = [20, 10], grading = [2, 1], pattern = \"delaunay\"",
     "case.toml:22: shell.mesh.grading goes with every pattern but \"delaunay\", which spreads vertices "
     "evenly"},
    {"AWholeCylinderIsGradedAround", flag_mesh,
     "shape = \"cylinder\", radius = 1, length = 2, divisions = [4, 4], grading = [2, 1]",
     "case.toml:22: shell.mesh.grading must begin with 1 around a whole circle, which has no ends"},
    {"AWholeZoneIsGradedAround", flag_mesh,
     "shape = \"sphere-cap\", radius = 1, polar = { from = 20, to = 90 }, divisions = [4, 4], grading = [2, 1]",
     "case.toml:22: shell.mesh.grading must begin with 1 around a whole circle, which has no ends"},
    {"AZoneWithAPoleIsGraded", flag_mesh,
     "shape = \"sphere-cap\", radius = 1, polar = { to = 90 }, rings = 4, grading = [1, 2]",
     "case.toml:22: shell.mesh.grading goes only with `rectangle`, `cylinder`, or `sphere-cap` without a pole"},
    {"ACylinderHasRings", flag_mesh, "shape = \"cylinder\", radius = 1, length = 2, divisions = [4, 4], rings = 4",
     "case.toml:22: shell.mesh.rings goes only with `disk`, or `sphere-cap` with a pole"},
    {"AZoneWithAPoleLacksRings", flag_mesh, "shape = \"sphere-cap\", radius = 1, polar = { to = 90 }",
     "case.toml:22: shell.mesh.rings is missing: give an integer >= 1"},
    {"AZoneGoesBeyondThePole", flag_mesh, "shape = \"sphere-cap\", radius = 1, polar = { to = 190 }, rings = 4",
     "case.toml:22: shell.mesh.polar.to = 190 must be a number in [0, 180]"},
    {"ASectorIsMoreThanACircle", flag_mesh, "shape = \"disk\", radius = 1, angle = { from = -10, to = 360 }, rings = 4",
     "case.toml:22: shell.mesh.angle.to = 360 must be above `from`, by 360 at most"},
    {"AHoleIsLargerThanItsAnnulus", flag_mesh, "shape = \"annulus\", radius = 1, inner_radius = 2, divisions = [12, 3]",
     "case.toml:22: shell.mesh.inner_radius = 2 must be less than `radius`"},
    {"ADiskIsCutInAlternation", flag_mesh, "shape = \"disk\", radius = 1, rings = 4, pattern = \"alternating\"",
     "case.toml:22: shell.mesh.pattern = \"alternating\" must be another one with `rings`"},
    {"AnglesStartAlongTheAxis", flag_mesh, "shape = \"disk\", radius = 1, rings = 4, start = [0, 0, 2]",
     "case.toml:22: shell.mesh.start must not be zero or parallel to `axis`"},
    {"ARegularPatternHasASeed", flag_mesh, "shape = \"disk\", radius = 1, rings = 4, seed = 2",
     "case.toml:22: shell.mesh.seed goes only with `pattern = \"irregular\"` or `\"delaunay\"`"},
};

const BadInput files[] = {
    {"AMeshFileIsMissing",
     "shape = \"rectangle\", origin = [0, 0, -0.5], a = [1, 0, 0], b = [0, 0, 1], divisions = [20, 10]",
     "file = \"flag.stl\"",
     "case.toml:22: shell.mesh.file = \"flag.stl\" must be the path of a file: there is no flag.stl"},
    {"AMeshFileIsAFolder",
     "shape = \"rectangle\", origin = [0, 0, -0.5], a = [1, 0, 0], b = [0, 0, 1], divisions = [20, 10]",
     "file = \"/tmp\"", "case.toml:22: shell.mesh.file = \"/tmp\" must be the path of a file: there is no /tmp"},
    {"AMeshFileIsOfAnUnknownKind",
     "shape = \"rectangle\", origin = [0, 0, -0.5], a = [1, 0, 0], b = [0, 0, 1], divisions = [20, 10]",
     "file = \"case.toml\"",
     "case.toml:22: shell.mesh.file = \"case.toml\" must end in .stl, .obj, .ply, .vtp, .vtu or "
     ".msh"},
    {"ATableOfTimesIsMissing", "\"40*t\"", "{ file = \"wave.csv\" }",
     "case.toml:31: shell.load.force[1].file = \"wave.csv\" must be the path of a file: there is no wave.csv"},
    {"ATableOfTimesHasNoFile", "\"40*t\"", "{ scale = 2 }",
     "case.toml:31: shell.load.force[1].file is missing: give the path of a file"},
    {"ATableOfTimesHasAnUnknownKey", "\"40*t\"", "{ fiel = \"wave.csv\", file = \"case.toml\" }",
     "case.toml:31: shell.load.force[1].fiel is not a key (did you mean 'file'?)"},
    {"ATableOfTimesHoldsText", "\"40*t\"", "{ file = \"case.toml\" }",
     "case.toml:31: shell.load.force[1] = { file = \"case.toml\" }: case.toml:2: '[time]' must be two numbers, time "
     "and "
     "value"},
};

const BadInput rules[] = {
    {"AnAxisEndsBeforeItStarts", "from = -4, to = 4", "from = 4, to = -4",
     "case.toml:11: grid.y.to = -4 must be greater than `from`"},
    {"ARefinementLeavesItsAxis", "refine = { from = -0.5", "refine = { from = -2.5",
     "case.toml:10: grid.x.refine must lie between `from` and `to`"},
    {"ARefinementTakesAllCells", "spacing = 0.04", "spacing = 0.02",
     "case.toml:10: grid.x.refine must leave a cell for each end: it takes 100 of the 100 cells"},
    {"EdgesCoverInPartWithTheOtherScheme", "[output]", "[immersed]\nscheme = \"curvib\"\nedges = \"partial\"\n[output]",
     "case.toml:38: immersed.edges = \"partial\" must be \"whole\" with `scheme = \"curvib\"`"},
    {"APeriodicSideIsAlone", "z_max = { type = \"periodic\" }", "z_max = { type = \"slip\" }",
     "case.toml:18: boundary.z_min.type = \"periodic\" must be paired: z_max is not periodic"},
    {"AVelocitySideHasNoVelocity", ", value = [1, 0, 0]", "",
     "case.toml:14: boundary.x_min.flow_rate or `value` must be given, one of the two"},
    {"AVelocitySideHasTwo", "value = [1, 0, 0]", "value = [1, 0, 0], flow_rate = 3",
     "case.toml:14: boundary.x_min.flow_rate = 3 or `value` must be given, one of the two"},
    {"AFlowRateChangesWithPlace", "value = [1, 0, 0]", "flow_rate = \"x\"",
     "case.toml:14: boundary.x_min.flow_rate = \"x\" may change with t, but not with x, y, z"},
    {"AProfileHasNoFlowRate", "value = [1, 0, 0]", "value = [1, 0, 0], profile = \"parabolic\"",
     "case.toml:14: boundary.x_min.profile goes only with `flow_rate`"},
    {"AProfileIsMisspelt", "value = [1, 0, 0]", "flow_rate = 3, profile = \"parabola\"",
     "case.toml:14: boundary.x_min.profile = \"parabola\" must be \"plug\", \"parabolic\" or \"womersley\" (did you "
     "mean "
     "\"parabolic\"?)"},
    {"WomersleysProfileHasNoPeriod", "value = [1, 0, 0]", "flow_rate = 3, profile = \"womersley\"",
     "case.toml:14: boundary.x_min.period is missing: give a number > 0"},
    {"APressureSideHasNoPressure", "x_max = { type = \"outflow\" }", "x_max = { type = \"pressure\" }",
     "case.toml:15: boundary.x_max.pressure is missing: give a number, a formula of x, y, z, t, or { file, scale }"},
    {"APressureBelongsToAnotherType", "x_max = { type = \"outflow\" }", "x_max = { type = \"outflow\", pressure = 2 }",
     "case.toml:15: boundary.x_max.pressure goes only with `type = \"pressure\"`"},
    {"AValueBelongsToAnotherType", "x_max = { type = \"outflow\" }",
     "x_max = { type = \"outflow\", value = [1, 0, 0] }",
     "case.toml:15: boundary.x_max.value goes only with `type = \"velocity\"` or `type = \"wall\"`"},
    {"AMeshIsMadeAndRead", "shape = \"rectangle\", origin = [3", "file = \"a.stl\", shape = \"rectangle\", origin = [3",
     "case.toml:34: body.mesh must have exactly one of shape, file; it has shape, file\n"
     "case.toml:34: body.mesh.file = \"a.stl\" must be the path of a file: there is no a.stl"},
    {"AMeshIsNeitherMadeNorRead",
     "{ shape = \"rectangle\", origin = [3, 0, -0.5], a = [0, 1, 0], b = [0, 0, 1], divisions = [8, 4] }", "{}",
     "case.toml:34: body.mesh must have exactly one of shape, file; it has none"},
    {"ARectangleHasNoArea", "b = [0, 0, 1], divisions = [20, 10]", "b = [2, 0, 0], divisions = [20, 10]",
     "case.toml:22: shell.mesh.b must not be parallel to `a`, and neither may be zero"},
    {"AShellHasTheNameOfABody", "name = \"plate\"", "name = \"flag\"",
     "case.toml:33: body.0.name = \"flag\" must be unique: another shell or body has it"},
    {"ANameCannotNameAFile", "name = \"plate\"", "name = \"a/b\"",
     "case.toml:33: body.name = \"a/b\" must be made of letters, digits, '-' and '_': files are named after it"},
    {"ASupportHasNoSelector", "{ edge = [[0, 0, -0.5], [0, 0, 0.5]] }", "{}",
     "case.toml:27: shell.support.where must have exactly one of edge, box, plane, point, set, all; it has none"},
    {"ALoadHasTwoSelectors", "{ point = [1, 0, 0] }", "{ point = [1, 0, 0], box = [[0, 0, 0], [1, 1, 1]] }",
     "case.toml:30: shell.load.where must have exactly one of edge, box, plane, point, set, all; it has box, point"},
    {"ASupportSaysNothing", "type = \"clamped\"\n", "",
     "case.toml:26: shell.support must have exactly one of type, fixed; it has none"},
    {"ASymmetryMoves", "type = \"clamped\"", "type = \"symmetry\"\nmotion = { translation = [0, \"t\", 0] }",
     "case.toml:29: shell.support.motion goes only with a clamped, hinged or fixed support"},
    {"AnElasticSupportHasNoSpring", "type = \"clamped\"", "type = \"elastic\"",
     "case.toml:26: shell.support.stiffness or turning_stiffness must be greater than 0"},
    {"ASpringSitsOnAClamp", "type = \"clamped\"", "type = \"clamped\"\nturning_stiffness = 2",
     "case.toml:29: shell.support.turning_stiffness goes only with `type = \"elastic\"`"},
    {"ASchemeHasANumberOfAnother", "[output]", "[structure]\nrho_inf = 0.5\n[output]",
     "case.toml:37: structure.rho_inf goes only with `scheme = \"generalised-alpha\"`"},
    {"ALoadIsOfTwoKinds", "force = [0, \"40*t\", 0]", "force = [0, \"40*t\", 0]\npressure = 1",
     "case.toml:32: shell.load must have exactly one of force, pressure, traction, edge_force, edge_moment; it has "
     "force, pressure"},
    {"ABoxHasItsCornersSwapped", "{ point = [1, 0, 0] }", "{ box = [[1, 1, 1], [0, 0, 0]] }",
     "case.toml:30: shell.load.where.box must be [lowest corner, highest corner]"},
    {"AnEdgeIsAPoint", "[0, 0, 0.5]] }", "[0, 0, -0.5]] }",
     "case.toml:27: shell.support.where.edge must have two different end points"},
    {"APlaneHasNoNormal", "{ point = [1, 0, 0] }", "{ plane = { point = [0, 0, 0], normal = [0, 0, 0] } }",
     "case.toml:30: shell.load.where.plane.normal must not be zero"},
    {"AnAxisOfRotationIsZero", "thickness = 0.01", "thickness = 0.01\nrotate = { axis = [0, 0, 0], angle = 3 }",
     "case.toml:24: shell.rotate.axis must not be zero"},
    {"AProbeSitsOnNoShell", "shell = \"flag\"", "shell = \"flug\"",
     "case.toml:40: output.probe.0.shell = \"flug\" must name a shell or a body (did you mean 'flag'?)"},
    {"AProbeStandsOutsideTheGrid", "shell = \"flag\"\npoint = [1, 0, 0]", "point = [9, 0, 0]",
     "case.toml:40: output.probe.0.point must lie in the grid"},
    {"TwoProbesHaveOneName", "[[output.probe]]",
     "[[output.probe]]\nname = \"tip\"\npoint = [0, 0, 0]\n[[output.probe]]",
     "case.toml:42: output.probe.1.name = \"tip\" must be unique: another probe has it"},
    {"TwoSlicesHaveOneName", "[[output.probe]]",
     "slice = [{ name = \"a\", point = [0, 0, 0], normal = [0, 0, 1], every = 1 }, { name = \"a\", point = [0, 0, 0], "
     "normal = [1, 0, 0], every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.slice.1.name = \"a\" must be unique: another slice has it"},
    {"ASliceHasNoNormal", "[[output.probe]]",
     "slice = [{ name = \"a\", point = [0, 0, 0], normal = [0, 0, 0], every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.slice.normal must not be zero"},
    {"ARakeLeavesTheGrid", "[[output.probe]]",
     "rake = [{ name = \"a\", from = [0, 0, 0], to = [0, 90, 0], points = 3, every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.rake.0.to must lie in the grid"},
    {"ARakeHasOnePoint", "[[output.probe]]",
     "rake = [{ name = \"a\", from = [0, 0, 0], to = [0, 0.1, 0], points = 1, every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.rake.points = 1 must be an integer >= 2"},
    {"ASectionIsOfNoShell", "[[output.probe]]",
     "section = [{ name = \"a\", shell = \"flga\", axis = [0, 0, 1], bins = 3, every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.section.0.shell = \"flga\" must name a shell or a body (did you mean 'flag'?)"},
    {"AnIsosurfaceIsOfNoField", "[[output.probe]]",
     "isosurface = [{ name = \"a\", of = \"q\", value = 3, every = 1 }]\n[[output.probe]]",
     "case.toml:38: output.isosurface.of = \"q\" must be \"velocity\", \"pressure\", \"vorticity\" or \"q_criterion\""},
    {"StatisticsStartBeforeTheRun", "[[output.probe]]", "statistics = { start = -1 }\n[[output.probe]]",
     "case.toml:38: output.statistics.start = -1 must be a number >= 0"},
    {"ContactHasNoDistance", "[output]", "[contact]\ndistance = 0.0\nstiffness = 1.0\n[output]",
     "case.toml:37: contact.distance = 0 must be a number > 0"},
    {"AnAnalysisOfAFlowIsStatic", "[time]\nend = 2.0\nstep = 0.01", "[structure]\nanalysis = \"static\"",
     "case.toml:3: structure.analysis = \"static\" must be \"dynamic\" with a [fluid]"},
    {"CheckpointsAreOfNoLength", "fields = { every = 0.5 }", "checkpoint = { every = 0 }",
     "case.toml:37: output.checkpoint.every = 0 must be a number > 0"},
    {"NoModesAreAsked", "[output]", "[structure]\nanalysis = \"modes\"\nmodes = 0\n[output]",
     "case.toml:38: structure.modes = 0 must be an integer >= 1"},
    {"AStaticAnalysisTakesTime", "[output]", "[structure]\nanalysis = \"static\"\n[output]",
     "case.toml:2: time goes only with `structure.analysis = \"dynamic\"`"},
    {"AConstantBelongsToAnotherMaterial", "poisson = 0.4", "poisson = 0.4, c10 = 100",
     "case.toml:25: shell.material.c10 goes only with `model = \"may-newman-yin\"`"},
    {"AConstantOfTwoMaterialsBelongsToNeither", "poisson = 0.4", "poisson = 0.4, c0 = 100",
     "case.toml:25: shell.material.c0 goes only with `model = \"may-newman-yin\"` or `\"lee-sacks\"`"},
    {"AMaterialLacksItsFibres", "\"saint-venant-kirchhoff\", young = 1e6, poisson = 0.4",
     "\"may-newman-yin\", c0 = 399, c1 = 4.325, c2 = 1446.5, c10 = 1000",
     "case.toml:25: shell.material.fibre must be given: the law depends on the direction of its fibres"},
    {"FibresRunTwoWays", "\"saint-venant-kirchhoff\", young = 1e6, poisson = 0.4",
     "\"may-newman-yin\", c0 = 1, c1 = 4, c2 = 300, c10 = 1, fibre = { direction = [1, 0, 0], field = \"f\" }",
     "case.toml:25: shell.material.fibre must have exactly one of direction, circumference, field; it has direction, "
     "field"},
    {"AMaterialHasNoEnergyForSomeStrain", "\"saint-venant-kirchhoff\", young = 1e6, poisson = 0.4",
     "\"fung\", c = 10, a11 = 4, a22 = 1, a12 = 3, a33 = 1, fibre = { direction = [1, 0, 0] }",
     "case.toml:25: shell.material.a12 = 3 must be small enough, with `a13` and `a23`, for a positive definite matrix "
     "(a12^2 < a11 a22), or some strain would cost no energy"},
    {"ASymmetryOfAShellWithFacesIsNoPlane",
     "density = 100.0\nmaterial = { model = \"saint-venant-kirchhoff\", young = 1e6, poisson = 0.4 "
     "}\n[[shell.support]]\nwhere "
     "= { edge = [[0, 0, -0.5], [0, 0, 0.5]] }\ntype = \"clamped\"",
     "density = 100.0\nwetted = \"faces\"\nmaterial = { model = \"saint-venant-kirchhoff\", young = 1e6, poisson = 0.4 "
     "}\n"
     "[[shell.support]]\nwhere = { edge = [[0, 0, -0.5], [0, 0, 0.5]] }\ntype = \"symmetry\"",
     "case.toml:28: shell.0.support.0.where must be a `plane` for a symmetry of a shell with `wetted = \"faces\"`"},
    {"AWordThatDecidesIsMisspelt", "type = \"prescribed\"", "type = \"prescibed\"",
     "case.toml:35: body.motion.type = \"prescibed\" must be \"fixed\", \"prescribed\" or \"free\" (did "
     "you mean \"prescribed\"?)"},
};

const BadInput not_yet[] = {
    {"ATimeScheme", "step = 0.01", "step = 0.01\nscheme = \"sbdf2\"",
     "case.toml:5: time.scheme = \"sbdf2\" is known but not available in this version; it must be \"rk3\" or "
     "\"newton-krylov\""},
    {"Turbulence", "viscosity = 0.01", "viscosity = 0.01\nturbulence = { model = \"smagorinsky\" }",
     "case.toml:8: fluid.turbulence is not available in this version (available here: density, viscosity, body_force, "
     "initial)"},
};

std::string name_of(const testing::TestParamInfo<BadInput>& info)
{
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Keys, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(keys), name_of);
INSTANTIATE_TEST_SUITE_P(Values, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(values), name_of);
INSTANTIATE_TEST_SUITE_P(Files, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(files), name_of);
INSTANTIATE_TEST_SUITE_P(Rules, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(rules), name_of);
INSTANTIATE_TEST_SUITE_P(Meshes, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(meshes), name_of);
INSTANTIATE_TEST_SUITE_P(NotInThisVersion, BadInputIsToldWithFileLineKeyAndRemedy, testing::ValuesIn(not_yet), name_of);

TEST(BadCaseFiles, AreComplainedAboutAtOnceInTheOrderOfTheFile)
{
  auto text = changed(small_case, "end = 2.0", "end = -2.0");
  text = changed(text, "thickness = 0.01", "thicknes = 0.01");
  text = changed(text, "\"outflow\"", "\"outfow\"");
  EXPECT_EQ(complaint_about(text),
            "case.toml:3: time.end = -2 must be a number > 0\n"
            "case.toml:15: boundary.x_max.type = \"outfow\" must be \"velocity\", \"wall\", \"slip\", \"symmetry\", "
            "\"periodic\", \"outflow\" or \"pressure\" (did you mean \"outflow\"?)\n"
            "case.toml:20: shell.thickness is missing: give a number > 0\n"
            "case.toml:23: shell.thicknes is not a key of [shell] (did you mean 'thickness'?)");
}

TEST(BadCaseFiles, ThatDoNotExistOrAreFoldersAreNamed)
{
  const TemporaryFolder folder;
  const auto complaint = [&](const std::filesystem::path& file) -> std::string {
    try {
      load_case(file);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint(folder.path() / "none.toml"), (folder.path() / "none.toml").string() + ": there is no such file");
  EXPECT_EQ(complaint(folder.path()), folder.path().string() + ": is a folder; give the case file in it");
}

TEST(CasesWithoutAFluid, HaveNoGridNoBoundaryNoBodyAndNoFields)
{
  const std::string no_fluid =
      changed(small_case, "[fluid]\ndensity = 1.0\nviscosity = 0.01\ninitial.velocity = [1, \"sin(y)\", 0]\n", "");
  EXPECT_EQ(complaint_about(no_fluid),
            "case.toml:5: grid goes only with `[fluid]`\ncase.toml:9: boundary goes only with `[fluid]`");
}

TEST(CasesWithNeitherFluidNorShell, HaveNothingToSolve)
{
  EXPECT_EQ(complaint_about("[time]\nend = 1\nstep = 0.1\n"),
            "case.toml: the case must have something to solve: [fluid], [[shell]] or both");
}

}  // namespace
}  // namespace luff::config
