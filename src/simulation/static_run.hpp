// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of the shells of a case under slowly growing loads.
#pragma once

#include <memory>

#include <spdlog/logger.h>

#include "config/case.hpp"
#include "output/run_folder.hpp"

namespace luff::simulation {

/// Loads every shell in structure.steps equal steps; writes probe-<name>.csv against the load factor, shell-<name>.pvd
/// and summary.json.  Throws RunError where there is no equilibrium.
void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options);

}  // namespace luff::simulation
