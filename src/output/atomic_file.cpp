// SPDX-License-Identifier: BSD-3-Clause
// Write beside, then rename.
#include "output/atomic_file.hpp"

#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace luff::output {

void write_atomically(const std::filesystem::path& file, std::string_view text)
{
  std::filesystem::path beside = file;
  beside += ".tmp";
  std::ofstream out(beside, std::ios::binary);
  out << text << std::flush;
  const bool good = out.good();
  out.close();
  std::error_code error;
  if (good)
    std::filesystem::rename(beside, file, error);
  if (!good || error)
    fail_run("{}: cannot be written; is the disk full, or the folder gone?", file.string());
}

}  // namespace luff::output
