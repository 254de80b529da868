// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on from a checkpoint gives what one that was never interrupted gives, and nothing that happens to a
// run or its checkpoints loses it.
#include <algorithm>
#include <numeric>
#include <set>

#include <sys/resource.h>

#include <fmt/core.h>

#include "output/checkpoint_file.hpp"
#include "run_files.hpp"
#include "small_cases.hpp"

namespace luff::test {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Words every_fifth_step{"--set", "output.checkpoint.every=0.1"};

/// `luff run case.toml` with these arguments, on some ranks; expects success.
void run_well(const WorkFolder& folder, const Words& arguments, int ranks = 1)
{
  const Words command = Words{"run", "case.toml"} + arguments;
  const Outcome run = ranks == 1 ? luff(folder, command) : luff_on_ranks(ranks, folder, command);
  ASSERT_EQ(run.status, 0) << run.said;
}

Words until(const std::string& end)
{
  return {"--set", "time.end=" + end};
}

Words into(const std::string& out)
{
  return {"--out", out};
}

/// A checkpoint as plain numbers.
std::vector<double> numbers(const std::filesystem::path& checkpoint, const std::string& name)
{
  std::vector<double> x;
  output::CheckpointReader(MPI_COMM_SELF, checkpoint).value(name, x);
  return x;
}

const Words flow_names{"flow/u_x", "flow/u_y", "flow/u_z", "flow/U_x",
                       "flow/U_y", "flow/U_z", "flow/p",   "flow/p_before"};
const Words shell_names{"shells/x", "shells/v", "shells/a"};

/// Largest difference over the largest value of a quantity, all components together.
double difference(const std::filesystem::path& a, const std::filesystem::path& b, const Words& names)
{
  std::map<char, double> scale, largest;
  for (const std::string& name : names) {
    const auto of_a = numbers(a, name), of_b = numbers(b, name);
    EXPECT_EQ(of_a.size(), of_b.size()) << name;
    EXPECT_FALSE(of_a.empty()) << name;
    const char quantity = name[name.find('/') + 1];
    for (std::size_t n = 0; n < of_a.size() && n < of_b.size(); ++n) {
      scale[quantity] = std::max(scale[quantity], std::abs(of_a[n]));
      largest[quantity] = std::max(largest[quantity], std::abs(of_a[n] - of_b[n]));
    }
  }
  double worst = 0;
  for (const auto& [quantity, size] : scale)
    worst = std::max(worst, largest[quantity] / size);
  return worst;
}

/// Columns of steps.csv but those that tell seconds.
void expect_same_steps(const std::filesystem::path& a, const std::filesystem::path& b)
{
  const Table of_a = read_table(a / "steps.csv"), of_b = read_table(b / "steps.csv");
  ASSERT_EQ(of_a.head, of_b.head);
  ASSERT_EQ(of_a.rows.size(), of_b.rows.size());
  for (const std::string& name : of_a.head)
    if (!name.starts_with("seconds_")) {
      const auto x = of_a.column(name), y = of_b.column(name);
      for (std::size_t n = 0; n < x.size(); ++n)
        EXPECT_TRUE(x[n] == y[n] || (std::isnan(x[n]) && std::isnan(y[n]))) << name << ", row " << n;
    }
}

/// Every table and picture that a run leaves but steps.csv, byte by byte.
void expect_same_results(const std::filesystem::path& a, const std::filesystem::path& b)
{
  const std::set<std::string> kinds{".csv", ".pvd", ".vtp", ".vtr", ".pvtr", ".vts", ".pvts"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(a)) {
    const auto name = std::filesystem::relative(entry.path(), a);
    if (name == "steps.csv" || !kinds.contains(name.extension()))
      continue;
    ASSERT_TRUE(std::filesystem::exists(b / name)) << name;
    EXPECT_TRUE(contents_of(entry.path()) == contents_of(b / name)) << name << " differs";
  }
}

/// Everything that a run leaves but log and times.
void expect_same_files(const std::filesystem::path& a, const std::filesystem::path& b)
{
  expect_same_results(a, b);
  expect_same_steps(a, b);
}

/// A small flag whose run of ten steps is in `whole`, and another that was stopped after five.
class Restart : public testing::Test {
 protected:
  void prepare(const std::string& text, int ranks = 1) const
  {
    folder.write("case.toml", text);
    run_well(folder, until("0.2") + every_fifth_step + into("whole"), ranks);
    run_well(folder, until("0.2") + every_fifth_step + into("parts"), ranks);
    // As if it had been killed after the fifth step's checkpoint: what came later is still there.
    std::filesystem::remove(parts / "checkpoint-00000010.h5");
  }
  [[nodiscard]] Outcome go_on(const Words& more = {}) const
  {
    return luff(folder, Words{"run", "case.toml", "--restart", "parts"} + until("0.2") + every_fifth_step + more);
  }

  WorkFolder folder;
  std::filesystem::path whole = folder.path() / "whole";
  std::filesystem::path parts = folder.path() / "parts";
};

TEST_F(Restart, LeavesTheSameBytesInEveryFile)
{
  prepare(small_flag);
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
  EXPECT_EQ(difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", flow_names + shell_names),
            0);
  EXPECT_EQ(read_summary(parts)["restarts"], 1);
  EXPECT_NE(folder.read("parts/log.txt").find("goes on from step 5, t = 0.1"), std::string::npos);
}

/// The small flag with walls, and with everything that can be written.
std::string flag_that_leaves_everything()
{
  return changed(changed(small_flag, "y_min = { type = \"slip\" }", "y_min = { type = \"wall\" }"), "shells = {",
                 "walls = { every = 0.05 }\nshells = {") +
         all_output;
}

const Words statistics_names{"statistics/u_x",
                             "statistics/u_y",
                             "statistics/p",
                             "statistics/uu_0",
                             "statistics/uu_4",
                             "statistics/pp",
                             "statistics/sheets/impulse",
                             "statistics/sheets/magnitude",
                             "statistics/walls/impulse",
                             "statistics/walls/magnitude"};

TEST_F(Restart, LeavesTheSameBytesOfStatisticsRakesSectionsAndSurfaces)
{
  prepare(flag_that_leaves_everything());
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
  for (const std::string& name : statistics_names)
    EXPECT_EQ(difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", {name}), 0) << name;
  EXPECT_NEAR(read_summary(parts)["statistics"]["time"], 0.16, 1e-12);
}

TEST_F(Restart, TakesStatisticsFromOtherRanks)
{
  prepare(flag_that_leaves_everything(), 2);
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  for (const std::string name : {"statistics/u_x", "statistics/uu_0", "statistics/pp", "statistics/sheets/magnitude"})
    EXPECT_LT(difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", {name}), 1e-7) << name;
  // Walls are in the order of the ranks that wrote them.
  const auto total = [&](const std::filesystem::path& of) {
    const auto all = numbers(of / "checkpoint-00000010.h5", "statistics/walls/magnitude");
    return std::accumulate(all.begin(), all.end(), 0.0);
  };
  EXPECT_GT(total(whole), 0.0);
  EXPECT_NEAR(total(parts) / total(whole), 1.0, 1e-7);
}

TEST_F(Restart, BeginsStatisticsAnewThatStartAtAnotherTime)
{
  prepare(flag_that_leaves_everything());
  const Outcome run = go_on({"--set", "output.statistics.start=0.12"});
  ASSERT_EQ(run.status, 0) << run.said;
  EXPECT_NEAR(read_summary(parts)["statistics"]["time"], 0.08, 1e-12);
}

TEST_F(Restart, GivesTheSameBitsOnTwoThreads)
{
  prepare(small_flag);
  const Outcome run = go_on({"--threads", "2"});
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsOnTwoRanks)
{
  prepare(small_flag, 2);
  run_well(folder, until("0.2") + every_fifth_step + Words{"--restart", "parts"}, 2);
  expect_same_files(whole, parts);
  EXPECT_EQ(difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", flow_names + shell_names),
            0);
}

TEST_F(Restart, GivesTheSameBitsOfAClosedBodyThatTheFlowMoves)
{
  prepare(small_ball);
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
  EXPECT_EQ(
      difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", flow_names + Words{"bodies/free"}),
      0);
}

TEST_F(Restart, GivesTheSameBitsOfAShellWithTwoFaces)
{
  prepare(thick_flag());
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsOfAFlagWhoseEdgesCoverFacesInPart)
{
  prepare(changed(small_flag, "[output]\n", "[immersed]\nedges = \"partial\"\n[output]\n"));
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsOfAFlagWhoseEdgesCoverFacesInPartBetweenWavedGridLines)
{
  std::string text = changed(small_flag, "[output]\n", "[immersed]\nedges = \"partial\"\n[output]\n");
  text = changed(text, "[grid]\n",
                 "[grid]\nkind = \"mapped-box\"\n"
                 "map = [\"x + 0.06*sin(pi*x)*sin(pi*y)\", \"y - 0.06*sin(pi*x)*sin(pi*y)\", \"z\"]\n");
  for (const auto& [axis, direction] : {std::pair{"x", "xi"}, {"y", "eta"}, {"z", "zeta"}})
    for (const char* end : {"_min", "_max"})
      text = changed(text, fmt::format("\n{}{}", axis, end), fmt::format("\n{}{}", direction, end));
  prepare(text);
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsWithAitkensFactor)
{
  prepare(changed(small_flag, "[output]\n", "[coupling]\nacceleration = \"aitken\"\n[output]\n"));
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsOfAnImplicitFlow)
{
  prepare(changed(small_flag, "[time]\n", "[time]\nscheme = \"newton-krylov\"\n"));
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, GivesTheSameBitsOfAStructureWithDampingMovingSupportAndAnotherScheme)
{
  std::string text = changed(small_strip, "material =", "damping = { mass = 0.1, stiffness = 0.01 }\nmaterial =");
  text = changed(text, "type = \"clamped\"\n",
                 "type = \"clamped\"\nmotion = { translation = [0, 0, \"0.01*sin(t)^2\"] }\n");
  text = changed(text, "[[shell]]\n", "[structure]\nscheme = \"generalised-alpha\"\n[[shell]]\n");
  folder.write("case.toml", text);
  const Words often{"--set", "output.checkpoint.every=0.2"};
  run_well(folder, often + into("whole"));
  run_well(folder, often + into("parts"));
  std::filesystem::remove(parts / "checkpoint-00000010.h5");
  run_well(folder, often + Words{"--restart", "parts"});
  expect_same_files(whole, parts);
  EXPECT_EQ(difference(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5", shell_names), 0);
}

TEST_F(Restart, IntoAnotherFolderTakesTheTablesAlongAndRefersToTheEarlierInstants)
{
  prepare(small_flag);
  const Outcome run = go_on(into("new"));
  ASSERT_EQ(run.status, 0) << run.said;
  expect_same_steps(whole, folder.path() / "new");
  EXPECT_EQ(folder.read("whole/probe-tip.csv"), folder.read("new/probe-tip.csv"));
  EXPECT_EQ(read_series(folder.path() / "new/fields.pvd"), read_series(whole / "fields.pvd"));
  EXPECT_EQ(read_table(parts / "steps.csv").rows.size(), 10U) << "the earlier run is left as it was";
}

TEST_F(Restart, OfAFlowAloneOnOtherRanksDiffersByRoundOffFiftyStepsLater)
{
  folder.write("case.toml", small_flag.substr(0, small_flag.find("[[shell]]")));
  const Words often{"--set", "output.checkpoint.every=0.2"};
  run_well(folder, until("1.2") + often + into("whole"));
  run_well(folder, until("0.2") + often + into("parts"));
  run_well(folder, until("1.2") + often + Words{"--restart", "parts"}, 2);
  EXPECT_LT(difference(whole / "checkpoint-00000060.h5", parts / "checkpoint-00000060.h5", flow_names), 1e-11);
}

TEST_F(Restart, OfACoupledRunOnOtherRanksDiffersByTheCouplingsToleranceFiftyStepsLater)
{
  folder.write("case.toml", small_flag);
  const Words often{"--set", "output.checkpoint.every=0.2"};
  run_well(folder, until("1.2") + often + into("whole"), 2);
  run_well(folder, until("0.2") + often + into("parts"), 2);
  run_well(folder, until("1.2") + often + Words{"--restart", "parts"});
  EXPECT_LT(difference(whole / "checkpoint-00000060.h5", parts / "checkpoint-00000060.h5", flow_names + shell_names),
            1e-7);
}

TEST_F(Restart, UsesTheCheckpointBeforeOneThatIsDamagedAndSaysSo)
{
  prepare(small_flag);
  std::filesystem::copy_file(whole / "checkpoint-00000010.h5", parts / "checkpoint-00000010.h5");
  std::filesystem::resize_file(parts / "checkpoint-00000010.h5", 5000);
  const Outcome run = go_on();
  ASSERT_EQ(run.status, 0) << run.said;
  EXPECT_NE(run.said.find("checkpoint-00000010.h5 is not used: it has 5000 bytes instead of"), std::string::npos)
      << run.said;
  expect_same_files(whole, parts);
}

TEST_F(Restart, IsRefusedWhereNoCheckpointCanBeUsed)
{
  prepare(small_flag);
  {
    std::fstream file(parts / "checkpoint-00000005.h5", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(9000);
    file << "spoilt";
  }
  const Outcome run = go_on();
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.said.find("no checkpoint can be used"), std::string::npos) << run.said;
  EXPECT_NE(run.said.find("checkpoint-00000005.h5 is not used: its checksum is wrong"), std::string::npos) << run.said;
}

TEST_F(Restart, IsRefusedForACaseThatChangedInMoreThanItMay)
{
  prepare(small_flag);
  const Outcome run = go_on({"--set", "shell.flag.density=50"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(
      run.said.find("--set shell.flag.density=50: shell.0.density = 50, and 100 in the checkpoint's run: only these "
                    "may change: title, time.end"),
      std::string::npos)
      << run.said;
  EXPECT_EQ(read_table(parts / "steps.csv").rows.size(), 10U) << "nothing was touched";
}

TEST_F(Restart, IsRefusedForARunThatIsAtItsEnd)
{
  folder.write("case.toml", small_flag);
  run_well(folder, every_fifth_step + into("parts"));
  const Outcome run = luff(folder, Words{"run", "case.toml", "--restart", "parts"} + every_fifth_step);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.said.find("the run is at its end, t = 0.1; let it go on with --set time.end="), std::string::npos)
      << run.said;
}

TEST_F(Restart, IsRefusedWhileTheRunIsWriting)
{
  folder.write("case.toml", small_flag);
  const Words command = Words{LUFF_BINARY, "run", "case.toml"} + until("1000") + every_fifth_step + into("parts");
  Process running(command, folder.path());
  const auto checkpoint = parts / "checkpoint-00000005.h5";
  for (int n = 0; n < 3000 && !std::filesystem::exists(checkpoint); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  // Elsewhere, or both would share the file that catches their output.
  const WorkFolder other;
  std::filesystem::copy_file(folder.path() / "case.toml", other.path() / "case.toml");
  const Outcome run =
      luff(other, Words{"run", "case.toml", "--restart", parts.string()} + until("1000") + every_fifth_step);
  running.signal(SIGINT);
  running.wait();
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.said.find("another run is writing there"), std::string::npos) << run.said;
}

TEST_F(Restart, GoesOnAfterAStopWithoutTheInstantOfTheStop)
{
  folder.write("case.toml", small_flag);
  run_well(folder, until("0.2") + into("whole"));
  folder.write("case.toml", small_flag);
  std::filesystem::create_directories(parts);
  {
    Process process(Words{LUFF_BINARY, "run", "case.toml"} + until("1000") + into("parts"), folder.path());
    for (int n = 0; n < 3000 && !std::filesystem::exists(parts / "steps.csv"); ++n)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    folder.write("parts/STOP", "");
    ASSERT_EQ(process.wait().status, 0);
  }
  const double stopped = read_summary(parts)["t"];
  ASSERT_LT(stopped, 0.18) << "the run was not stopped in time for what follows";
  run_well(folder, until("0.2") + Words{"--restart", "parts"});
  EXPECT_FALSE(folder.has("parts/STOP"));
  expect_same_files(whole, parts);
}

TEST_F(Restart, GoesOnAfterAFailureWithSmallerSteps)
{
  folder.write("case.toml", changed(small_flag, "density = 100.0", "density = 1.0"));
  const Words loose{"--set", "coupling.scheme=loose", "--set", "time.end=4"};
  const Outcome failed = luff(folder, Words{"run", "case.toml"} + loose + into("parts"));
  ASSERT_EQ(failed.status, 1) << failed.said;
  const int steps = read_summary(parts)["steps"];
  ASSERT_GT(steps, 0);
  const Outcome run = luff(folder, {"run", "case.toml", "--restart", "parts", "--set", "time.end=4", "--set",
                                    "time.step=0.01", "--set", "output.fields.every=100"});
  EXPECT_NE(run.said.find("goes on from step " + std::to_string(steps)), std::string::npos) << run.said;
}

TEST_F(Restart, LosesNothingWhereverTheRunIsKilled)
{
  folder.write("case.toml", small_flag);
  const Words often{"--set", "output.checkpoint.every=0.02"};
  run_well(folder, until("0.6") + often + into("whole"));
  run_well(folder, until("0.02") + often + into("parts"));
  int kills = 0;
  for (int n = 0; n < 40 && kills < 6; ++n) {
    Process process(Words{LUFF_BINARY, "run", "case.toml", "--restart", "parts"} + until("0.6") + often, folder.path(),
                    {{"OMPI_MCA_btl", "self"}, {"OMPI_MCA_pml", "ob1"}});
    const std::size_t rows = read_table(parts / "steps.csv").rows.size();
    for (int wait = 0; wait < 2000; ++wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::ifstream in(parts / "steps.csv");
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      if (lines > static_cast<long>(rows) + 2)
        break;
    }
    process.signal(SIGKILL);
    const Outcome outcome = process.wait();
    if (outcome.status == 0)
      break;
    ASSERT_EQ(outcome.status, 128 + SIGKILL) << outcome.said;
    ++kills;
  }
  EXPECT_GE(kills, 3);
  if (read_summary(parts)["steps"] != 30 || read_summary(parts)["state"] != "finished")
    run_well(folder, until("0.6") + often + Words{"--restart", "parts"});
  expect_same_files(whole, parts);
}

TEST_F(Restart, IsPossibleFromTheLastCheckpointThatFittedOnTheDisk)
{
  folder.write("case.toml", small_flag);
  const Words end = until("1.2") + every_fifth_step + Words{"--set", "output.fields.every=100"};
  run_well(folder, end + into("whole"));
  Process process(Words{LUFF_BINARY, "run", "case.toml"} + end + into("parts"), folder.path());
  for (int n = 0; n < 3000 && !std::filesystem::exists(parts / "checkpoint-00000005.h5"); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  constexpr rlim_t bytes = 150000;  // less than a checkpoint, more than the other files
  const rlimit limit{bytes, bytes};
  ASSERT_EQ(prlimit(process.id(), RLIMIT_FSIZE, &limit, nullptr), 0);
  const Outcome run = process.wait();
  EXPECT_EQ(run.status, 0) << run.said;
  EXPECT_NE(run.said.find("checkpoint-00000060.h5: cannot be written; is the disk full"), std::string::npos)
      << run.said;
  EXPECT_GE(read_summary(parts)["failed_checkpoints"], 1);
  run_well(folder, end + Words{"--restart", "parts"});
  expect_same_files(whole, parts);
}

/// A static run that fails where the shell folds by more than a limit in the middle of its way.
struct StaticPath {
  const char* name;
  std::string text;
  Words sets;
  const char* fold_limit;  ///< [degrees]
};

void PrintTo(const StaticPath& path, std::ostream* out)
{
  *out << path.name;
}

class StaticRestart : public testing::TestWithParam<StaticPath> {
 protected:
  [[nodiscard]] Outcome run(const Words& more) const
  {
    return luff(folder, Words{"run", "case.toml"} + GetParam().sets + more);
  }
  /// One run at a go in `whole`, one that failed in `parts`.
  void prepare() const
  {
    folder.write("case.toml", GetParam().text);
    const Outcome at_a_go = run(into("whole"));
    ASSERT_EQ(at_a_go.status, 0) << at_a_go.said;
    const Outcome failed =
        run(into("parts") + Words{"--set", std::string("structure.fold_limit=") + GetParam().fold_limit});
    ASSERT_EQ(failed.status, 1) << failed.said;
    ASSERT_NE(failed.said.find("go on from here with: luff run CASE --restart"), std::string::npos) << failed.said;
  }
  void expect_as_at_a_go(const std::filesystem::path& out) const
  {
    expect_same_results(whole, out);
    nlohmann::json summary = read_summary(out);
    EXPECT_EQ(summary["restarts"], 1);
    summary.erase("restarts");
    EXPECT_EQ(summary, read_summary(whole));
  }

  WorkFolder folder;
  std::filesystem::path whole = folder.path() / "whole";
  std::filesystem::path parts = folder.path() / "parts";
};

std::map<std::string, std::string> tables_of(const std::filesystem::path& run)
{
  std::map<std::string, std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(run))
    if (entry.path().extension() == ".csv")
      found[entry.path().filename()] = contents_of(entry.path());
  EXPECT_FALSE(found.empty());
  return found;
}

TEST_P(StaticRestart, LeavesTheSameBytesInItsOwnAndInANewFolder)
{
  prepare();
  const std::string before = folder.read("parts/summary.json");
  const Outcome elsewhere = run({"--restart", "parts", "--out", "new"});
  ASSERT_EQ(elsewhere.status, 0) << elsewhere.said;
  EXPECT_EQ(tables_of(folder.path() / "new"), tables_of(whole));
  EXPECT_EQ(folder.read("parts/summary.json"), before);
  const Outcome went_on = run({"--restart", "parts"});
  ASSERT_EQ(went_on.status, 0) << went_on.said;
  EXPECT_NE(went_on.said.find("goes on from step "), std::string::npos) << went_on.said;
  EXPECT_NE(went_on.said.find("changed: structure.fold_limit = 75"), std::string::npos) << went_on.said;
  expect_as_at_a_go(parts);
}

/// Names, the earliest first.
Words checkpoints_of(const std::filesystem::path& run)
{
  Words found;
  for (const auto& entry : std::filesystem::directory_iterator(run))
    if (entry.path().extension() == ".h5")
      found.push_back(entry.path().filename());
  std::sort(found.begin(), found.end());
  return found;
}

const std::string static_strip =
    changed(changed(small_strip, "[time]\nend = 0.5\nstep = 0.05\n", "[structure]\nanalysis = \"static\"\nsteps = 6\n"),
            "\"0.001*t\"", "0.004");

/// The second of them alone is loaded, and fails.
const std::string two_strips =
    changed(changed(pressed_strips.substr(0, pressed_strips.find("[[body]]")) +
                        pressed_strips.substr(pressed_strips.find("[output]")),
                    "[contact]\ndistance = 0.04\nstiffness = 1.0\n", ""),
            "[output]", "[[shell.load]]\nwhere = { all = true }\npressure = 0.003\n[output]");

const StaticPath static_paths[] = {
    {"OfLoadSteps", static_strip, {}, "12"},
    {"ThroughASnap", changed(small_roof, "\"arc-length\"", "\"static\"\nstabilisation = \"damping\""), {}, "5"},
    {"AlongAnArc", small_roof, {}, "3.4"},
    {"OfADisplacement",
     changed(changed(small_roof, "\"arc-length\"", "\"displacement-control\""), "thickness = 6.35", "thickness = 12.7"),
     {"--set", "structure.control={ where = { point = [0, 0, 2540] }, component = \"z\", displacement = -25 }"},
     "2.1"},
    {"WithContact", pressed_strips, {}, "1.2"},
    {"OfTheSecondShell", two_strips, {}, "3"},
};

INSTANTIATE_TEST_SUITE_P(Paths, StaticRestart, testing::ValuesIn(static_paths),
                         [](const auto& path) { return path.param.name; });

/// As if killed after the checkpoint before the last: what came later is still there.
TEST(StaticRestarts, GoOnFromCheckpointsAtACadenceWithTheSameBits)
{
  const std::pair<StaticPath, std::string> ways[] = {
      {static_paths[0], "strip"}, {static_paths[2], "roof"}, {static_paths[3], "roof"}};
  for (const auto& [path, shell] : ways) {
    SCOPED_TRACE(path.name);
    const WorkFolder folder;
    folder.write("case.toml", path.text);
    const Words sets = path.sets + Words{"--set", "output.checkpoint.every=2"};
    run_well(folder, sets + into("whole"));
    run_well(folder, sets + into("parts"));
    const std::filesystem::path whole = folder.path() / "whole", parts = folder.path() / "parts";
    const Words kept = checkpoints_of(parts);
    ASSERT_EQ(kept.size(), 2U);
    const std::size_t last = read_table(whole / ("steps-" + shell + ".csv")).rows.size() / 2 * 2;
    EXPECT_EQ(kept, (Words{fmt::format("checkpoint-{:08}.h5", last - 2), fmt::format("checkpoint-{:08}.h5", last)}));
    std::filesystem::remove(parts / kept.back());
    run_well(folder, sets + Words{"--restart", "parts"});
    expect_same_results(whole, parts);
    EXPECT_EQ(checkpoints_of(parts), kept);
  }
}

TEST(StaticRestarts, RefuseAnotherLoadOrMesh)
{
  const WorkFolder folder;
  folder.write("case.toml", static_strip);
  EXPECT_EQ(luff(folder, {"run", "case.toml", "--out", "parts", "--set", "structure.fold_limit=12"}).status, 1);
  const Outcome load =
      luff(folder, {"run", "case.toml", "--restart", "parts", "--set", "shell.strip.load.0.force=[0, 0, 0.005]"});
  EXPECT_EQ(load.status, 2);
  EXPECT_NE(load.said.find("0.004] in the checkpoint's run: only these may change"), std::string::npos) << load.said;
  const Outcome mesh =
      luff(folder, {"run", "case.toml", "--restart", "parts", "--set", "shell.strip.mesh.divisions=[5, 1]"});
  EXPECT_EQ(mesh.status, 2);
  EXPECT_NE(mesh.said.find("mesh.divisions"), std::string::npos) << mesh.said;
}

TEST(StaticRestarts, GoOnDampedFromALimitPoint)
{
  const WorkFolder folder;
  folder.write("case.toml", changed(small_roof, "\"arc-length\"", "\"static\""));
  const Outcome met = luff(folder, {"run", "case.toml", "--out", "parts"});
  EXPECT_EQ(met.status, 1);
  EXPECT_NE(met.said.find("has met a limit point near load factor"), std::string::npos) << met.said;
  run_well(folder, {"--restart", "parts", "--set", "structure.stabilisation=damping"});
  run_well(folder, {"--out", "whole", "--set", "structure.stabilisation=damping"});
  const double went_on = read_summary(folder.path() / "parts")["probes"]["force"][2];
  const double at_a_go = read_summary(folder.path() / "whole")["probes"]["force"][2];
  EXPECT_LT(at_a_go, -20);
  EXPECT_NEAR(went_on, at_a_go, 1e-9 * std::abs(at_a_go));
}

TEST(StaticRestarts, GoOnFromAStop)
{
  const WorkFolder folder;
  folder.write("case.toml", static_strip);
  const Words many{"--set", "structure.steps=600"};
  Process process(Words{LUFF_BINARY, "run", "case.toml", "--out", "parts"} + many, folder.path());
  ASSERT_TRUE(wait_for_rows(folder.path() / "parts/steps-strip.csv"));
  folder.write("parts/STOP", "");
  const Outcome stopped = process.wait();
  EXPECT_EQ(stopped.status, 0) << stopped.said;
  EXPECT_EQ(read_summary(folder.path() / "parts")["state"], "stopped");
  run_well(folder, many + Words{"--restart", "parts"});
  EXPECT_EQ(read_summary(folder.path() / "parts")["state"], "finished");
  const Table steps = read_table(folder.path() / "parts/steps-strip.csv");
  ASSERT_EQ(steps.rows.size(), 600U);
  const std::vector<double> number = steps.column("step");
  for (std::size_t n = 0; n < number.size(); ++n)
    EXPECT_EQ(number[n], static_cast<double>(n + 1));
}

}  // namespace
}  // namespace luff::test
