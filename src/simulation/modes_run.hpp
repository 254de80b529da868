// SPDX-License-Identifier: BSD-3-Clause
// Natural frequencies and modes of the shells of a case.
#pragma once

#include <memory>
#include <vector>

#include <spdlog/logger.h>

#include "config/case.hpp"
#include "output/run_folder.hpp"
#include "simulation/build.hpp"

namespace luff::simulation {

/// Throws InputError where a shell's mesh, supports or loads are wrong, or it has fewer unknowns than modes are asked.
[[nodiscard]] std::vector<LoadedShell> build_modes(const config::Case& options);

/// Writes frequencies-<name>.csv, shell-<name>.pvd with one data set per mode, and summary.json.  About the reference
/// configuration, or with structure.preload about the equilibrium under the loads.  Collective.
/// Throws RunError where there is no equilibrium or modes don't converge; the summary then says so.
void run_modes(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log, const config::Case& options,
               const std::vector<LoadedShell>& shells);

}  // namespace luff::simulation
