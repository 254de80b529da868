// SPDX-License-Identifier: BSD-3-Clause
// Bad input ends the program with status 2 and a message that says where and what to do, before anything is written.
#include "small_cases.hpp"

namespace luff::test {
namespace {

/// One way to spoil the small flag, and words that the message must hold.
struct BadCase {
  const char* name;
  const char* from;
  const char* to;
  std::vector<std::string> words;
};

void PrintTo(const BadCase& bad, std::ostream* out)
{
  *out << bad.from << " -> " << bad.to;
}

/// Runs the case.toml of a folder and expects it to be refused without a trace.
void expect_refusal(const WorkFolder& folder, const std::vector<std::string>& words)
{
  const Outcome run = luff(folder, {"run", "case.toml"});
  EXPECT_EQ(run.status, 2) << run.said;
  for (const std::string& word : words)
    EXPECT_NE(run.said.find(word), std::string::npos) << "no '" << word << "' in\n" << run.said;
  EXPECT_FALSE(folder.has("runs"));
  const Outcome check = luff(folder, {"check", "case.toml"});
  EXPECT_EQ(check.status, 2);
  EXPECT_EQ(check.said, run.said) << "check and run must agree";
}

class BadCasesAreRefused : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadCasesAreRefused, When)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(small_flag, GetParam().from, GetParam().to));
  expect_refusal(folder, GetParam().words);
}

const BadCase keys_and_values[] = {
    {"AKeyIsMisspelt", "end = 0.1", "edn = 0.1", {"case.toml:3: time.edn", "did you mean 'end'?"}},
    {"AKeyIsUnknown", "title =", "colour = 1\ntitle =", {"case.toml:1: colour", "known: title"}},
    {"AValueHasTheWrongType", "end = 0.1", "end = \"soon\"", {"case.toml:3: time.end = \"soon\"", "a number > 0"}},
    {"AValueIsOutOfRange",
     "thickness = 0.01",
     "thickness = -1",
     {"case.toml:24: shell.thickness = -1", "a number > 0"}},
    {"ASideHasNoCondition", "z_max = { type = \"slip\" }\n", "", {"case.toml:13: boundary.z_max is missing"}},
    {"ASideHasTwoConditions",
     "z_max = { type = \"slip\" }",
     "z_min = { type = \"wall\" }",
     {"case.toml:19: 'z_min' is given twice"}},
    {"APeriodicSideIsAlone",
     "z_max = { type = \"slip\" }",
     "z_max = { type = \"periodic\" }",
     {"case.toml:19: boundary.z_max.type", "z_min is not periodic"}},
    {"TheGridIsTooFineOutsideItsRefinement",
     "cells = 24 }",
     "cells = 24, refine = { from = 0.0, to = 1.0, spacing = 0.5 } }",
     {"case.toml:10: grid.x.cells = 24 is too many", "fewer cells"}},
    {"TheGridGrowsTooFastOutsideItsRefinement",
     "cells = 24 }",
     "cells = 24, refine = { from = 0.0, to = 1.0, spacing = 0.05 } }",
     {"case.toml:10: grid.x.cells = 24 is too few", "more cells"}},
    {"InflowHasNoOutlet",
     "x_max = { type = \"outflow\" }",
     "x_max = { type = \"wall\" }",
     {"case.toml:13: boundary", "without an outlet", "\"outflow\""}},
    {"InflowThatStartsLaterHasNoOutlet",
     "value = [1.0, 0.0, 0.0] }\nx_max = { type = \"outflow\" }",
     "value = [\"t\", 0.0, 0.0] }\nx_max = { type = \"wall\" }",
     {"case.toml:13: boundary", "without an outlet"}},
    {"TheInitialVelocityIsNoNumberSomewhere",
     "initial.velocity = [1.0, 0.0, 0.0]",
     "initial.velocity = [\"sqrt(x)\", 0.0, 0.0]",
     {"case.toml:8: fluid.initial.velocity", "nan", "(-0.9375, ", "guard the formula"}},
    {"ABoundaryVelocityIsNoNumberSomewhere",
     "value = [1.0, 0.0, 0.0]",
     "value = [\"sqrt(y)\", 0.0, 0.0]",
     {"case.toml:13: boundary.x_min.value", "nan", "guard the formula"}},
};

INSTANTIATE_TEST_SUITE_P(Keys, BadCasesAreRefused, ::testing::ValuesIn(keys_and_values),
                         [](const auto& bad) { return bad.param.name; });

const BadCase sheets[] = {
    {"ASheetLeavesTheGrid", "a = [0.8, 0, 0]", "a = [2.8, 0, 0]", {"case.toml:22: shell 'flag': vertex", "x_max"}},
    {"ASheetTouchesAVelocitySide",
     "x = { from = -1.0, to = 2.0, cells = 24 }",
     "x = { from = 0.0, to = 2.0, cells = 16 }",
     {"case.toml:22: shell 'flag': vertex", "touches side x_min", "move the sheet"}},
    {"ASheetReachesThroughASlipSide",
     "b = [0, 0, 0.6]",
     "b = [0, 0, 0.9]",
     {"case.toml:22: shell 'flag'", "beyond", "z_max"}},
    {"ASupportSelectsNothing",
     "where = { edge = [[0, 0.01, -0.3], [0, 0.01, 0.3]] }",
     "where = { edge = [[0, 0.5, -0.3], [0, 0.5, 0.3]] }",
     {"case.toml:27: shell 'flag', support 1", "nearest is vertex"}},
    {"ALoadSelectsNoTriangle",
     "[output]\n",
     "[[shell.load]]\nwhere = { point = [0.4, 0.1, 0] }\npressure = 1.0\n[output]\n",
     {"case.toml:30: shell 'flag', load 1", "no triangle", "load vertices or edges"}},
    {"TheMeshFileIsMissing",
     "shape = \"rectangle\", origin = [0, 0.01, -0.3], a = [0.8, 0, 0], b = [0, 0, 0.6], divisions = [6, 4]",
     "file = \"flag.obj\"",
     {"case.toml:22: shell.mesh.file = \"flag.obj\"", "there is no"}},
};

INSTANTIATE_TEST_SUITE_P(Sheets, BadCasesAreRefused, ::testing::ValuesIn(sheets),
                         [](const auto& bad) { return bad.param.name; });

/// Triangles of a mesh file, and words of the message about them.
struct BadMesh {
  const char* name;
  const char* obj;
  std::vector<std::string> words;
};

void PrintTo(const BadMesh& bad, std::ostream* out)
{
  *out << bad.name;
}

class BadMeshesAreRefused : public ::testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshesAreRefused, WithTheLineOfTheCaseTheFileTheTriangleAndItsPlace)
{
  const WorkFolder folder;
  folder.write("flag.obj", GetParam().obj);
  folder.write("case.toml", changed(small_flag,
                                    "shape = \"rectangle\", origin = [0, 0.01, -0.3], a = [0.8, 0, 0], b = [0, 0, "
                                    "0.6], divisions = [6, 4]",
                                    "file = \"flag.obj\", repair = false"));
  std::vector<std::string> words{"case.toml:22: ", "flag.obj"};
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  expect_refusal(folder, words);
}

// Two triangles of a square in y = 0.01, and one more thing.
#define SQUARE "v 0 0.01 -0.3\nv 0.8 0.01 -0.3\nv 0.8 0.01 0.3\nv 0 0.01 0.3\n"

const BadMesh meshes[] = {
    {"ATriangleIsFlipped", SQUARE "f 1 2 3\nf 1 4 3\n", {"triangle"}},
    {"ATriangleIsDoubled", SQUARE "f 1 2 3\nf 1 3 4\nf 3 1 2\n", {"triangle"}},
    {"ATriangleHasNoArea", SQUARE "v 0.4 0.01 -0.3\nf 1 2 3\nf 1 3 4\nf 1 5 2\n", {"triangle", "area"}},
    {"ThreeTrianglesShareAnEdge", SQUARE "v 0.4 0.2 0\nf 1 2 3\nf 1 3 4\nf 1 3 5\n", {"edge"}},
    {"ACornerIsMissing", SQUARE "f 1 2 9\n", {"flag.obj:5", "'9' must be the number of one of the 4 vertices"}},
    {"TheFileIsEmpty", "", {}},
};

#undef SQUARE

INSTANTIATE_TEST_SUITE_P(Meshes, BadMeshesAreRefused, ::testing::ValuesIn(meshes),
                         [](const auto& bad) { return bad.param.name; });

TEST(BadInput, ABinaryStlCutShortIsRefused)
{
  const WorkFolder folder;
  folder.write("flag.stl", std::string(84, '\0') + "cut short");
  folder.write("case.toml", changed(small_flag,
                                    "shape = \"rectangle\", origin = [0, 0.01, -0.3], a = [0.8, 0, 0], b = [0, 0, "
                                    "0.6], divisions = [6, 4]",
                                    "file = \"flag.stl\""));
  expect_refusal(folder, {"case.toml:22: ", "flag.stl"});
}

TEST(BadInput, AStaticShellThatCanMoveRigidlyIsRefused)
{
  const WorkFolder folder;
  std::string text = changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"static\"\n");
  folder.write("case.toml", changed(text, "\"clamped\"", "\"hinged\""));
  expect_refusal(folder, {"case.toml:4: shell 'strip' can move as a rigid body", "add a support"});
}

TEST(BadInput, ContactOnAPathOrWithDampingIsRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(pressed_strips, "\"static\"", "\"arc-length\""));
  expect_refusal(folder, {"contact", "`structure.analysis = \"dynamic\"` or `\"static\"`"});
  folder.write("case.toml", changed(pressed_strips, "steps = 4\n", "steps = 4\nstabilisation = \"damping\"\n"));
  expect_refusal(folder, {"case.toml:5: structure.stabilisation", "must be \"none\" with [contact]"});
}

TEST(BadInput, AShellThatOnlyContactHoldsIsRefused)
{
  const WorkFolder folder;
  folder.write(
      "case.toml",
      changed(pressed_strips,
              "[[shell.support]]\nwhere = { edge = [[0, 0, 0.06], [0, 0.25, 0.06]] }\ntype = \"clamped\"\n", ""));
  expect_refusal(folder, {"shell 'upper' can move as a rigid body"});
}

TEST(BadInput, MoreModesThanUnknownsAreRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n",
                                    "[structure]\nanalysis = \"modes\"\nmodes = 25\n"));
  expect_refusal(folder, {"case.toml:5: shell 'strip': modes = 25 must be from 1 to 24"});
}

TEST(BadInput, AControlledDisplacementThatIsHeldIsRefused)
{
  const WorkFolder folder;
  folder.write(
      "case.toml",
      changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n",
              "[structure]\nanalysis = \"displacement-control\"\n[structure.control]\nwhere = { point = [0, 0, 0] "
              "}\ncomponent = \"z\"\ndisplacement = 0.2\n"));
  expect_refusal(folder,
                 {"case.toml:4: shell 'strip': the controlled displacement z of vertex 0 is held by a support"});
}

TEST(BadInput, DisplacementControlWithoutADisplacementIsRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n",
                                    "[structure]\nanalysis = \"displacement-control\"\n"));
  expect_refusal(folder, {"structure.control is missing"});
}

TEST(BadInput, ACaseThatIsNotThereIsRefused)
{
  const WorkFolder folder;
  expect_refusal(folder, {"case.toml: there is no such file"});
}

TEST(BadInput, AnOverrideThatIsWrongIsRefusedByItsOwnName)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  const Outcome run = luff(folder, {"run", "case.toml", "--set", "time.sept=1"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.said.find("--set time.sept=1: time.sept is not a key"), std::string::npos) << run.said;
  EXPECT_FALSE(folder.has("runs"));
}

TEST(BadInput, AnOutputFolderThatCannotBeMadeIsRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  folder.write("file", "not a folder");
  for (const char* out : {"file", "file/below"}) {
    const Outcome run = luff(folder, {"run", "case.toml", "--out", out});
    EXPECT_EQ(run.status, 2) << run.said;
    EXPECT_NE(run.said.find(std::string("output folder ") + out), std::string::npos) << run.said;
    EXPECT_NE(run.said.find("--out DIR"), std::string::npos) << run.said;
  }
  EXPECT_EQ(folder.read("file"), "not a folder");
}

TEST(BadInput, RunsThatCannotBeNumberedAreRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  folder.write("runs", "not a folder");
  const Outcome run = luff(folder, {"run", "case.toml"});
  EXPECT_EQ(run.status, 2) << run.said;
  EXPECT_NE(run.said.find("output folder runs/"), std::string::npos) << run.said;
}

TEST(BadInput, AnOutputFolderThatHoldsSomethingIsRefusedAndLeftAlone)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  std::filesystem::create_directory(folder.path() / "old");
  folder.write("old/steps.csv", "precious");
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "old"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.said.find("output folder old: is not empty"), std::string::npos) << run.said;
  EXPECT_EQ(folder.read("old/steps.csv"), "precious");
  EXPECT_FALSE(folder.has("old/case.toml"));
}

TEST(BadInput, ACommandLineThatIsWrongIsRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  const std::vector<std::vector<std::string>> commands{{},
                                                       {"rnu", "case.toml"},
                                                       {"run"},
                                                       {"run", "case.toml", "--otu", "x"},
                                                       {"run", "case.toml", "--threads", "many"},
                                                       {"run", "case.toml", "--resolution", "-1"},
                                                       {"mesh", "case.toml"},
                                                       {"plot", "no-such-run"}};
  for (const auto& command : commands) {
    const Outcome run = luff(folder, command);
    EXPECT_EQ(run.status, 2) << ::testing::PrintToString(command) << "\n" << run.said;
    EXPECT_FALSE(run.said.empty());
  }
  EXPECT_FALSE(folder.has("runs"));
}

TEST(BadInput, IsToldOnceAndByOneOfSeveralRanks)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(small_flag, "end = 0.1", "edn = 0.1"));
  const Outcome run = luff_on_ranks(2, folder, {"run", "case.toml"});
  EXPECT_EQ(run.status, 2) << run.said;
  const auto first = run.said.find("case.toml:3: time.edn");
  ASSERT_NE(first, std::string::npos) << run.said;
  EXPECT_EQ(run.said.find("case.toml:3: time.edn", first + 1), std::string::npos) << run.said;
  EXPECT_FALSE(folder.has("runs"));
}

TEST(BadInput, MoreRanksThanRowsOfCellsAreRefused)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(changed(small_flag, "cells = 16", "cells = 1"), "cells = 8", "cells = 1"));
  const Outcome run = luff_on_ranks(2, folder, {"run", "case.toml"});
  EXPECT_EQ(run.status, 2) << run.said;
  EXPECT_NE(run.said.find("case.toml:9: 2 ranks cannot share 1 x 1 rows of cells: start fewer ranks"),
            std::string::npos)
      << run.said;
  EXPECT_FALSE(folder.has("runs"));
}

}  // namespace
}  // namespace luff::test
