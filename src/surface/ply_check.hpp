// SPDX-License-Identifier: BSD-3-Clause
// Does a PLY file hold all that its header promises?
#pragma once

#include <filesystem>

namespace luff::surface {

/// VTK 9.1 crashes on PLY files that end too early; look before it does.
/// \throws InputError naming the file when the header is not understood or the data end before the last element.
void check_ply_is_complete(const std::filesystem::path& file);

}  // namespace luff::surface
