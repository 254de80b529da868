// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a fuzzer as a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace luff::fuzz {

/// A file of this process that holds these bytes.
inline std::filesystem::path input_file(const std::string& name, const std::uint8_t* data, std::size_t size)
{
  static const std::filesystem::path folder = [] {
    std::string made = std::filesystem::temp_directory_path() / "luff-fuzz-XXXXXX";
    return std::filesystem::path(mkdtemp(made.data()));
  }();
  std::ofstream(folder / name, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<long>(size));
  return folder / name;
}

}  // namespace luff::fuzz
