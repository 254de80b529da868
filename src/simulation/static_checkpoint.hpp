// SPDX-License-Identifier: BSD-3-Clause
// Saves a run under slowly growing loads so that it can go on with the same bits, and goes on.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "output/earlier_output.hpp"
#include "shell/statics.hpp"
#include "simulation/build.hpp"
#include "simulation/checkpoint_parts.hpp"

namespace luff::simulation {

/// Over all equilibria: what a run with contact says at its end.
struct ContactTally {
  int most_pairs = 0;
  int crossings = 0;
  double smallest_gap = std::numeric_limits<double>::infinity();
};

/// Where such a run stands and what it counted.
struct StaticRecord {
  std::int64_t steps = 0;       ///< equilibria of all shells
  std::int64_t shell = 0;       ///< on its way; those before it are loaded
  shell::PathPoint point = {};  ///< its last equilibrium; step 0: none yet
  std::int64_t sharp_folds = 0;
  ContactTally contact = {};
  std::string summary = {};  ///< JSON
  output::EarlierOutput output = {};
};

/// Writes it into the run's folder and keeps the last two such files. Collective.
/// Throws RunError on every rank if it cannot be written; then the earlier ones are still there.
void write_checkpoint(const output::RunFolder& folder, const config::Case& options,
                      const std::vector<LoadedShell>& shells, const StaticRecord& record);

struct StaticResumption : GoingOn {
  StaticRecord record = {};
};

/// Reads the newest whole checkpoint. Collective. Throws InputError on every rank, with nothing written, when there is
/// none, or when the case or a mesh has changed in what may not.
[[nodiscard]] StaticResumption resume_static(MPI_Comm comm, const RestartRequest& request, const config::Case& options,
                                             const std::vector<LoadedShell>& shells);

}  // namespace luff::simulation
