// SPDX-License-Identifier: BSD-3-Clause
// What a run says: on the console and in log.txt.
#pragma once

#include <memory>

#include <spdlog/logger.h>

#include "output/run_folder.hpp"

namespace luff::output {

/// Speaks on standard output and in log.txt, line by line; silent on all ranks but the first.
/// Adds to a log.txt that is there already.  Throws RunError if log.txt cannot be written.
std::shared_ptr<spdlog::logger> make_log(const RunFolder& folder);

}  // namespace luff::output
