// SPDX-License-Identifier: BSD-3-Clause
// Saves a run so that it can go on with the same bits, and goes on.
#pragma once

#include "config/case.hpp"
#include "output/run_folder.hpp"
#include "simulation/checkpoint_parts.hpp"
#include "simulation/simulation.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// Writes the accepted state into the run's folder and keeps the last two such files.  Collective.
/// Throws RunError on every rank if it cannot be written; then the earlier ones are still there.
void write_checkpoint(const output::RunFolder& folder, const config::Case& options, Simulation& simulation,
                      const Record& record);

/// A simulation that stands where a checkpoint was written.
struct Resumption : GoingOn {
  Record record = {};
};

/// Sets a simulation just built from the case to the newest whole checkpoint.  Collective.  Throws InputError on every
/// rank, with nothing written, when there is none, when the case has changed in what may not, or when it is at its end.
[[nodiscard]] Resumption resume(MPI_Comm comm, const RestartRequest& request, const config::Case& options,
                                Simulation& simulation);

}  // namespace luff::simulation
