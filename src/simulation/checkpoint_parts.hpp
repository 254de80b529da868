// SPDX-License-Identifier: BSD-3-Clause
// What the checkpoints of all kinds of runs share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "output/checkpoint_file.hpp"
#include "output/checkpoint_folder.hpp"
#include "output/run_folder.hpp"
#include "surface/mesh.hpp"

namespace luff::simulation {

/// What was asked for on the command line.
struct RestartRequest {
  std::filesystem::path from;  ///< a run's folder or a checkpoint
  std::filesystem::path case_file;
  config::Overrides overrides;
};

/// Where a run goes on from.
struct GoingOn {
  std::filesystem::path folder;               ///< of the run that goes on
  std::vector<std::string> changed = {};      ///< keys that have another value now
  std::vector<std::string> passed_over = {};  ///< checkpoints that were damaged, and why
};

/// What a run goes on with must be what it began with: the vertices of all surfaces at the start, and the grid.
struct Shape {
  std::string what;
  std::string name;  ///< in the file
  std::vector<double> numbers;
};

[[nodiscard]] Shape shape_of_mesh(const std::string& name, const surface::TriangleMesh& mesh);
/// Throws InputError naming what differs by more than round-off, which another compiler may cause. Collective.
void require_same_shapes(const output::CheckpointReader& file, const std::vector<Shape>& shapes);

/// Writes what `put` puts into a file, and keeps it and the one before. Collective. Throws RunError on every rank if it
/// cannot be written; then the earlier ones are still there.
template <class Put>
void write_checkpoint_file(const output::RunFolder& folder, long steps, const Put& put)
{
  output::CheckpointSize size;
  put(size);
  output::CheckpointWriter file(folder.comm(), folder.file(output::checkpoint_name(steps)), size.bytes());
  put(file);
  file.commit();
  output::keep_last_two(folder, steps);
}

}  // namespace luff::simulation
