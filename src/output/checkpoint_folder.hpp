// SPDX-License-Identifier: BSD-3-Clause
// The checkpoints of a run: their names, which of them to keep, and the newest that can be trusted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/run_folder.hpp"

namespace luff::output {

/// checkpoint-00000120.h5
[[nodiscard]] std::string checkpoint_name(long step);

/// Removes all but the checkpoint of `newest_step` and the one before it, and what an interrupted write left behind.
void keep_last_two(const RunFolder& folder, long newest_step);
/// Removes the checkpoints of later steps: a run goes on from `step`.
void drop_checkpoints_after(const RunFolder& folder, long step);

/// A checkpoint to go on from.
struct FoundCheckpoint {
  std::filesystem::path file;
  std::vector<std::string> passed_over;  ///< newer ones that are damaged: which and why
};

/// The newest whole checkpoint of a run's folder, or the file itself if one is given.  Collective.
/// Throws InputError on every rank, with what is wrong with each, if there is none.
[[nodiscard]] FoundCheckpoint find_checkpoint(MPI_Comm comm, const std::filesystem::path& folder_or_file);

}  // namespace luff::output
