// SPDX-License-Identifier: BSD-3-Clause
// What analyses of shells that do not march in time share.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>
#include <spdlog/logger.h>

#include "config/case.hpp"
#include "output/run_folder.hpp"
#include "output/snapshot.hpp"
#include "shell/statics.hpp"

namespace luff::simulation {

/// Loads grow in proportion from nothing to what they are at this time.
inline constexpr double end_of_loading = 1.0;

/// Thrown where the user asks the run to end.
struct Stopped {};

[[nodiscard]] shell::StaticOptions static_options(const config::StructureOptions& structure);
/// A surface with positions x (3n) and its displacement from the reference.
[[nodiscard]] output::SurfaceSnapshot displaced(const surface::TriangleMesh& reference, const Eigen::VectorXd& x);
/// Runs `analyse`, which fills the summary, and writes the summary however it ends; the log names the tables.
void summarise(const output::RunFolder& folder, spdlog::logger& log, nlohmann::ordered_json& summary,
               const std::string& tables, const std::function<void()>& analyse);

}  // namespace luff::simulation
