// SPDX-License-Identifier: BSD-3-Clause
// summary.json: how a run ended, for programs.
#pragma once

#include <nlohmann/json.hpp>

#include "output/run_folder.hpp"

namespace luff::output {

/// Writes summary.json whole; numbers that are not finite become null. Throws RunError if it cannot be written.
void write_summary(const RunFolder& folder, const nlohmann::ordered_json& summary);

}  // namespace luff::output
