// SPDX-License-Identifier: BSD-3-Clause
// The TOML tree of a case file with what the command line changed in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "config/issues.hpp"

namespace luff::config {

class Document {
 public:
  /// \throws InputError if the file cannot be read or is not TOML.
  explicit Document(const std::filesystem::path& file);

  /// Apply "key.path=value": the value in TOML (quotes may be left out around a word); an entry of an array of tables
  /// is named by its index from 0 or by its `name`. \throws InputError naming the assignment.
  void set(const std::string& assignment);

  const toml::table& root() const { return root_; }
  /// Folder that relative paths in the file start from; absolute.
  const std::filesystem::path& folder() const { return folder_; }
  Place place() const { return {file_, 0}; }

 private:
  std::string file_;
  std::filesystem::path folder_;
  toml::table root_;
};

/// Where a value was written.
Place place_of(const toml::node& node);

/// Where a key of a table was written; the table's place if it has no such key.
Place place_of(const toml::table& table, std::string_view key);

/// The value as TOML on one line, shortened if long.
std::string shown(const toml::node& node);

}  // namespace luff::config
