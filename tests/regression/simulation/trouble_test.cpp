// SPDX-License-Identifier: BSD-3-Clause
// A run that cannot go on says when, where and what may help, and leaves files that can be read; one that is asked to
// end does so cleanly.
#include "run_files.hpp"
#include "small_cases.hpp"

namespace luff::test {
namespace {

/// Every table of the run has whole lines and as many rows as steps were accepted, that of audits one for every ten;
/// every series can be opened.
void expect_readable(const std::filesystem::path& run, std::size_t steps)
{
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    if (entry.path().extension() == ".csv") {
      const std::size_t every = entry.path().filename() == "audit.csv" ? 10 : 1;
      EXPECT_EQ(read_table(entry.path()).rows.size(), steps / every) << entry.path();
    }
    if (entry.path().extension() == ".pvd") {
      EXPECT_FALSE(read_series(entry.path()).empty()) << entry.path();
    }
  }
}

/// One way to make a run of a small case fail, and words that the message must hold.
struct Trouble {
  const char* name;
  const std::string* text;
  std::vector<std::string> sets;
  std::vector<std::string> words;
  int steps;  ///< accepted before; -1: any number
};

void PrintTo(const Trouble& trouble, std::ostream* out)
{
  *out << ::testing::PrintToString(trouble.sets);
}

class RunsFail : public ::testing::TestWithParam<Trouble> {};

TEST_P(RunsFail, WithStepTimePlaceAndRemedyAndReadableFiles)
{
  const Trouble& trouble = GetParam();
  const WorkFolder folder;
  folder.write("case.toml", *trouble.text);
  std::vector<std::string> command{"run", "case.toml", "--out", "out"};
  for (const std::string& set : trouble.sets) {
    command.push_back("--set");
    command.push_back(set);
  }
  const Outcome run = luff(folder, command);
  EXPECT_EQ(run.status, 1) << run.said;
  ASSERT_TRUE(folder.has("out/summary.json")) << run.said;
  const nlohmann::json summary = read_summary(folder.path() / "out");
  EXPECT_EQ(summary["state"], "failed");
  const std::string reason = summary["reason"];
  for (const std::string& word : trouble.words)
    EXPECT_NE(reason.find(word), std::string::npos) << "no '" << word << "' in: " << reason;
  EXPECT_NE(run.said.find("luff: " + reason), std::string::npos) << run.said;
  const int steps = summary["steps"];
  if (trouble.steps >= 0) {
    EXPECT_EQ(steps, trouble.steps);
  }
  EXPECT_NE(reason.find("step " + std::to_string(steps + 1) + ", t = "), std::string::npos) << reason;
  expect_readable(folder.path() / "out", steps);
  EXPECT_NE(folder.read("out/log.txt").find("failed at t = "), std::string::npos);
}

const std::string light_flag = changed(small_flag, "density = 100.0", "density = 1.0");
const std::string shear_flow = changed(small_flag.substr(0, small_flag.find("[[shell]]")), "[1.0, 0.0, 0.0]\n[grid]",
                                       "[\"1 + sin(3*y)\", \"sin(2*x)\", 0.0]\n[grid]");

const Trouble troubles[] = {
    {"WhenTheStepIsAbsurd",
     &shear_flow,
     {"time.step=2", "time.end=20"},
     {"in cell (", ") at (", "smaller time.step"},
     -1},
    {"WhenTheFlowDiverges",
     &shear_flow,
     {"time.step=0.3", "time.end=300"},
     {"in cell (", ") at (", "smaller time.step"},
     -1},
    {"WhenThePressureDoesNotConverge",
     &small_flag,
     {"pressure.max_iterations=1"},
     {"the pressure did not converge", "after 1 iterations", "in cell (", ") at (", "may help"},
     0},
    {"WhenABoundaryIsNoNumber",
     &small_flag,
     {"boundary.x_min.value=[\"t > 0.05 ? sqrt(-t) : 1\", 0, 0]"},
     {"t = 0.06", "no number", "in cell (0, 0, 0) at (-0.9375, -0.9375, -0.4375)", "a formula of the case"},
     2},
    {"WhenABodyForceIsNoNumber",
     &small_flag,
     {"fluid.body_force=[\"t > 0.05 ? log(-t) : 0\", 0, 0]"},
     {"t = 0.06", "no number", "in cell (", "a formula of the case"},
     2},
    {"WhenALoadIsNoNumber",
     &small_strip,
     {"shell.strip.load.0.force=[0, 0, \"t > 0.12 ? sqrt(-t) : 0.001\"]"},
     // Told only when shorter steps, which help where a shell was bent too far in one, meet it again.
     {"t = 0.125", "shell 'strip': the force on vertex", " at (", "mend the formula"},
     4},
    {"WhenAShellIsTornAway",
     &small_strip,
     {"shell.strip.load.0.force=[0, 0, 1e6]"},
     {"shell 'strip' found no equilibrium", "at vertex", "(reference (", "smaller steps"},
     0},
    {"WhenStrongCouplingMayNotIterate",
     &light_flag,
     {"coupling.max_iterations=1"},
     {"the coupling of flow and structure did not converge", "after 1 iterations", "halved 3 times",
      "of shell 'flag' at (", "coupling.max_iterations"},
     0},
    {"WhenLooseCouplingBlowsUp", &light_flag, {"coupling.scheme=loose", "time.end=4"}, {"t = ", " (", "smaller"}, -1},
    {"WhenABodyLeavesTheGrid",
     &small_flag,
     {"body=[{ name = \"plate\", mesh = { shape = \"rectangle\", origin = [1.5, -0.2, -0.2], a = [0, 0.4, 0], b = [0, "
      "0, "
      "0.4], divisions = [2, 2] }, motion = { type = \"prescribed\", translation = [\"10*t\", 0, 0] } }]"},
     {"t = 0.06", "outside the grid along x", "(2.1, -0.2, -0.2)", "grid must reach further"},
     2},
};

INSTANTIATE_TEST_SUITE_P(Trouble, RunsFail, ::testing::ValuesIn(troubles),
                         [](const auto& trouble) { return trouble.param.name; });

TEST(Trouble, AStaticLoadBeyondAllBoundsFailsWithLoadFactorAndPlace)
{
  const WorkFolder folder;
  std::string text = changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"static\"\n");
  folder.write("case.toml", changed(text, "\"0.001*t\"", "1e9"));
  const Outcome run = luff(folder, {"run", "case.toml", "--out", "out"});
  EXPECT_EQ(run.status, 1) << run.said;
  const nlohmann::json summary = read_summary(folder.path() / "out");
  EXPECT_EQ(summary["state"], "failed");
  const std::string reason = summary["reason"];
  for (const char* word : {"static step", "load factor", "shell 'strip'", " at "})
    EXPECT_NE(reason.find(word), std::string::npos) << reason;
  expect_readable(folder.path() / "out", 0);
}

void expect_clean_stop(const WorkFolder& folder, const Outcome& run)
{
  EXPECT_EQ(run.status, 0) << run.said;
  EXPECT_NE(run.said.find("stopped at t = "), std::string::npos) << run.said;
  const nlohmann::json summary = read_summary(folder.path() / "out");
  EXPECT_EQ(summary["state"], "stopped");
  const int steps = summary["steps"];
  EXPECT_GE(steps, 3);
  expect_readable(folder.path() / "out", steps);
  // The last instant is written, whatever the cadence.
  EXPECT_DOUBLE_EQ(read_series(folder.path() / "out/fields.pvd").back(), summary["t"]);
  EXPECT_DOUBLE_EQ(read_series(folder.path() / "out/shell-flag.pvd").back(), summary["t"]);
}

const std::vector<std::string> long_run{"run",   "case.toml",       "--out", "out",
                                        "--set", "time.end=100000", "--set", "output.fields.every=1000"};

TEST(ARunIsStopped, ByAFileNamedStopInItsFolder)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  std::vector<std::string> command = long_run;
  command.insert(command.begin(), LUFF_BINARY);
  Process process(command, folder.path());
  ASSERT_TRUE(wait_for_rows(folder.path() / "out/steps.csv"));
  folder.write("out/STOP", "");
  expect_clean_stop(folder, process.wait());
}

TEST(ARunIsStopped, ByAnInterrupt)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  std::vector<std::string> command = long_run;
  command.insert(command.begin(), LUFF_BINARY);
  Process process(command, folder.path());
  ASSERT_TRUE(wait_for_rows(folder.path() / "out/steps.csv"));
  process.signal(SIGINT);
  expect_clean_stop(folder, process.wait());
}

TEST(SeveralRanks, EndWithoutHangingWhenTheRunFails)
{
  const WorkFolder folder;
  folder.write("case.toml", small_flag);
  const Outcome run =
      luff_on_ranks(2, folder, {"run", "case.toml", "--out", "out", "--set", "pressure.max_iterations=1"});
  EXPECT_EQ(run.status, 1) << run.said;
  // After the step was halved three times.
  const auto first = run.said.find("luff: step 1, t = 0.0025: the pressure did not converge");
  ASSERT_NE(first, std::string::npos) << run.said;
  EXPECT_EQ(run.said.find("luff: step 1", first + 1), std::string::npos) << "told twice\n" << run.said;
  EXPECT_EQ(read_summary(folder.path() / "out")["state"], "failed");
}

}  // namespace
}  // namespace luff::test
