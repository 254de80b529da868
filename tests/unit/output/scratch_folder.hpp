// SPDX-License-Identifier: BSD-3-Clause
// A folder of a test's own that vanishes with it, and what lies in files.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

namespace luff::output::test {

/// The same path on every rank; made and removed by the first.
class ScratchFolder {
 public:
  explicit ScratchFolder(MPI_Comm comm = MPI_COMM_SELF) : comm_(comm)
  {
    MPI_Comm_rank(comm, &rank_);
    long id = getpid();
    MPI_Bcast(&id, 1, MPI_LONG, 0, comm);
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("luff-") + test->test_suite_name() + "-" + test->name() + "-" + std::to_string(id));
    if (rank_ == 0)
      std::filesystem::create_directories(path_);
    MPI_Barrier(comm);
  }
  ~ScratchFolder()
  {
    MPI_Barrier(comm_);
    std::error_code ignored;
    if (rank_ == 0)
      std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  MPI_Comm comm_;
  int rank_ = 0;
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace luff::output::test
