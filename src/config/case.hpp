// SPDX-License-Identifier: BSD-3-Clause
// Read, write and explain case files: the interface of this folder.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "config/options.hpp"

namespace luff::config {

/// What the command line changes in a case file.
struct Overrides {
  std::vector<std::string> sets =
      {};                   ///< "time.end=2", "shell.0.thickness=0.02", "shell.flag.density=3", "title='Slow'"
  double resolution = 1.0;  ///< multiplies cell and division counts, divides spacings and the step
};

/// Read a TOML case file, check all of it, and fill in the defaults. Paths in it are relative to its folder and
/// absolute in the result. \throws InputError with one line for each thing that is wrong, with file, line, key and
/// value.
Case load_case(const std::filesystem::path& file, const Overrides& overrides = {});

/// Write a case file with every default in it; reading it gives the same options again.
void write_case(const Case& options, std::ostream& out);

enum class Format { Text, Markdown };

/// Write the reference of all keys: meaning, unit, range, default.
void write_reference(std::ostream& out, Format format);

}  // namespace luff::config
