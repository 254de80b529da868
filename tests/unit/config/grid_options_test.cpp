// SPDX-License-Identifier: BSD-3-Clause
// Grids of all kinds: what their keys mean, and how a wrong one is refused.
#include "case_text.hpp"

namespace luff::config {
namespace {

/// A valid flow in a grid whose lines are given; the sides are those of curvilinear grids.
std::string flow_in(const std::string& grid)
{
  return "[time]\nend = 1.0\nstep = 0.1\n[fluid]\ndensity = 1.0\nviscosity = 0.01\n[grid]\n" + grid +
         R"toml(
[boundary]
xi_min = { type = "wall" }
xi_max = { type = "wall" }
eta_min = { type = "wall" }
eta_max = { type = "wall" }
zeta_min = { type = "velocity", value = [0, 0, 1] }
zeta_max = { type = "outflow" }
)toml";
}

const std::string pipe = R"toml(kind = "pipe"
direction = [1, 0, 0]
length = 4.0
radius = "0.5 - 0.1*exp(-(s - 2)^2)"
across = 16
along = { cells = 40, refine = { from = 1.5, to = 2.5, spacing = 0.05 } })toml";

const std::string bent_pipe = R"toml(kind = "bent-pipe"
radius = 0.5
across = 16
along = { cells = 40 }
[[grid.piece]]
length = 1.0
[[grid.piece]]
bend = { radius = 2.0, angle = 90, towards = [1, 0, 0] })toml";

const std::string annulus = R"toml(kind = "annulus"
inner_radius = 0.5
outer_radius = 1.0
length = 2.0
outwards = { cells = 8 }
around = 32
along = { cells = 10 })toml";

const std::string channel = R"toml(kind = "channel"
x = { from = 0, to = 10, cells = 100 }
y = { from = 0, to = 1, cells = 20 }
z = { from = 0, to = 1, cells = 1 }
lower = -0.5
upper = "0.5 + 0.1*x")toml";

TEST(GridOptions, OfAPipeHoldItsRadiusAsAFunctionOfArcLength)
{
  const GridOptions grid = load_text(flow_in(pipe)).grid;
  EXPECT_EQ(grid.kind, GridKind::Pipe);
  EXPECT_EQ(grid.direction, Vec3::UnitX());
  EXPECT_DOUBLE_EQ(grid.radius.evaluate(Vec3::Zero(), 2.0), 0.4);
  EXPECT_EQ(grid.along.cells, 40);
  EXPECT_EQ(grid.along.refine, (RefineOptions{1.5, 2.5, 0.05}));
}

TEST(GridOptions, OfABentPipeHoldItsPiecesInOrder)
{
  const GridOptions grid = load_text(flow_in(bent_pipe)).grid;
  ASSERT_EQ(grid.pieces.size(), 2U);
  EXPECT_EQ(grid.pieces[0].length, 1.0);
  EXPECT_EQ(grid.pieces[1].bend, (BendOptions{2.0, 90.0, Vec3::UnitX()}));
}

TEST(GridOptions, OfAllKindsAreWrittenAndReadAgain)
{
  for (const std::string& kind :
       {pipe, bent_pipe, annulus, channel,
        std::string("kind = \"mapped-box\"\nx = { from = 0, to = 1, cells = 4 }\ny = { from = 0, to = 1, cells = 4 }\n"
                    "z = { from = 0, to = 1, cells = 4 }\nmap = [\"x + 0.1*sin(y)\", \"y\", \"z\"]"),
        std::string("kind = \"aorta\"\nannulus_radius = 0.0127\nacross = 48\nalong = { cells = 160 }")}) {
    const Case read = load_text(flow_in(kind));
    std::ostringstream written;
    write_case(read, written);
    EXPECT_EQ(load_text(written.str()), read) << written.str();
  }
}

TEST(GridOptions, ScaleTheirCountsAndSpacingsWithTheResolution)
{
  const GridOptions grid = load_text(flow_in(pipe), {.resolution = 0.5}).grid;
  EXPECT_EQ(grid.across, 8);
  EXPECT_EQ(grid.along.cells, 20);
  EXPECT_EQ(grid.along.refine->spacing, 0.1);
  EXPECT_EQ(load_text(flow_in(annulus), {.resolution = 2.0}).grid.around, 64);
}

TEST(GridOptions, NameTheSidesOfCurvilinearGridsByTheirIndexDirections)
{
  EXPECT_EQ(complaint_about(changed(flow_in(pipe), "xi_min = { type = \"wall\" }", "x_min = { type = \"wall\" }")),
            "case.toml:14: boundary.xi_min is missing: give the table [boundary.xi_min]\n"
            "case.toml:15: boundary.x_min is not a key of [boundary] (did you mean 'xi_min'?)");
  EXPECT_EQ(
      complaint_about(changed(small_case, "y_max = { type = \"slip\" }", "eta_max = { type = \"slip\" }")),
      "case.toml:13: boundary.y_max is missing: give the table [boundary.y_max]\n"
      "case.toml:17: boundary.eta_max is not a key of [boundary] (known: x_min, x_max, y_min, y_max, z_min, z_max)");
}

TEST(GridOptions, RefuseKeysOfAnotherKind)
{
  EXPECT_EQ(complaint_about(flow_in(pipe + "\naround = 8")),
            "case.toml:14: grid.around goes only with `kind = \"annulus\"`");
  EXPECT_EQ(complaint_about(changed(flow_in(pipe), "length = 4.0\n", "")),
            "case.toml:7: grid.length is missing: give a number > 0");
  EXPECT_NE(complaint_about(changed(flow_in(pipe), "kind = \"pipe\"", "kind = \"pip\""))
                .find("case.toml:8: grid.kind = \"pip\" must be \"box\", \"mapped-box\", \"pipe\""),
            std::string::npos);
}

TEST(GridOptions, RefuseFormulasOfOtherVariables)
{
  EXPECT_NE(complaint_about(changed(flow_in(pipe), "\"0.5 - 0.1*exp(-(s - 2)^2)\"", "\"0.5 - 0.1*t\""))
                .find("unknown name 't'"),
            std::string::npos);
  EXPECT_EQ(complaint_about(changed(flow_in(channel), "\"0.5 + 0.1*x\"", "\"0.5 + 0.1*z\"")),
            "case.toml:13: grid.upper = \"0.5 + 0.1*z\" may change with x, but not with z");
  EXPECT_EQ(complaint_about(changed(flow_in(channel), "\"0.5 + 0.1*x\"", "true")),
            "case.toml:13: grid.upper = true must be a number, or a formula of x");
}

TEST(GridOptions, RefuseABentPipeWithoutACentrelineOrWithTwo)
{
  EXPECT_EQ(complaint_about(flow_in("kind = \"bent-pipe\"\nradius = 1\nacross = 4\nalong = { cells = 4 }")),
            "case.toml:7: grid must have exactly one of piece, centreline; it has none");
  EXPECT_EQ(complaint_about(changed(flow_in(bent_pipe), "length = 1.0",
                                    "length = 1.0\nbend = { radius = 1, angle = 1, towards = [1, 0, 0] }")),
            "case.toml:14: grid.piece.0 must have exactly one of length, bend; it has length, bend");
}

TEST(GridOptions, RefuseAFileThatIsNotThere)
{
  EXPECT_EQ(complaint_about(flow_in("kind = \"file\"\npath = \"none.vts\"")),
            "case.toml:9: grid.path = \"none.vts\" must be the path of a file: there is no none.vts");
}

}  // namespace
}  // namespace luff::config
