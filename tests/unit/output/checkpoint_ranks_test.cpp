// SPDX-License-Identifier: BSD-3-Clause
// Checkpoint files: what is written is read again on any number of ranks, and what is damaged is told.
#include <csignal>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/error.hpp"
#include "output/checkpoint_file.hpp"
#include "output/checkpoint_folder.hpp"
#include "output/integrity.hpp"
#include "parallel/decomposition.hpp"
#include "scratch_folder.hpp"

namespace luff::output::test {
namespace {

const Index3 cells{5, 6, 7};

/// A number that tells its place and component.
double mark(int component, int i, int j, int k)
{
  return 1000.0 * component + i + 0.1 * j + 0.01 * k;
}

class Checkpoints : public testing::Test {
 protected:
  Checkpoints() { MPI_Comm_rank(MPI_COMM_WORLD, &rank); }

  [[nodiscard]] Field<double> field_of(int component, const IndexBox& marked) const
  {
    Field<double> field(ranks.owned(), -1.0);
    for (int k = marked.lo[2]; k < marked.hi[2]; ++k)
      for (int j = marked.lo[1]; j < marked.hi[1]; ++j)
        for (int i = marked.lo[0]; i < marked.hi[0]; ++i)
          field(i, j, k) = mark(component, i, j, k);
    return field;
  }
  [[nodiscard]] Field3<double> faces() const
  {
    const IndexBox& o = ranks.owned();
    return {field_of(1, o.faces(0)), field_of(2, o.faces(1)), field_of(3, o.faces(2))};
  }
  void write(const std::filesystem::path& path) const
  {
    CheckpointWriter out(MPI_COMM_WORLD, path, 1 << 16);
    out.value("clock/t", 0.1);
    out.value("clock/steps", 12);
    out.value("case", std::string("time.end = 2\n"));
    out.value("nothing", std::vector<double>{});
    out.value("coupling/columns", std::vector<std::int64_t>{3, 1});
    out.cells("flow/p", field_of(0, ranks.owned()));
    out.faces("flow/U", faces());
    out.pieces("flow/mine", std::vector<std::int64_t>(rank, rank));  // none on the first rank
    out.commit();
  }
  void spoil(const std::filesystem::path& path, std::int64_t at) const
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0) {
      std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekg(at);
      const char byte = static_cast<char>(stream.get() ^ 0x10);
      stream.seekp(at);
      stream.put(byte);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  void shorten(const std::filesystem::path& path, std::uintmax_t bytes) const
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0)
      std::filesystem::resize_file(path, bytes);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  [[nodiscard]] std::string trouble(const std::filesystem::path& path) const
  {
    return broken_seal(MPI_COMM_WORLD, path, checkpoint_format);
  }

  int rank = 0;
  Decomposition ranks{MPI_COMM_WORLD, cells, {false, false, false}};
  ScratchFolder scratch{MPI_COMM_WORLD};
  std::filesystem::path file = scratch.path() / checkpoint_name(12);
};

TEST_F(Checkpoints, AreReadAsTheyWereWritten)
{
  write(file);
  EXPECT_EQ(trouble(file), "");
  const CheckpointReader in(MPI_COMM_WORLD, file);
  double t = 0;
  int steps = 0;
  std::string text;
  std::vector<double> nothing(3);
  std::vector<std::int64_t> columns, pieces;
  in.value("clock/t", t);
  in.value("clock/steps", steps);
  in.value("case", text);
  in.value("nothing", nothing);
  in.value("coupling/columns", columns);
  in.pieces("flow/mine", pieces);
  EXPECT_EQ(t, 0.1);
  EXPECT_EQ(steps, 12);
  EXPECT_EQ(text, "time.end = 2\n");
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(columns, (std::vector<std::int64_t>{3, 1}));
  std::vector<std::int64_t> of_all;
  for (int r = 0; r < ranks.size(); ++r)
    of_all.insert(of_all.end(), r, r);
  EXPECT_EQ(pieces, of_all);
}

TEST_F(Checkpoints, HoldCellsAndFacesOfTheWholeDomain)
{
  write(file);
  const CheckpointReader in(MPI_COMM_WORLD, file);
  Field<double> p(ranks.owned());
  Field3<double> U = make_field3<double>(ranks.owned());
  in.cells("flow/p", p);
  in.faces("flow/U", U);
  const auto expect_marks = [](const Field<double>& field, int component, const IndexBox& box) {
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        for (int i = box.lo[0]; i < box.hi[0]; ++i)
          ASSERT_EQ(field(i, j, k), mark(component, i, j, k)) << component << " at " << i << " " << j << " " << k;
  };
  expect_marks(p, 0, ranks.owned());
  for (int axis = 0; axis < 3; ++axis)
    expect_marks(U[axis], axis + 1, ranks.owned().faces(axis));
}

TEST_F(Checkpoints, ThatAreDamagedAnywhereAreTold)
{
  write(file);
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
  for (const std::int64_t at :
       {std::int64_t{3}, std::int64_t{40}, std::int64_t{511}, std::int64_t{600}, bytes / 2, bytes - 1}) {
    spoil(file, at);
    EXPECT_NE(trouble(file), "") << "byte " << at;
    spoil(file, at);
  }
  EXPECT_EQ(trouble(file), "");
  for (const std::int64_t length : {bytes - 1, bytes / 2, std::int64_t{512}, std::int64_t{100}, std::int64_t{0}}) {
    shorten(file, length);
    EXPECT_NE(trouble(file), "") << length << " bytes";
  }
}

TEST_F(Checkpoints, OfAnotherFormatAreNotRead)
{
  write(file);
  EXPECT_EQ(broken_seal(MPI_COMM_WORLD, file, checkpoint_format + 1),
            "it has format " + std::to_string(checkpoint_format) + ", and this version reads format " +
                std::to_string(checkpoint_format + 1));
}

TEST_F(Checkpoints, LackingWhatIsAskedForAreRefusedOnEveryRank)
{
  write(file);
  const CheckpointReader in(MPI_COMM_WORLD, file);
  double x = 0;
  Field<double> p(ranks.owned());
  EXPECT_THROW(in.value("clock/dt", x), InputError);
  EXPECT_THROW(in.value("coupling/columns", x), InputError);
  EXPECT_THROW(in.cells("flow/U_x", p), InputError);
}

TEST_F(Checkpoints, ThatDoNotFitOnTheDiskLeaveTheEarlierOneAndNoTrace)
{
  write(file);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1 << 15, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write(file), RunError);
  setrlimit(RLIMIT_FSIZE, &before);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(trouble(file), "");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
}

TEST_F(Checkpoints, ThatAreNotCommittedLeaveTheEarlierOneAndNoTrace)
{
  write(file);
  {
    CheckpointWriter out(MPI_COMM_WORLD, file, 1 << 16);
    out.value("clock/t", 0.2);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(trouble(file), "");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
}

TEST_F(Checkpoints, TheNewestWholeOneIsFoundAndDamagedOnesAreNamed)
{
  for (const long step : {3, 20, 100})
    write(scratch.path() / checkpoint_name(step));
  spoil(scratch.path() / checkpoint_name(100), 700);
  const FoundCheckpoint found = find_checkpoint(MPI_COMM_WORLD, scratch.path());
  EXPECT_EQ(found.file, scratch.path() / checkpoint_name(20));
  ASSERT_EQ(found.passed_over.size(), 1U);
  EXPECT_NE(found.passed_over.front().find("checkpoint-00000100.h5 is not used: its checksum is wrong"),
            std::string::npos);
}

TEST_F(Checkpoints, AFolderWithoutAnyIsRefused)
{
  EXPECT_THROW((void)find_checkpoint(MPI_COMM_WORLD, scratch.path()), InputError);
  EXPECT_THROW((void)find_checkpoint(MPI_COMM_WORLD, scratch.path() / "nowhere"), InputError);
}

TEST_F(Checkpoints, TheLastTwoAreKept)
{
  const RunFolder folder = RunFolder::at(MPI_COMM_WORLD, scratch.path() / "run");
  for (const long step : {3, 20, 100}) {
    write(folder.file(checkpoint_name(step)));
    keep_last_two(folder, step);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(std::filesystem::exists(folder.file(checkpoint_name(3))));
  EXPECT_TRUE(std::filesystem::exists(folder.file(checkpoint_name(20))));
  EXPECT_TRUE(std::filesystem::exists(folder.file(checkpoint_name(100))));
}

}  // namespace
}  // namespace luff::output::test
