// SPDX-License-Identifier: BSD-3-Clause
// The folder that holds everything one run writes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <mpi.h>

namespace luff::output {

/// A new folder, empty when made; every rank knows its path, the first rank writes.
///
/// Writers take a RunFolder and do nothing on the other ranks unless they say so.
class RunFolder {
 public:
  /// runs/<case_name>/<nnn>, one higher than the highest number there. Collective.
  /// Throws InputError on every rank if it cannot be made or written.
  static RunFolder numbered(MPI_Comm comm, const std::filesystem::path& runs, const std::string& case_name);

  /// The folder itself, which must not exist or be empty. Collective.
  /// Throws InputError on every rank if it holds something, is no folder, or cannot be made or written.
  static RunFolder at(MPI_Comm comm, const std::filesystem::path& folder);

  /// The folder of an earlier run, to go on in. Collective.
  /// Throws InputError on every rank if it cannot be written, or if a run is writing there.
  static RunFolder again(MPI_Comm comm, const std::filesystem::path& folder);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  MPI_Comm comm() const { return comm_; }
  bool writes() const { return rank_ == 0; }

  /// True when a file named STOP lies in the folder: the user asks the run to end. Collective.
  bool stop_requested() const;
  /// Takes an earlier request back.
  void forget_stop() const;

 private:
  struct Lock;
  RunFolder(MPI_Comm comm, std::filesystem::path path);

  MPI_Comm comm_;
  int rank_;
  std::filesystem::path path_;
  std::shared_ptr<Lock> lock_;  ///< of the rank that writes, for as long as any copy lives
};

}  // namespace luff::output
