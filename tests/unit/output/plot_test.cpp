// SPDX-License-Identifier: BSD-3-Clause
// tools/plot.py makes pictures of what the writers of this folder wrote.
#include <cmath>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>

#include "output/csv.hpp"
#include "output/series.hpp"
#include "sample_snapshots.hpp"
#include "scratch_folder.hpp"

namespace luff::output::test {
namespace {

namespace fs = std::filesystem;

class Plot : public testing::Test {
 protected:
  void write_flow()
  {
    const Index3 cells{60, 40, 4};
    FlowSeries series(folder);
    for (int n = 0; n < 4; ++n)
      series.write(n, sample_flow(cells, {{0, 0, 0}, cells}, n));
  }
  void write_sheet()
  {
    SurfaceSeries series(folder, "shell-flag");
    for (int n = 0; n < 8; ++n)
      series.write(0.5 * n, sample_sheet(10, 0.5 * n));
  }
  void write_tables()
  {
    std::vector<Column> columns{{"t", "time"}};
    add_vector(columns, "displacement", "length");
    CsvWriter probe(folder, "probe-tip.csv", columns);
    CsvWriter forces(folder, "forces-flag.csv", {{"t", "time"}, {"force_x", "force"}, {"force_y", "force"}});
    CsvWriter steps(folder, "steps.csv",
                    {{"step", ""},
                     {"t", "time"},
                     {"cfl", ""},
                     {"pressure_iterations", ""},
                     {"coupling_iterations", ""},
                     {"max_divergence", "1/time"},
                     {"flow_seconds", "second"}});
    for (int n = 1; n <= 300; ++n) {
      const double t = 0.02 * n;
      probe.row(std::vector{t, 0.05 * std::cos(4 * t), 0.3 * std::sin(2 * t), 0.});
      forces.row(std::vector{t, 1 + 0.1 * std::cos(4 * t), std::sin(2 * t)});
      steps.row(std::vector{1. * n, t, 0.5, 7., 3. + n % 2, 1e-14 * n, n > 1 ? 0.4 : std::nan("")});
    }
  }
  /// Runs the script; what it printed lies in `said`.
  int plot(const std::string& options = "")
  {
    const fs::path log = scratch.path() / "said";
    const std::string command = "MPLCONFIGDIR=" + scratch.path().string() +
                                " /usr/bin/python3 " LUFF_SOURCE_DIR "/tools/plot.py " + folder.path().string() + " " +
                                options + " > " + log.string() + " 2>&1";
    const int status = std::system(command.c_str());
    said = text_of(log);
    return status;
  }
  std::set<std::string> pictures() const
  {
    std::set<std::string> names;
    if (fs::exists(folder.file("plots")))
      for (const auto& entry : fs::directory_iterator(folder.file("plots"))) {
        names.insert(entry.path().filename());
        EXPECT_EQ(text_of(entry.path()).substr(1, 3), "PNG");
        EXPECT_GT(fs::file_size(entry.path()), 10000u) << entry.path();
      }
    return names;
  }

  ScratchFolder scratch;
  RunFolder folder = RunFolder::at(MPI_COMM_SELF, scratch.path() / "run");
  std::string said;
};

using Names = std::set<std::string>;

TEST_F(Plot, ACoupledRunGivesHistoriesVorticityAndShapes)
{
  write_flow();
  write_sheet();
  write_tables();
  ASSERT_EQ(plot(), 0) << said;
  EXPECT_EQ(pictures(), (Names{"probe-tip.png", "forces-flag.png", "steps.png", "vorticity.png",
                               "vorticity-instants.png", "shapes.png"}));
  EXPECT_NE(said.find("plots/vorticity.png\n"), std::string::npos);
}

TEST_F(Plot, AStructureAloneGivesHistoriesAndShapes)
{
  write_sheet();
  write_tables();
  ASSERT_EQ(plot(), 0) << said;
  EXPECT_EQ(pictures(), (Names{"probe-tip.png", "forces-flag.png", "steps.png", "shapes.png"}));
}

TEST_F(Plot, AFlowAloneGivesVorticity)
{
  write_flow();
  ASSERT_EQ(plot("--normal y --instants 2"), 0) << said;
  EXPECT_EQ(pictures(), (Names{"vorticity.png", "vorticity-instants.png"}));
}

TEST_F(Plot, AFlowOnACurvilinearGridGivesVorticity)
{
  const Index3 cells{30, 20, 4};
  FlowSeries series(folder);
  for (int n = 0; n < 2; ++n)
    series.write(n, sample_curvilinear_flow(cells, {{0, 0, 0}, cells}, n));
  ASSERT_EQ(plot(), 0) << said;
  EXPECT_EQ(pictures(), (Names{"vorticity.png", "vorticity-instants.png"}));
}

TEST_F(Plot, ARunCutOffInTheMiddleOfALineIsStillDrawn)
{
  write_tables();
  fs::resize_file(folder.file("probe-tip.csv"), fs::file_size(folder.file("probe-tip.csv")) - 9);
  ASSERT_EQ(plot(), 0) << said;
  EXPECT_TRUE(pictures().contains("probe-tip.png"));
}

TEST_F(Plot, AFolderWithNothingToDrawIsSaidToBeOne)
{
  EXPECT_NE(plot(), 0);
  EXPECT_NE(said.find("holds nothing to draw"), std::string::npos) << said;
  EXPECT_EQ(said.find("Traceback"), std::string::npos);
}

}  // namespace
}  // namespace luff::output::test
