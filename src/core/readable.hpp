// SPDX-License-Identifier: BSD-3-Clause
// What must be true of an input file of any kind.
#pragma once

#include <filesystem>

namespace luff {

/// Throws InputError, naming the file, unless it is there, a file, may be read and is not empty.
void require_readable(const std::filesystem::path& file);

}  // namespace luff
