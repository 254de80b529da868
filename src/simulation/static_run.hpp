// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of the shells of a case under slowly growing loads.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <spdlog/logger.h>

#include "config/case.hpp"
#include "output/run_folder.hpp"
#include "simulation/build.hpp"
#include "simulation/static_checkpoint.hpp"

namespace luff::simulation {

/// Throws InputError where a shell's mesh, supports or loads are wrong or leave it free to move as a rigid body.
[[nodiscard]] std::vector<LoadedShell> build_static(const config::Case& options);

/// Loads every shell as structure.analysis says; writes steps-<shell>.csv, probe-<name>.csv against the load factor,
/// shell-<name>.pvd and summary.json.  Ends after the step in which a STOP file appears or `interrupted` is true.
/// Then, where it fails, and every output.checkpoint.every equilibria it leaves a checkpoint. Goes on from `resumption`
/// unless that is null. Collective. Throws RunError where there is no equilibrium; the summary then says so.
void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options, const std::vector<LoadedShell>& shells,
                const std::function<bool()>& interrupted, const StaticResumption* resumption);

}  // namespace luff::simulation
