// SPDX-License-Identifier: BSD-3-Clause
#include "core/readable.hpp"

#include <fstream>

#include "core/error.hpp"

namespace luff {

void require_readable(const std::filesystem::path& file)
{
  if (!std::filesystem::exists(file))
    fail_input("{}: there is no such file; paths are relative to the case file", file.string());
  if (!std::filesystem::is_regular_file(file))
    fail_input("{}: is not a file", file.string());
  if (!std::ifstream(file).good())
    fail_input("{}: may not be read; check its permissions", file.string());
  if (std::filesystem::file_size(file) == 0)
    fail_input("{}: is empty", file.string());
}

}  // namespace luff
