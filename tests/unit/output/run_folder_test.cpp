// SPDX-License-Identifier: BSD-3-Clause
// Folders of runs.
#include "output/run_folder.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scratch_folder.hpp"

namespace luff::output::test {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, RunsOfACaseAreNumberedFromOne)
{
  const ScratchFolder scratch;
  EXPECT_EQ(RunFolder::numbered(MPI_COMM_SELF, scratch.path(), "flag").path(), scratch.path() / "flag" / "001");
  EXPECT_EQ(RunFolder::numbered(MPI_COMM_SELF, scratch.path(), "flag").path(), scratch.path() / "flag" / "002");
  EXPECT_EQ(RunFolder::numbered(MPI_COMM_SELF, scratch.path(), "plate").path(), scratch.path() / "plate" / "001");
  EXPECT_TRUE(fs::is_directory(scratch.path() / "flag" / "002"));
}

TEST(RunFolder, TheNextNumberFollowsTheHighestEvenWhereOthersAreGone)
{
  const ScratchFolder scratch;
  for (const char* name : {"004", "1200", "notes", "77b"})
    fs::create_directories(scratch.path() / "flag" / name);
  EXPECT_EQ(RunFolder::numbered(MPI_COMM_SELF, scratch.path(), "flag").path().filename(), "1201");
}

TEST(RunFolder, AChosenFolderIsMadeWithItsParents)
{
  const ScratchFolder scratch;
  const fs::path chosen = scratch.path() / "a" / "b";
  {
    const auto folder = RunFolder::at(MPI_COMM_SELF, chosen);
    EXPECT_TRUE(fs::is_directory(chosen));
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
  EXPECT_NO_THROW(RunFolder::at(MPI_COMM_SELF, chosen)) << "an empty folder may be used";
}

TEST(RunFolder, AFolderThatHoldsSomethingIsRefusedAndLeftAsItIs)
{
  const ScratchFolder scratch;
  std::ofstream(scratch.path() / "precious") << "data";
  try {
    RunFolder::at(MPI_COMM_SELF, scratch.path());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(scratch.path().string()), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("not empty"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--out"), std::string::npos);
  }
  EXPECT_EQ(text_of(scratch.path() / "precious"), "data");
}

TEST(RunFolder, AFileAndAPathBelowAFileAreRefused)
{
  const ScratchFolder scratch;
  std::ofstream(scratch.path() / "file") << "data";
  EXPECT_THROW(RunFolder::at(MPI_COMM_SELF, scratch.path() / "file"), InputError);
  EXPECT_THROW(RunFolder::at(MPI_COMM_SELF, scratch.path() / "file" / "below"), InputError);
  EXPECT_THROW(RunFolder::numbered(MPI_COMM_SELF, scratch.path() / "file", "flag"), InputError);
}

TEST(RunFolder, AFolderThatCannotBeWrittenIsRefused)
{
  EXPECT_THROW(RunFolder::at(MPI_COMM_SELF, "/proc/luff"), InputError);
  EXPECT_THROW(RunFolder::numbered(MPI_COMM_SELF, "/proc", "luff"), InputError);
}

TEST(RunFolder, AFileNamedStopAsksTheRunToEnd)
{
  const ScratchFolder scratch;
  const auto folder = RunFolder::numbered(MPI_COMM_SELF, scratch.path(), "flag");
  EXPECT_FALSE(folder.stop_requested());
  std::ofstream(folder.file("STOP")) << "";
  EXPECT_TRUE(folder.stop_requested());
}

}  // namespace
}  // namespace luff::output::test
