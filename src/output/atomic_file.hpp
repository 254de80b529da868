// SPDX-License-Identifier: BSD-3-Clause
// Files that are always whole: what is read is the old text or the new one.
#pragma once

#include <filesystem>
#include <string_view>

namespace luff::output {

/// Writes the text to a file beside it and renames. Throws RunError if that fails.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace luff::output
