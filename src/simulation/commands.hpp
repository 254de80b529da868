// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program.
#pragma once

#include <filesystem>
#include <functional>

#include <mpi.h>

#include "config/case.hpp"

namespace luff::simulation {

/// How many threads a rank may start; none given: leave what OpenMP was told.
struct Threads {
  int at_most = 0;
};

/// What `run` takes from the command line besides the case.
struct RunOptions {
  std::filesystem::path out;      ///< empty: runs/<case>/<nnn>, or the folder of the run that goes on
  std::filesystem::path restart;  ///< a run's folder or a checkpoint to go on from; empty: from the start
  Threads threads;
  std::function<bool()> interrupted = [] { return false; };  ///< whether this rank was asked to end
  /// Makes pictures of a run folder; returns 0 when it could.  Called when the case asks for plots.
  std::function<int(const std::filesystem::path&)> make_pictures;
};

/// Runs a case and writes its folder.  Collective.  Throws InputError before anything is written, RunError when the run
/// fails after writing the summary.
void run_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
              const RunOptions& options);
/// Validates a case and prints what was understood.  Collective.
void check_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides);
/// Writes the grid and the surfaces of a case into a new folder, without running it.  Collective.
void write_meshes(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
                  const std::filesystem::path& out);

}  // namespace luff::simulation
