// SPDX-License-Identifier: BSD-3-Clause
// Makes the folder of a run on the first rank and tells the others.
#include "output/run_folder.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/error.hpp"
#include "parallel/broadcast.hpp"

namespace luff::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* remedy = "choose another place with --out DIR";

int rank_of(MPI_Comm comm)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// Runs `make` on the first rank; its result, or its InputError, reaches every rank.
fs::path make_on_first_rank(MPI_Comm comm, const std::function<fs::path()>& make)
{
  std::string path;
  std::string error;
  if (rank_of(comm) == 0)
    try {
      path = make().string();
    } catch (const InputError& e) {
      error = e.what();
    }
  error = broadcast(comm, error);
  path = broadcast(comm, path);
  if (!error.empty())
    throw InputError(error);
  return path;
}

void make_folders(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    fail_input("output folder {}: cannot be made ({}); {}", folder.string(), error.message(), remedy);
}

void try_to_write(const fs::path& folder)
{
  const fs::path trial = folder / ".luff-writes-here";
  std::ofstream file(trial);
  file << "trial" << std::flush;
  const bool good = file.good();
  file.close();
  std::error_code ignored;
  fs::remove(trial, ignored);
  if (!good)
    fail_input("output folder {}: cannot be written; {}", folder.string(), remedy);
}

int number_of(const fs::path& folder)
{
  const std::string name = folder.filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : 0;
}

int highest_number(const fs::path& folder)
{
  int highest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    highest = std::max(highest, number_of(entry->path()));
  if (error)
    fail_input("output folder {}: cannot be read ({}); {}", folder.string(), error.message(), remedy);
  return highest;
}

fs::path make_numbered(const fs::path& runs_of_case)
{
  make_folders(runs_of_case);
  for (int number = highest_number(runs_of_case) + 1;; ++number) {
    fs::path folder = runs_of_case / fmt::format("{:03}", number);
    std::error_code error;
    if (fs::create_directory(folder, error))  // false when another run was faster
      return folder;
    if (error)
      fail_input("output folder {}: cannot be made ({}); {}", folder.string(), error.message(), remedy);
  }
}

fs::path make_at(const fs::path& folder)
{
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    fail_input("output folder {}: is a file; {}", folder.string(), remedy);
  make_folders(folder);
  const bool empty = fs::is_empty(folder, error);
  if (error)
    fail_input("output folder {}: cannot be read ({}); {}", folder.string(), error.message(), remedy);
  if (!empty)
    fail_input("output folder {}: is not empty, and a run never writes over an older one; {}", folder.string(), remedy);
  try_to_write(folder);
  return folder;
}

}  // namespace

/// A folder that a process has to itself until it ends, however it ends.
struct RunFolder::Lock {
  explicit Lock(const fs::path& folder) : number(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  ~Lock()
  {
    if (number >= 0)
      close(number);
  }
  /// File systems that know no locks grant it.
  [[nodiscard]] bool taken_by_another() const { return flock(number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }
  int number;
};

RunFolder::RunFolder(MPI_Comm comm, fs::path path) : comm_(comm), rank_(rank_of(comm)), path_(std::move(path))
{
  std::string error;
  if (rank_ == 0) {
    lock_ = std::make_shared<Lock>(path_);
    if (lock_->taken_by_another())
      error = fmt::format("output folder {}: another run is writing there; wait until it ends, or {}", path_.string(),
                          remedy);
  }
  error = broadcast(comm, error);
  if (!error.empty())
    throw InputError(error);
}

RunFolder RunFolder::numbered(MPI_Comm comm, const fs::path& runs, const std::string& case_name)
{
  return {comm, make_on_first_rank(comm, [&] { return make_numbered(runs / case_name); })};
}

RunFolder RunFolder::at(MPI_Comm comm, const fs::path& folder)
{
  return {comm, make_on_first_rank(comm, [&] { return make_at(folder); })};
}

RunFolder RunFolder::again(MPI_Comm comm, const fs::path& folder)
{
  return {comm, make_on_first_rank(comm, [&] {
            try_to_write(folder);
            return folder;
          })};
}

void RunFolder::forget_stop() const
{
  std::error_code ignored;
  if (writes())
    fs::remove(file("STOP"), ignored);
}

bool RunFolder::stop_requested() const
{
  std::error_code ignored;
  int requested = writes() && fs::exists(file("STOP"), ignored) ? 1 : 0;
  MPI_Bcast(&requested, 1, MPI_INT, 0, comm_);
  return requested == 1;
}

}  // namespace luff::output
