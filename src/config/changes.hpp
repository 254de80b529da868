// SPDX-License-Identifier: BSD-3-Clause
// What may change in a case when a run goes on from a checkpoint.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/case.hpp"

namespace luff::config {

/// Every key of a case with its value, a line each: what a checkpoint remembers of it.
[[nodiscard]] std::string list_keys(const Case& options);

/// Compares a case, read from `file`, with the list that an earlier one left. What may be another one now, such as the
/// end and what is written, is returned, a sentence each. \throws InputError naming file, line, key, both values and
/// what may change, if anything else did.
[[nodiscard]] std::vector<std::string> accept_changes(const std::string& earlier_list, const Case& options,
                                                      const std::filesystem::path& file, const Overrides& overrides);

}  // namespace luff::config
