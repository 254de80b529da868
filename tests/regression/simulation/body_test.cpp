// SPDX-License-Identifier: BSD-3-Clause
// Closed and free bodies through the program.
#include <cmath>

#include "run_files.hpp"
#include "small_cases.hpp"

namespace luff::test {
namespace {

TEST(AFreeBody, IsMovedByTheFlowAndLeavesItsTables)
{
  const WorkFolder folder;
  folder.write("case.toml", small_ball);
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "out"});
  ASSERT_EQ(run.status, 0) << run.said;
  const auto motion = read_table(folder.path() / "out/motion-ball.csv");
  ASSERT_EQ(motion.rows.size(), 5U);
  EXPECT_GT(motion.column("centre_x [length]").back(), 0.001) << "the stream takes it along";
  EXPECT_LT(motion.column("velocity_z [velocity]").back(), 0.0) << "it falls";
  const double turn = motion.column("rotation_y [degrees]").back();
  EXPECT_GT(turn, 0.0) << "it spins on";
  EXPECT_LT(turn, 180.0 / M_PI * 0.1) << "less far than without the fluid";
  const auto forces = read_table(folder.path() / "out/forces-ball.csv");
  EXPECT_LT(forces.column("moment_y [moment]").back(), 0.0) << "the fluid slows its spin down";
  for (const double force : forces.column("force_minus_x [force]"))
    EXPECT_EQ(force, 0.0) << "there is no fluid inside";
  EXPECT_NE(folder.read("out/fields/fields_000002.vtr").find("Name=\"fluid\""), std::string::npos);
  const nlohmann::json summary = read_summary(folder.path() / "out");
  EXPECT_LT(summary["max_divergence"], 1e-13);
  EXPECT_LE(summary["max_coupling_iterations"], 15);
}

class AFreeBodyInBothSchemes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Schemes, AFreeBodyInBothSchemes, testing::Values("cut-link", "curvib"),
                         [](const auto& scheme) { return scheme.param == "curvib" ? "Curvib" : "CutLink"; });

std::string with_scheme(const std::string& text, const std::string& scheme)
{
  return text + "[immersed]\nscheme = \"" + scheme + "\"\n";
}

TEST_P(AFreeBodyInBothSchemes, MovesTheSameOnOneAndTwoRanks)
{
  const WorkFolder folder;
  folder.write("case.toml", with_scheme(small_ball, GetParam()));
  ASSERT_EQ(luff(folder, {"run", "case.toml", "--out", "one"}).status, 0);
  ASSERT_EQ(luff_on_ranks(2, folder, {"run", "case.toml", "--out", "two"}).status, 0);
  const auto one = read_table(folder.path() / "one/motion-ball.csv");
  const auto two = read_table(folder.path() / "two/motion-ball.csv");
  for (const char* column : {"centre_x [length]", "centre_z [length]", "rotation_y [degrees]", "velocity_z [velocity]"})
    EXPECT_NEAR(one.column(column).back(), two.column(column).back(), 1e-8) << column;
}

/// How fast a cylinder of a tenth of the fluid's density begins to rise, on cells of a size.
double rate_of_rise(double h, const std::string& scheme)
{
  const WorkFolder folder;
  std::string text = R"toml(title = "Rising cylinder"
[time]
end = 0.05
step = 0.01
[fluid]
density = 1.0
viscosity = 1e-5
body_force = [0.0, -1.0, 0.0]
[grid]
x = { from = -8.0, to = 8.0, cells = CELLS, refine = { from = -0.7, to = 0.7, spacing = SIZE } }
y = { from = -8.0, to = 8.0, cells = CELLS, refine = { from = -0.7, to = 0.7, spacing = SIZE } }
z = { from = 0.0, to = SIZE, cells = 1 }
[boundary]
x_min = { type = "slip" }
x_max = { type = "slip" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "symmetry" }
z_max = { type = "symmetry" }
[[body]]
name = "cylinder"
mesh = { shape = "cylinder", centre = [0.003, 0.007, 0], radius = 0.5, length = SIZE, divisions = [96, 1] }
closed = true
motion = { type = "free", density = 0.1, freedoms = ["x", "y", "turn_z"], gravity = [0, -1, 0] }
)toml";
  const auto replace_all = [&text](const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from))
      text.replace(at, from.size(), to);
  };
  replace_all("SIZE", std::to_string(h));
  replace_all("CELLS", std::to_string(std::lround(1.4 / h) + 40));
  folder.write("case.toml", with_scheme(text, scheme));
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "out"});
  EXPECT_EQ(run.status, 0) << run.said;
  EXPECT_LE(read_summary(folder.path() / "out")["max_coupling_iterations"], 12);
  return read_table(folder.path() / "out/motion-cylinder.csv").column("velocity_y [velocity]").back() / 0.05;
}

TEST_P(AFreeBodyInBothSchemes, LighterThanTheFluidRisesWithTheAddedMassOfACylinder)
{
  // (1 - 0.1) g = (0.1 + C_a) dv/dt with C_a = 1 for ideal fluid without bound; the steps of the cells add to C_a, of
  // the order of h (docs/numerics/bodies.md).
  const double exact = 0.9 / 1.1;
  const double coarse = exact - rate_of_rise(0.1, GetParam());
  const double fine = exact - rate_of_rise(0.05, GetParam());
  std::cout << "  rises slower by " << 100 * coarse / exact << " % at h = D/10, " << 100 * fine / exact
            << " % at D/20\n";
  EXPECT_LE(std::abs(fine), (GetParam() == "curvib" ? 0.16 : 0.08) * exact);
  EXPECT_LE(std::abs(fine), 0.65 * std::abs(coarse));
}

TEST(AClosedBody, ThatLeaksIsRefusedWithTheEdgesThatDo)
{
  const WorkFolder folder;
  folder.write("case.toml",
               changed(changed(small_ball, "polar = { from = 0, to = 180 }", "polar = { from = 0, to = 120 }"),
                       "motion = {", "closed = true\nmotion = {"));
  const Outcome run = luff(folder, {"run", "case.toml"});
  EXPECT_EQ(run.status, 2) << run.said;
  for (const char* words : {"case.toml:20", "body 'ball': declared closed, but it leaks through", "one side only: (",
                            "symmetry, slip and periodic sides"})
    EXPECT_NE(run.said.find(words), std::string::npos) << "no '" << words << "' in\n" << run.said;
  EXPECT_FALSE(folder.has("runs"));
}

TEST(AClosedBody, MayHaveItsEdgesOnSidesOfTheGrid)
{
  const WorkFolder folder;
  const std::string tube = changed(
      changed(small_ball,
              "\"sphere-cap\", centre = [0, 0.01, 0.02], radius = 0.4, polar = { from = 0, to = 180 }, rings = 8",
              "\"cylinder\", centre = [0, 0.01, -1], radius = 0.4, length = 2, divisions = [24, 8]"),
      "motion = { type = \"free\", density = 0.1, stiffness = [2, 0, 0], gravity = [0, 0, -1], spin = [0, 1, 0] }",
      "closed = true");
  folder.write("case.toml", tube);
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "out"});
  ASSERT_EQ(run.status, 0) << run.said;
  const auto forces = read_table(folder.path() / "out/forces-ball.csv");
  EXPECT_GT(forces.column("force_plus_x [force]").back(), 0.1);
  EXPECT_EQ(forces.column("force_minus_x [force]").back(), 0.0);
}

/// A key of the ball's motion that is wrong, and what is said.
struct BadMotion {
  const char* from;
  const char* to;
  const char* words;
};

TEST(AFreeBody, WithoutMassOrWithTwoIsRefused)
{
  for (const BadMotion& bad :
       {BadMotion{"density = 0.1", "density = 0.1, mass = 2", "must be given, or else `density`, not both"},
        BadMotion{"density = 0.1", "freedoms = [\"x\"]", "must be given, or else `density`, not both"},
        BadMotion{"density = 0.1", "density = 0.1, freedoms = [\"turn\"]", "turn_x"},
        BadMotion{"stiffness = [2, 0, 0]", "stiffness = [-2, 0, 0]", "must be three numbers >= 0"},
        BadMotion{"motion = {", "closed = false\nmotion = {", "only a closed body has a volume"}}) {
    const WorkFolder folder;
    folder.write("case.toml", changed(small_ball, bad.from, bad.to));
    const Outcome run = luff(folder, {"check", "case.toml"});
    EXPECT_EQ(run.status, 2) << run.said;
    EXPECT_NE(run.said.find(bad.words), std::string::npos) << "no '" << bad.words << "' in\n" << run.said;
  }
}

}  // namespace
}  // namespace luff::test
