// SPDX-License-Identifier: BSD-3-Clause
// Tables, the summary and the log.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "output/atomic_file.hpp"
#include "output/csv.hpp"
#include "output/log.hpp"
#include "output/summary.hpp"
#include "scratch_folder.hpp"

namespace luff::output::test {
namespace {

class Tables : public testing::Test {
 protected:
  ScratchFolder scratch;
  RunFolder folder = RunFolder::at(MPI_COMM_SELF, scratch.path() / "run");
};

TEST_F(Tables, HeadsNameColumnsAndUnits)
{
  std::vector<Column> columns{{"step", ""}, {"t", "time"}};
  add_vector(columns, "force", "force");
  const CsvWriter csv(folder, "forces-flag.csv", columns);
  EXPECT_EQ(text_of(folder.file("forces-flag.csv")), "step,t [time],force_x [force],force_y [force],force_z [force]\n");
}

TEST_F(Tables, EachRowIsOnDiskAtOnceWithAllItsDigits)
{
  CsvWriter csv(folder, "probe.csv", {{"t", "time"}, {"y", "length"}});
  const double t = 1.0 / 3, y = -std::sqrt(2) * 1e-9;
  csv.row(std::vector{t, y});
  std::ifstream in(folder.file("probe.csv"));
  std::string head, t_text, y_text;
  std::getline(in, head);
  std::getline(in, t_text, ',');
  std::getline(in, y_text);
  EXPECT_EQ(std::stod(t_text), t);
  EXPECT_EQ(std::stod(y_text), y);
}

TEST_F(Tables, WholeNumbersLookWholeAndWhatIsNotANumberIsLeftEmpty)
{
  CsvWriter csv(folder, "steps.csv", {{"step", ""}, {"cfl", ""}, {"t", "time"}});
  csv.row(std::vector{12., std::nan(""), 0.5});
  EXPECT_EQ(text_of(folder.file("steps.csv")), "step,cfl,t [time]\n12,,0.5\n");
}

TEST_F(Tables, ATableThatCannotBeWrittenEndsTheRun)
{
  EXPECT_THROW(CsvWriter(folder, "no-such-folder/probe.csv", {{"t", "time"}}), RunError);
}

TEST_F(Tables, AFullDiskEndsTheRun)
{
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "this system has no device that is always full";
  std::filesystem::create_symlink("/dev/full", folder.file("probe.csv"));
  EXPECT_THROW(CsvWriter(folder, "probe.csv", {{"t", "time"}}), RunError);
}

TEST_F(Tables, GoOnFromMarksWithWhatTheirNextRowWaitsFor)
{
  EarlierOutput earlier{.folder = folder.path(), .tables = {}, .series = {}};
  {
    CsvWriter csv(folder, "forces of flag.csv", {{"t", "time"}});
    CsvWriter other(folder, "probe.csv", {{"t", "time"}});
    csv.row(std::vector{1.0});
    csv.wait_with({1.0 / 3, -2e-300, 0.0});
    earlier.tables = {csv.mark(), other.mark()};
    csv.row(std::vector{2.0});
  }
  const EarlierOutput read = marks_of_text(text_of_marks(earlier));
  ASSERT_EQ(read.tables.size(), 2U);
  EXPECT_TRUE(read.tables[1].waiting.empty());
  earlier.tables = read.tables;
  const CsvWriter csv(folder, "forces of flag.csv", {{"t", "time"}}, &earlier);
  EXPECT_EQ(csv.waiting(), (std::vector{1.0 / 3, -2e-300, 0.0}));
  EXPECT_EQ(text_of(folder.file("forces of flag.csv")), "t [time]\n1\n");
}

TEST_F(Tables, AnAtomicFileIsReplacedWholeAndLeavesNothingBesideIt)
{
  write_atomically(folder.file("a.txt"), "first, and long");
  write_atomically(folder.file("a.txt"), "second");
  EXPECT_EQ(text_of(folder.file("a.txt")), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_THROW(write_atomically(folder.file("none/a.txt"), "x"), RunError);
}

TEST_F(Tables, TheSummaryIsJsonInTheOrderGiven)
{
  write_summary(folder, {{"status", "done"}, {"steps", 12}, {"cfl", std::nan("")}});
  EXPECT_EQ(text_of(folder.file("summary.json")), "{\n  \"status\": \"done\",\n  \"steps\": 12,\n  \"cfl\": null\n}\n");
}

TEST_F(Tables, TheLogSpeaksOnTheConsoleAndInTheFileLineByLine)
{
  const auto log = make_log(folder);
  testing::internal::CaptureStdout();
  log->info("Re = {}", 200);
  log->warn("the shell is light");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "Re = 200\nthe shell is light\n");
  const std::string text = text_of(folder.file("log.txt"));
  EXPECT_NE(text.find("Re = 200\n"), std::string::npos);
  EXPECT_NE(text.find("warning  the shell is light\n"), std::string::npos);
}

}  // namespace
}  // namespace luff::output::test
