// SPDX-License-Identifier: BSD-3-Clause
// Curvilinear grids through the program: made, read back, and refused where they are bad.
#include <gtest/gtest.h>

#include "run_files.hpp"
#include "small_cases.hpp"

namespace luff::test {
namespace {

/// A flow through a grid whose lines are given; line 8 is the first of them.
std::string flow_in(const std::string& grid, const std::string& sides_of_eta = "wall")
{
  return "[time]\nend = 0.1\nstep = 0.05\n[fluid]\ndensity = 1.0\nviscosity = 0.1\n[grid]\n" + grid +
         "\n[boundary]\nxi_min = { type = \"wall\" }\nxi_max = { type = \"wall\" }\neta_min = { type = \"" +
         sides_of_eta + "\" }\neta_max = { type = \"" + sides_of_eta +
         "\" }\nzeta_min = { type = \"velocity\", value = [0, 0, 1] }\nzeta_max = { type = \"outflow\" }\n";
}

const std::string pipe = "kind = \"pipe\"\nlength = 2.0\nradius = 0.5\nacross = 8\nalong = { cells = 10 }";

std::string mapped_box(const std::string& map)
{
  return "kind = \"mapped-box\"\nx = { from = 0, to = 1, cells = 4 }\ny = { from = 0, to = 1, cells = 4 }\n"
         "z = { from = 0, to = 1, cells = 4 }\nmap = " +
         map;
}

TEST(CurvilinearGrid, IsCheckedAndItsQualityTold)
{
  const WorkFolder folder;
  folder.write("case.toml", flow_in(pipe));
  const Outcome check = luff(folder, {"check", "case.toml"});
  EXPECT_EQ(check.status, 0) << check.said;
  for (const char* word : {"8 x 8 x 10 = 640 cells", "cosine between faces at most 0.3", "the case is valid"})
    EXPECT_NE(check.said.find(word), std::string::npos) << word << " in " << check.said;
}

TEST(CurvilinearGrid, IsWrittenWithItsQualityAndReadAgainAsItWas)
{
  const WorkFolder folder;
  folder.write("case.toml", flow_in(pipe));
  const Outcome mesh = luff(folder, {"mesh", "case.toml", "--out", "mesh"});
  ASSERT_EQ(mesh.status, 0) << mesh.said;
  const std::string written = folder.read("mesh/grid/grid_000000.vts");
  for (const char* field : {"\"volume\"", "\"skew\"", "\"aspect_ratio\""})
    EXPECT_NE(written.find(field), std::string::npos) << field;
  folder.write("again.toml", flow_in("kind = \"file\"\npath = \"mesh/grid/grid_000000.vts\""));
  const Outcome first = luff(folder, {"check", "case.toml"});
  const Outcome again = luff(folder, {"check", "again.toml"});
  const auto groups = [](const std::string& said) { return said.substr(said.find('\n')); };
  EXPECT_EQ(groups(again.said), groups(first.said));
}

TEST(CurvilinearGrid, IsWrittenByFourRanksInPieces)
{
  const WorkFolder folder;
  folder.write("case.toml", flow_in(pipe));
  const Outcome mesh = luff_on_ranks(4, folder, {"mesh", "case.toml", "--out", "mesh"});
  ASSERT_EQ(mesh.status, 0) << mesh.said;
  EXPECT_TRUE(folder.has("mesh/grid/grid_000000.pvts"));
  EXPECT_TRUE(folder.has("mesh/grid/grid_000000_r0003.vts"));
}

struct BadGrid {
  const char* name;
  std::string grid;
  std::string sides_of_eta;
  std::string more;
  std::vector<std::string> words;
};

void PrintTo(const BadGrid& bad, std::ostream* out)
{
  *out << bad.name;
}

class BadGridsAreRefused : public testing::TestWithParam<BadGrid> {};

TEST_P(BadGridsAreRefused, WithWhereTheyAreBad)
{
  const WorkFolder folder;
  folder.write("short.p3d", "3 3 3\n0 0 0 1 1 1\n");
  folder.write("case.toml", flow_in(GetParam().grid, GetParam().sides_of_eta) + GetParam().more);
  const Outcome check = luff(folder, {"check", "case.toml"});
  EXPECT_EQ(check.status, 2) << check.said;
  for (const std::string& word : GetParam().words)
    EXPECT_NE(check.said.find(word), std::string::npos) << word << " in " << check.said;
}

const BadGrid grids[] = {
    {"FoldedCells",
     mapped_box("[\"abs(x - 0.3)\", \"y\", \"z\"]"),
     "wall",
     "",
     {"case.toml:7:", "the grid's cell (", "has negative volume"}},
    {"FlatCells", mapped_box("[\"x\", \"y\", 0]"), "wall", "", {"case.toml:7:", "has no volume"}},
    {"NodesNowhere",
     mapped_box("[\"sqrt(x - 0.5)\", \"y\", \"z\"]"),
     "wall",
     "",
     {"case.toml:7:", "grid: node (0, 0, 0) is at (", "nan"}},
    {"PeriodicSidesOfAnotherShape",
     mapped_box("[\"x + 0.1*y*sin(z)\", \"y\", \"z\"]"),
     "periodic",
     "",
     {"case.toml:7:", "opposite sides along eta are periodic"}},
    {"APipeThatFolds",
     "kind = \"bent-pipe\"\nradius = 1.5\nacross = 4\nalong = { cells = 8 }\n[[grid.piece]]\nbend = { radius = 1, "
     "angle "
     "= 90, towards = [1, 0, 0] }",
     "wall",
     "",
     {"case.toml:7:", "the pipe folds at s = 0"}},
    {"AFileCutShort",
     "kind = \"file\"\npath = \"short.p3d\"",
     "wall",
     "",
     {"case.toml:7:", "short.p3d: ends after 6 coordinates; 3 x 3 x 3 nodes have 81"}},
    {"ARefinementOutside",
     "kind = \"pipe\"\nlength = 2.0\nradius = 0.5\nacross = 8\nalong = { cells = 10, refine = { from "
     "= 1, to = 3, spacing = 0.5 } }",
     "wall",
     "",
     {"case.toml:12:", "grid.along.refine = [1, 3] must lie between 0 and 2"}},
    {"AProbeOutside",
     pipe,
     "wall",
     "[[output.probe]]\nname = \"far\"\npoint = [0.6, 0, 1]\n",
     {"probe 'far': (0.6, 0, 1) lies outside the grid"}},
};

INSTANTIATE_TEST_SUITE_P(Grids, BadGridsAreRefused, testing::ValuesIn(grids),
                         [](const auto& bad) { return std::string(bad.param.name); });

/// An orifice plate across the pipe of `pipe`, which ends less than half a cell from the wall.
const std::string orifice =
    "[[body]]\nname = \"orifice\"\nmesh = { shape = \"annulus\", centre = [0, 0, 0.9], axis = [0, 0, 1], radius = "
    "0.48, inner_radius = 0.3, divisions = [32, 4] }\n";
/// A ball in it, closed.
const std::string ball =
    "[[body]]\nname = \"ball\"\nmesh = { shape = \"sphere-cap\", centre = [0.02, 0.01, 0.9], axis = [0, 0, 1], "
    "radius = 0.2, rings = 8, polar = { from = 0, to = 180 } }\n";

TEST(BodiesInACurvilinearGrid, FeelTheFlowAlikeOnOneAndTwoRanks)
{
  const WorkFolder folder;
  for (const auto& [name, body] : {std::pair("orifice", orifice), std::pair("ball", ball)}) {
    folder.write("case.toml", flow_in(pipe) + body + "[output]\nwalls = { every = 0.1 }\n");
    const std::string one = std::string("one-") + name;
    const std::string two = std::string("two-") + name;
    const Outcome run = luff(folder, {"run", "case.toml", "--set", "time.step=0.0125", "--out", one});
    ASSERT_EQ(run.status, 0) << run.said;
    ASSERT_EQ(luff_on_ranks(2, folder, {"run", "case.toml", "--set", "time.step=0.0125", "--out", two}).status, 0);
    EXPECT_LT(read_summary(folder.path() / one)["max_divergence"], 1e-13);
    const std::string table = std::string("forces-") + name + ".csv";
    const double force = read_table(folder.path() / one / table).column("force_z [force]").back();
    EXPECT_GT(force, 0.0) << name << " is pushed along";
    EXPECT_NEAR(read_table(folder.path() / two / table).column("force_z [force]").back(), force, 1e-8 * force);
    EXPECT_NE(folder.read(one + "/walls/walls_000001.vtp").find("Name=\"shear_stress\""), std::string::npos);
  }
}

TEST(BodiesInACurvilinearGrid, AreRefusedWhereTheyLeaveItOrTouchItsWalls)
{
  const WorkFolder folder;
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string text = flow_in(pipe) + orifice;
    text.replace(text.find(from), from.size(), to);
    folder.write("case.toml", text);
    const Outcome check = luff(folder, {"check", "case.toml"});
    EXPECT_EQ(check.status, 2) << check.said;
    return check.said;
  };
  EXPECT_NE(said("radius = 0.48", "radius = 0.55").find("lies outside the grid"), std::string::npos);
  EXPECT_NE(said("centre = [0, 0, 0.9]", "centre = [0, 0, 0.0]").find("touches side zeta_min"), std::string::npos);
  EXPECT_NE(said("[[body]]\n", "[[body]]\nclosed = true\n").find("leaks through an edge"), std::string::npos);
}

}  // namespace
}  // namespace luff::test
