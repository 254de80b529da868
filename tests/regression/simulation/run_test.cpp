// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves, that it can be repeated and changed, and that threads and ranks do not change its numbers.
#include <algorithm>

#include "run_files.hpp"
#include "small_cases.hpp"

namespace luff::test {
namespace {

using Columns = std::vector<std::string>;

const Columns step_columns{"step",
                           "t [time]",
                           "dt [time]",
                           "cfl",
                           "pressure_iterations",
                           "momentum_iterations",
                           "max_divergence",
                           "coupling_iterations",
                           "coupling_residual",
                           "kinetic [energy]",
                           "elastic [energy]",
                           "damping_work [energy]",
                           "external_work [energy]",
                           "support_work [energy]",
                           "fluid_work [energy]",
                           "flow_work [energy]",
                           "force_mismatch",
                           "contact_energy [energy]",
                           "contact_pairs",
                           "smallest_gap [length]",
                           "leak [velocity]",
                           "newton_iterations",
                           "seconds_search [s]",
                           "seconds_momentum [s]",
                           "seconds_cut_cells [s]",
                           "seconds_pressure [s]",
                           "seconds_loads [s]",
                           "seconds_shell [s]",
                           "seconds_output [s]"};

/// Runs a case given as text, which must succeed, into the folder `out`.
void run_well(const WorkFolder& folder, const std::string& text, const std::string& out = "out",
              const std::vector<std::string>& more = {}, const std::map<std::string, std::string>& environment = {})
{
  folder.write("case.toml", text);
  std::vector<std::string> command{"run", "case.toml", "--out", out};
  command.insert(command.end(), more.begin(), more.end());
  const Outcome run = luff(folder, command, environment);
  ASSERT_EQ(run.status, 0) << run.said;
  ASSERT_EQ(read_summary(folder.path() / out)["state"], "finished");
}

/// Tables whose numbers do not depend on how fast the machine is.
void expect_same_numbers(const WorkFolder& folder, const std::string& a, const std::string& b)
{
  for (const char* name : {"probe-tip.csv", "probe-wake.csv", "forces-flag.csv"})
    EXPECT_EQ(folder.read(a + "/" + name), folder.read(b + "/" + name)) << name;
}

/// Largest difference of two tables over the largest value of the column's quantity (x, y and z together).
double difference(const Table& a, const Table& b)
{
  EXPECT_EQ(a.head, b.head);
  EXPECT_EQ(a.rows.size(), b.rows.size());
  std::map<std::string, double> scale;
  std::map<std::string, double> largest;
  for (std::size_t c = 1; c < a.head.size(); ++c) {
    const std::string quantity = a.head[c].substr(0, a.head[c].find_first_of(" _"));
    const auto of_a = a.column(a.head[c]);
    const auto of_b = b.column(b.head[c]);
    for (std::size_t n = 0; n < of_a.size() && n < of_b.size(); ++n) {
      scale[quantity] = std::max(scale[quantity], std::abs(of_a[n]));
      largest[quantity] = std::max(largest[quantity], std::abs(of_a[n] - of_b[n]));
    }
  }
  double worst = 0.0;
  for (const auto& [quantity, value] : scale) {
    EXPECT_GT(value, 0.0) << quantity;
    worst = std::max(worst, largest[quantity] / value);
  }
  return worst;
}

TEST(ACoupledRun, LeavesEveryFileWithItsDocumentedColumns)
{
  const WorkFolder folder;
  run_well(folder, small_flag);
  const auto out = folder.path() / "out";
  EXPECT_EQ(read_table(out / "steps.csv").head, step_columns);
  EXPECT_EQ(read_table(out / "probe-tip.csv").head,
            (Columns{"t [time]", "displacement_x [length]", "displacement_y [length]", "displacement_z [length]",
                     "velocity_x [velocity]", "velocity_y [velocity]", "velocity_z [velocity]"}));
  EXPECT_EQ(read_table(out / "probe-wake.csv").head,
            (Columns{"t [time]", "velocity_x [velocity]", "velocity_y [velocity]", "velocity_z [velocity]",
                     "pressure [pressure]"}));
  EXPECT_EQ(read_table(out / "forces-flag.csv").head,
            (Columns{"t [time]", "force_x [force]", "force_y [force]", "force_z [force]", "force_minus_x [force]",
                     "force_minus_y [force]", "force_minus_z [force]", "force_plus_x [force]", "force_plus_y [force]",
                     "force_plus_z [force]"}));
  for (const char* name : {"steps.csv", "probe-tip.csv", "probe-wake.csv", "forces-flag.csv"})
    EXPECT_EQ(read_table(out / name).rows.size(), 5U) << name;
  EXPECT_NE(folder.read("out/log.txt").find("finished at t = 0.1 after 5 steps"), std::string::npos);
  const nlohmann::json summary = read_summary(out);
  EXPECT_EQ(summary["title"], "Small flag");
  EXPECT_EQ(summary["steps"], 5);
  EXPECT_EQ(summary["t"], 0.1);
  EXPECT_EQ(summary["cells"], 24 * 16 * 8);
  EXPECT_LT(summary["max_divergence"], 1e-13);
}

TEST(ACoupledRun, AuditsItsForcesAndWork)
{
  const WorkFolder folder;
  run_well(folder, small_flag, "out", {"--set", "output.audit=2", "--set", "time.end=0.4"});
  const Table audit = read_table(folder.path() / "out/audit.csv");
  EXPECT_EQ(audit.head, (Columns{"t [time]", "by_traction_flag_x [force]", "by_traction_flag_y [force]",
                                 "by_traction_flag_z [force]", "by_momentum_flag_x [force]",
                                 "by_momentum_flag_y [force]", "by_momentum_flag_z [force]", "kinetic [energy]",
                                 "growth [power]", "dissipation [power]", "power_of_sides [power]",
                                 "power_of_surfaces [power]", "power_of_body_force [power]", "missing [power]"}));
  EXPECT_EQ(audit.rows.size(), 10U);
  const nlohmann::json summary = read_summary(folder.path() / "out");
  const nlohmann::json verdict = summary["audit"]["flag"];
  EXPECT_EQ(verdict["audits"], 10);
  EXPECT_GT(verdict["mean_force_by_momentum"][0], 0.0);
  EXPECT_LT(verdict["mismatch_of_means"], 0.2);  // six cells to the flag's length
  EXPECT_GT(verdict["mismatch_of_means"], 0.0);
  EXPECT_LT(summary["audit"]["work"]["mismatch"], 0.02);  // twenty steps from a sudden start

  const nlohmann::json energy = summary["audit"]["energy"];
  EXPECT_EQ(energy["audits"], 10);
  EXPECT_GT(energy["dissipation"], 0.0);
  EXPECT_NEAR(energy["missing"].get<double>(),
              energy["power_of_sides"].get<double>() + energy["power_of_surfaces"].get<double>() -
                  energy["dissipation"].get<double>() - energy["growth"].get<double>(),
              1e-12);
  EXPECT_NEAR(energy["kinetic"].get<double>(), 0.5 * 3.0 * 2.0, 0.2);  // a stream of speed 1 through a box of 3 x 2 x 1

  run_well(folder, small_flag, "without", {"--set", "output.audit=0"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "without/audit.csv"));
  EXPECT_FALSE(read_summary(folder.path() / "without").contains("audit"));
}

TEST(ACoupledRun, LeavesStatisticsRakesSectionsAndSurfacesWhenTheyAreDue)
{
  const WorkFolder folder;
  run_well(folder, small_flag + all_output);
  const auto out = folder.path() / "out";
  // Steps end at 0.02, 0.04, ..., 0.1.
  EXPECT_EQ(read_series(out / "slice-middle.pvd").size(), 3U);  // 0, 0.06, 0.1
  EXPECT_EQ(read_series(out / "iso-slow.pvd").size(), 3U);
  EXPECT_EQ(read_series(out / "statistics.pvd").size(), 2U);  // 0.06, 0.1
  EXPECT_NEAR(read_summary(out)["statistics"]["time"], 0.06, 1e-12);
  for (const char* field : {"velocity_mean", "velocity_rms", "velocity_covariance", "pressure_mean", "pressure_rms"})
    EXPECT_NE(folder.read("out/statistics/statistics_000001.vtr").find("Name=\"" + std::string(field) + "\""),
              std::string::npos)
        << field;
  for (const char* field : {"tawss_minus", "tawss_plus", "osi_minus", "osi_plus"})
    EXPECT_NE(folder.read("out/shell-flag/shell-flag_000000.vtp").find("Name=\"" + std::string(field) + "\""),
              std::string::npos)
        << field;
  EXPECT_NE(folder.read("out/log.txt").find("slice-middle.pvd"), std::string::npos);

  const Table rake = read_table(out / "rake-wake.csv");
  EXPECT_EQ(rake.head, (Columns{"t [time]", "distance [length]", "place_x [length]", "place_y [length]",
                                "place_z [length]", "velocity_x [velocity]", "velocity_y [velocity]",
                                "velocity_z [velocity]", "pressure [pressure]"}));
  ASSERT_EQ(rake.rows.size(), 3U * 5);  // 0, 0.04, 0.08
  // Its first point is the probe's.
  const Table probe = read_table(out / "probe-wake.csv");
  for (const int instant : {1, 2})
    for (int column = 0; column < 4; ++column)
      EXPECT_EQ(rake.rows[5 * instant][5 + column], probe.rows[2 * instant - 1][1 + column]);

  const Table section = read_table(out / "section-span.csv");
  EXPECT_EQ(section.head, (Columns{"t [time]", "from [length]", "to [length]", "force_per_length_x [force/length]",
                                   "force_per_length_y [force/length]", "force_per_length_z [force/length]"}));
  ASSERT_EQ(section.rows.size(), 2U * 3);  // 0.04, 0.08
  const Table forces = read_table(out / "forces-flag.csv");
  for (int instant = 0; instant < 2; ++instant)
    for (int d = 0; d < 3; ++d) {
      double sum = 0.0;
      double size = 0.0;
      for (int bin = 0; bin < 3; ++bin) {
        const std::vector<double>& row = section.rows[3 * instant + bin];
        sum += (row[2] - row[1]) * row[3 + d];
        size += std::abs((row[2] - row[1]) * row[3 + d]);
      }
      EXPECT_NEAR(sum, forces.rows[2 * instant + 1][1 + d], 1e-13 * std::max(size, 1e-3)) << instant << d;
    }
}

TEST(ACoupledRun, WritesFlowAndShellAtTheSameInstantsEachOnce)
{
  const WorkFolder folder;
  run_well(folder, small_flag);
  // Due at 0, 0.05 and 0.1; steps end at 0.06 and 0.1.
  const std::vector<double> instants{0.0, 0.06, 0.1};
  for (const char* name : {"out/fields.pvd", "out/shell-flag.pvd"}) {
    const auto times = read_series(folder.path() / name);
    ASSERT_EQ(times.size(), instants.size()) << name;
    for (std::size_t n = 0; n < times.size(); ++n)
      EXPECT_NEAR(times[n], instants[n], 1e-12) << name;
  }
  const std::string flow = folder.read("out/fields/fields_000002.vtr");
  for (const char* field : {"velocity", "pressure", "vorticity", "q_criterion"})
    EXPECT_NE(flow.find("Name=\"" + std::string(field) + "\""), std::string::npos) << field;
  const std::string shell = folder.read("out/shell-flag/shell-flag_000002.vtp");
  for (const char* field : {"displacement", "velocity", "pressure_minus", "pressure_plus", "shear_minus", "shear_plus"})
    EXPECT_NE(shell.find("Name=\"" + std::string(field) + "\""), std::string::npos) << field;
}

TEST(ACoupledRun, IsRepeatedToTheLastDigitByTheCaseThatItWrote)
{
  const WorkFolder folder;
  run_well(folder, small_flag, "first", {"--set", "fluid.viscosity=0.02", "--resolution", "0.75"});
  run_well(folder, folder.read("first/case.toml"), "second");
  expect_same_numbers(folder, "first", "second");
  EXPECT_EQ(folder.read("first/case.toml"), folder.read("second/case.toml"));
}

TEST(ACoupledRun, GivesTheSameBitsOnOneAndTwoThreads)
{
  const WorkFolder folder;
  run_well(folder, small_flag, "one", {"--threads", "1"});
  run_well(folder, small_flag, "two", {"--threads", "2"});
  expect_same_numbers(folder, "one", "two");
}

/// A sheet across a channel that is open at both ends: all of the fluid moves with it, 1 x 3 over 0.01 x 100.
const std::string piston = R"toml(title = "Piston"
[time]
end = 1
step = 0.01
[fluid]
density = 1.0
viscosity = 1e-9
[grid]
x = { from = -1.0, to = 2.0, cells = 36, refine = { from = -0.3, to = 0.3, spacing = 0.05 } }
y = { from = 0.0, to = 1.0, cells = 8 }
z = { from = 0.0, to = 0.5, cells = 4 }
[boundary]
x_min = { type = "pressure", pressure = 0 }
x_max = { type = "pressure", pressure = 0 }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "slip" }
z_max = { type = "slip" }
[[shell]]
name = "piston"
mesh = { shape = "rectangle", origin = [0.013, 0, 0], a = [0, 1, 0], b = [0, 0, 0.5], divisions = [2, 1] }
thickness = 0.01
density = 100.0
material = { model = "saint-venant-kirchhoff", young = 1e6, poisson = 0.3 }
[[shell.support]]
where = { all = true }
fixed = ["y", "z"]
)toml";

TEST(Check, FindsTheAddedMassOfAPistonAndSaysWhatItMeansForCoupling)
{
  const WorkFolder folder;
  folder.write("case.toml", piston);
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"check", "case.toml"};
    command.insert(command.end(), more.begin(), more.end());
    return luff(folder, command).said;
  };
  const auto ratio = [](const std::string& said) {
    const std::string words = "fluid that moves with the shells: up to ";
    const auto at = said.find(words);
    EXPECT_NE(at, std::string::npos) << said;
    return at == std::string::npos ? 0.0 : std::stod(said.substr(at + words.size()));
  };
  const std::string light = told({});
  EXPECT_NEAR(ratio(light), 3.0, 0.03);  // found to two per cent
  EXPECT_NE(light.find("loose coupling would be unstable, its limit is 0.42; strong coupling is right"),
            std::string::npos)
      << light;
  EXPECT_NE(told({"--set", "structure.scheme=newmark"}).find("its limit is 0.25; strong"), std::string::npos);
  const std::string loose = told({"--set", "coupling.scheme=loose"});
  EXPECT_NE(loose.find("WARNING: fluid that moves with the shells"), std::string::npos) << loose;
  const std::string heavy = told({"--set", "shell.0.density=1500"});
  EXPECT_NEAR(ratio(heavy), 0.2, 0.002);
  EXPECT_NE(heavy.find("loose coupling is stable, its limit is 0.42"), std::string::npos) << heavy;
  // A quarter of the channel is within the thickness: that fluid is none.
  const std::string thick = told(
      {"--set", "shell.0.thickness=0.75", "--set", "shell.0.density=1.3333333333", "--set", "shell.0.wetted=faces"});
  EXPECT_NEAR(ratio(thick), 2.25, 0.0225) << thick;
  // A fluid nearly at rest has no speed that the piston's could be measured by.
  const std::string calm = told({"--set", "fluid.initial.velocity=[1e-9, 0, 0]"});
  EXPECT_NEAR(ratio(calm), 3.0, 0.03) << calm;
}

// Newton's second law of the fluid in the channel; the shell weighs a three-thousandth of it.
TEST(ACoupledRun, CarriesAShellOfHardlyAnyMassWithoutTuning)
{
  const WorkFolder folder;
  folder.write("case.toml",
               piston + "[[output.probe]]\nname = \"middle\"\nshell = \"piston\"\npoint = [0.013, 0.5, 0.25]\n");
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "out", "--set", "shell.0.density=0.1", "--set",
                                    "boundary.x_min.pressure=1", "--set", "time.end=0.2"});
  ASSERT_EQ(run.status, 0) << run.said;
  EXPECT_NE(run.said.find("with shells 300 times heavier between iterations"), std::string::npos) << run.said;
  const auto out = folder.path() / "out";
  const nlohmann::json summary = read_summary(out);
  EXPECT_EQ(summary["halved_steps"], 0);
  EXPECT_LE(summary["mean_coupling_iterations"], 6.0);
  const Table probe = read_table(out / "probe-middle.csv");
  EXPECT_NEAR(probe.column("displacement_x [length]").back(), 0.5 * 0.2 * 0.2 / 3.001, 0.01 * 0.5 * 0.2 * 0.2 / 3.0);
}

// What the first stage of the first step brings is round-off of what the last one does.
TEST(ACoupledRun, BeginsInAFluidThatIsSetInMotionSlowly)
{
  const WorkFolder folder;
  run_well(folder, R"toml(title = "Plate in a channel that starts slowly"
[time]
end = 0.04
step = 0.02
[fluid]
density = 1000.0
viscosity = 1.0
[grid]
x = { from = 0.0, to = 1.5, cells = 24 }
y = { from = 0.0, to = 0.4, cells = 8 }
z = { from = 0.0, to = 0.05, cells = 1 }
[boundary]
x_min = { type = "velocity", value = ["0.3*0.5*(1 - cos(pi*t))", 0, 0] }
x_max = { type = "outflow" }
y_min = { type = "slip" }
y_max = { type = "slip" }
z_min = { type = "symmetry" }
z_max = { type = "symmetry" }
[[shell]]
name = "plate"
mesh = { shape = "rectangle", origin = [0.5, 0.003, 0], a = [0, 0.197, 0], b = [0, 0, 0.05], divisions = [4, 1] }
thickness = 0.1
density = 1000.0
material = { model = "saint-venant-kirchhoff", young = 1e4, poisson = 0.4 }
[[shell.support]]
where = { edge = [[0.5, 0.003, 0], [0.5, 0.003, 0.05]] }
type = "clamped"
)toml");
  const auto steps = read_table(folder.path() / "out/steps.csv");
  EXPECT_EQ(steps.rows.size(), 2U);  // none was halved
}

// Pressed together with half a unit of traction from either side, in one layer of cells at the end.
TEST(ACoupledRun, KeepsTwoFlagsThatMeetApart)
{
  const WorkFolder folder;
  run_well(folder, two_flags_that_meet);
  const auto out = folder.path() / "out";
  const nlohmann::json summary = read_summary(out);
  EXPECT_GT(summary["contact"]["most_pairs"], 50);
  EXPECT_EQ(summary["contact"]["crossings"], 0);
  EXPECT_GT(summary["contact"]["smallest_gap"], 0.3 * 0.05);
  EXPECT_LT(summary["contact"]["smallest_gap"], 0.05);
  EXPECT_LT(summary["max_divergence"], 1e-13);
  // The case is its own mirror image.
  const std::vector<double> lower = read_table(out / "probe-lower.csv").column("displacement_y [length]");
  const std::vector<double> upper = read_table(out / "probe-upper.csv").column("displacement_y [length]");
  ASSERT_EQ(lower.size(), 40U);
  for (std::size_t n = 0; n < lower.size(); ++n)
    EXPECT_NEAR(lower[n], -upper[n], 1e-8) << n;
}

/// Probes, forces and audit of a case on 2 and 4 ranks against those on 1.
void expect_the_same_on_ranks(const std::string& text)
{
  const WorkFolder folder;
  folder.write("case.toml", text);
  std::map<int, std::string> outs;
  for (const int ranks : {1, 2, 4}) {
    outs[ranks] = "out" + std::to_string(ranks);
    const Outcome run = luff_on_ranks(
        ranks, folder,
        {"run", "case.toml", "--out", outs[ranks], "--set", "coupling.tolerance=1e-10", "--set", "output.audit=1"});
    ASSERT_EQ(run.status, 0) << run.said;
  }
  for (const int ranks : {2, 4})
    for (const char* name : {"probe-tip.csv", "probe-wake.csv", "forces-flag.csv", "audit.csv"}) {
      const Table one = read_table(folder.path() / outs[1] / name);
      EXPECT_GE(one.rows.size(), 19U);
      const double d = difference(one, read_table(folder.path() / outs[ranks] / name));
      EXPECT_LE(d, 1e-7) << name << " on " << ranks << " ranks";
      testing::Test::RecordProperty(std::string(name) + " on " + std::to_string(ranks) + " ranks", std::to_string(d));
      std::cout << name << ", " << ranks << " ranks against 1: " << d << "\n";
    }
}

TEST(ACoupledRun, AgreesOnOneTwoAndFourRanksTo1e7)
{
  expect_the_same_on_ranks(changed(changed(small_flag, "end = 0.1", "end = 1.0"), "density = 100.0", "density = 20.0"));
}

TEST(ACoupledRun, OfAShellWithTwoFacesAgreesOnOneTwoAndFourRanksTo1e7)
{
  expect_the_same_on_ranks(
      changed(changed(thick_flag(), "end = 0.1", "end = 0.4"), "density = 100.0", "density = 2.0"));
}

TEST(Runs, AreNumberedByCaseAndNeverWrittenOver)
{
  const WorkFolder folder;
  std::filesystem::create_directory(folder.path() / "wing");
  folder.write("wing/case.toml", small_strip);
  folder.write("strip.toml", small_strip);
  for (const char* file : {"wing/case.toml", "wing/case.toml", "strip.toml"})
    ASSERT_EQ(luff(folder, {"run", file}).status, 0);
  for (const char* made : {"runs/wing/001", "runs/wing/002", "runs/strip/001"})
    EXPECT_TRUE(folder.has(std::filesystem::path(made) / "summary.json")) << made;
}

TEST(Runs, FollowOverridesFromTheCommandLine)
{
  const WorkFolder folder;
  run_well(folder, small_strip, "out", {"--set", "time.end=0.1", "--set", "shell.strip.density=2"});
  EXPECT_EQ(read_summary(folder.path() / "out")["t"], 0.1);
  EXPECT_NE(folder.read("out/case.toml").find("density = 2\n"), std::string::npos) << folder.read("out/case.toml");
}

TEST(Runs, HaveMoreCellsAndShorterStepsAtAHigherResolution)
{
  const WorkFolder folder;
  run_well(folder, small_flag, "out", {"--resolution", "0.5"});
  const nlohmann::json summary = read_summary(folder.path() / "out");
  EXPECT_EQ(summary["cells"], 12 * 8 * 4);
  EXPECT_EQ(summary["steps"], 3);  // 0.1 in steps of 0.04 at most
}

TEST(AFlowAlone, RunsAndWritesNoShellFiles)
{
  const WorkFolder folder;
  run_well(folder, small_flag.substr(0, small_flag.find("[[shell]]")) + "[output]\nfields = { every = 0.1 }\n");
  EXPECT_EQ(read_table(folder.path() / "out/steps.csv").rows.size(), 5U);
  EXPECT_EQ(read_series(folder.path() / "out/fields.pvd").size(), 2U);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out"))
    EXPECT_FALSE(entry.path().filename().string().starts_with("shell-")) << entry.path();
}

TEST(AFlowAlone, KeepsAUniformStreamToRoundOff)
{
  const WorkFolder folder;
  run_well(folder, small_flag.substr(0, small_flag.find("[[shell]]")) +
                       "[[output.probe]]\nname = \"wake\"\npoint = [1.5, 0.1, 0.2]\n");
  const Table wake = read_table(folder.path() / "out/probe-wake.csv");
  for (const double u : wake.column("velocity_x [velocity]"))
    EXPECT_NEAR(u, 1.0, 1e-13);
  for (const double v : wake.column("velocity_y [velocity]"))
    EXPECT_NEAR(v, 0.0, 1e-13);
}

TEST(AFixedBody, RunsInAStreamAndFeelsIt)
{
  const WorkFolder folder;
  run_well(folder,
           small_flag.substr(0, small_flag.find("[[shell]]")) +
               "[[body]]\nname = \"plate\"\nmesh = { shape = \"rectangle\", origin = [0.01, -0.3, -0.3], a = [0, 0.6, "
               "0], b = [0, 0, 0.6], divisions = [4, 4] }\n[output]\nshells = { every = 0.1 }\n");
  for (const double drag : read_table(folder.path() / "out/forces-plate.csv").column("force_x [force]"))
    EXPECT_GT(drag, 0.1);
  EXPECT_EQ(read_series(folder.path() / "out/body-plate.pvd").size(), 2U);
}

TEST(AStructureAlone, MovesInTimeWithTheWorkDoneOnItAsEnergy)
{
  const WorkFolder folder;
  run_well(folder, changed(small_strip, "step = 0.05", "step = 0.005"));
  EXPECT_EQ(read_table(folder.path() / "out/steps.csv").head, step_columns);
  const Table steps = read_table(folder.path() / "out/steps.csv");
  const double kinetic = steps.column("kinetic [energy]").back();
  const double elastic = steps.column("elastic [energy]").back();
  const double work = steps.column("external_work [energy]").back();
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(kinetic + elastic, work, 1e-3 * work);
  EXPECT_TRUE(std::isnan(steps.column("cfl").back()));
  EXPECT_FALSE(folder.has("out/forces-strip.csv"));
  EXPECT_FALSE(folder.has("out/fields.pvd"));
}

TEST(AStructureAlone, IsLoadedToItsEquilibriumInAStaticRun)
{
  const WorkFolder folder;
  std::string text =
      changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"static\"\nsteps = 4\n");
  run_well(folder, changed(text, "divisions = [4, 1]", "divisions = [16, 4]"));
  const Table end = read_table(folder.path() / "out/probe-end.csv");
  EXPECT_EQ(end.head, (Columns{"load_factor", "displacement_x [length]", "displacement_y [length]",
                               "displacement_z [length]", "newton_iterations"}));
  EXPECT_EQ(end.column("load_factor"), (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(read_series(folder.path() / "out/shell-strip.pvd").size(), 5U);
  // A slender beam: w = F L^3/(3 E I), with F what the formula gives at t = 1.
  const double stiffness = 1000.0 * 0.25 * std::pow(0.05, 3) / 12.0;
  const double deflection = 0.001 / (3.0 * stiffness);
  EXPECT_NEAR(end.column("displacement_z [length]").back(), deflection, 0.05 * deflection);
}

TEST(AStructureAlone, PressesShellsAgainstEachOtherAndABodyInAStaticRun)
{
  const WorkFolder folder;
  run_well(folder, pressed_strips);
  const auto out = folder.path() / "out";
  const nlohmann::json contact = read_summary(out)["contact"];
  EXPECT_GT(contact["most_pairs"], 5);
  EXPECT_EQ(contact["crossings"], 0);
  EXPECT_GT(contact["smallest_gap"], 0.3 * 0.04);
  EXPECT_LT(contact["smallest_gap"], 0.04);
  // The load reaches the lower strip through the upper one, the plate keeps it up.
  const double upper = read_table(out / "probe-upper.csv").column("displacement_z [length]").back();
  const double lower = read_table(out / "probe-lower.csv").column("displacement_z [length]").back();
  EXPECT_LT(upper, -0.01);
  EXPECT_GT(upper, -0.05) << "alone it would sink by a quarter of its length";
  EXPECT_GT(0.06 + upper - lower, 0.3 * 0.04) << "the upper one is above";
  EXPECT_LT(0.06 + upper - lower, 0.045);
  EXPECT_EQ(read_table(out / "steps-lower.csv").column("contact_pairs").back(),
            read_table(out / "steps-upper.csv").column("contact_pairs").back());
  for (const char* name : {"shell-lower.pvd", "shell-upper.pvd", "body-plate.pvd"})
    EXPECT_EQ(read_series(out / name).size(), 5U) << name;
}

// Turned by a quarter about the clamp's corner and lifted, without load: the end moves rigidly.
TEST(ARun, OfAStaticAnalysisTakesAShellAlongWithItsClamp)
{
  const WorkFolder folder;
  std::string text =
      changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"static\"\nsteps = 15\n");
  text = changed(text, "type = \"clamped\"\n",
                 "type = \"clamped\"\nmotion = { translation = [0, 0, \"2*t\"], rotation = { axis = [0, 1, 0], angle = "
                 "\"-90*t\" } }\n");
  run_well(folder, changed(text, "0.001*t", "0"));
  const Table end = read_table(folder.path() / "out/probe-end.csv");
  EXPECT_NEAR(end.column("displacement_x [length]").back(), -1.0, 1e-9);
  EXPECT_NEAR(end.column("displacement_z [length]").back(), 3.0, 1e-9);
}

TEST(ARun, OfAShakenStripCountsTheWorkOfItsSupport)
{
  const WorkFolder folder;
  run_well(folder,
           changed(small_strip, "type = \"clamped\"\n",
                   "type = \"clamped\"\nmotion = { translation = [0, 0, \"0.02*(1 - cos(6*t))\"] }\n"),
           "out", {"--set", "structure.scheme=midpoint", "--set", "time.step=0.01"});
  const Table steps = read_table(folder.path() / "out/steps.csv");
  const double stored = steps.column("kinetic [energy]").back() + steps.column("elastic [energy]").back();
  const double supplied = steps.column("external_work [energy]").back() + steps.column("support_work [energy]").back();
  EXPECT_GT(steps.column("support_work [energy]").back(), 0.1 * supplied);
  EXPECT_NEAR(stored / supplied, 1.0, 0.02);
}

TEST(AStructureAlone, IsBroughtToAPrescribedDisplacement)
{
  const WorkFolder folder;
  run_well(folder,
           changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n",
                   "[structure]\nanalysis = \"displacement-control\"\nsteps = 4\n[structure.control]\nwhere = { point "
                   "= [1, 0, 0] }\ncomponent = \"z\"\ndisplacement = 0.2\n"));
  const Table end = read_table(folder.path() / "out/probe-end.csv");
  const Table steps = read_table(folder.path() / "out/steps-strip.csv");
  EXPECT_EQ(steps.column("step"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(steps.column("load_factor"), end.column("load_factor"));
  EXPECT_EQ(steps.column("negative_pivots"), (std::vector<double>{0, 0, 0, 0}));
  for (int step = 1; step <= 4; ++step)
    EXPECT_NEAR(end.column("displacement_z [length]")[step - 1], 0.05 * step, 1e-12);
  EXPECT_EQ(read_summary(folder.path() / "out")["load_factor"], end.column("load_factor").back());
}

TEST(AStructureAlone, VibratesAtItsNaturalFrequencies)
{
  const WorkFolder folder;
  const std::string text =
      changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"modes\"\nmodes = 4\n");
  run_well(folder, changed(text, "divisions = [4, 1]", "divisions = [16, 4]"));
  const Table table = read_table(folder.path() / "out/frequencies-strip.csv");
  EXPECT_EQ(table.column("mode"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(read_series(folder.path() / "out/shell-strip.pvd").size(), 4U);
  const std::vector<double> omega = table.column("angular_frequency [1/time]");
  EXPECT_EQ(read_summary(folder.path() / "out")["angular_frequencies"]["strip"], omega);
  // A slender beam: omega = 1.8751^2 sqrt(E I/(rho A)) / L^2.
  const double exact = 1.8751 * 1.8751 * std::sqrt(1000.0 * 0.05 * 0.05 / 12.0);
  EXPECT_NEAR(omega[0], exact, 0.02 * exact);
  EXPECT_NEAR(table.column("frequency [1/time]")[0], omega[0] / (2.0 * 3.14159265358979), 1e-12 * omega[0]);
}

TEST(Commands, CheckPrintsTheGroupsOfAValidCaseAndWritesNothing)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  const Outcome check = luff(folder, {"check", "case.toml"});
  EXPECT_EQ(check.status, 0);
  for (const char* word : {"24 x 16 x 8 = 3072 cells", "Reynolds number", "mass ratio", "bending stiffness",
                           "35 vertices, 48 triangles", "the case is valid"})
    EXPECT_NE(check.said.find(word), std::string::npos) << word << " in " << check.said;
  EXPECT_FALSE(folder.has("runs"));
}

TEST(Commands, OptionsPrintsEveryTable)
{
  const WorkFolder folder;
  const Outcome options = luff(folder, {"options"});
  EXPECT_EQ(options.status, 0);
  for (const char* word : {"[time]", "[[shell]]", "[coupling]", "[[output.probe]]"})
    EXPECT_NE(options.said.find(word), std::string::npos) << word;
}

TEST(Commands, MeshWritesGridAndSurfaces)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  const Outcome mesh = luff(folder, {"mesh", "case.toml", "--out", "mesh"});
  EXPECT_EQ(mesh.status, 0) << mesh.said;
  EXPECT_EQ(read_series(folder.path() / "mesh/grid.pvd").size(), 1U);
  EXPECT_EQ(read_series(folder.path() / "mesh/flag.pvd").size(), 1U);
}

TEST(Commands, PlotMakesPicturesOfARun)
{
  const WorkFolder folder;
  run_well(folder, small_flag);
  const Outcome plot = luff(folder, {"plot", "out"});
  EXPECT_EQ(plot.status, 0) << plot.said;
  for (const char* picture : {"probe-tip.png", "forces-flag.png", "steps.png", "vorticity.png", "shapes.png"})
    EXPECT_TRUE(folder.has(std::filesystem::path("out/plots") / picture)) << picture << "\n" << plot.said;
}

TEST(ShippedCases, AllPassTheCheck)
{
  const WorkFolder folder;
  int cases = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(LUFF_SOURCE_DIR) + "/cases")) {
    if (entry.path().extension() != ".toml")
      continue;
    ++cases;
    const Outcome check = luff(folder, {"check", entry.path().string()});
    EXPECT_EQ(check.status, 0) << entry.path() << ": " << check.said;
  }
  EXPECT_GE(cases, 7);
}

}  // namespace
}  // namespace luff::test
