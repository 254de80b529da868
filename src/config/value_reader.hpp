// SPDX-License-Identifier: BSD-3-Clause
// One TOML value into one option.
#pragma once

#include <filesystem>
#include <string>

#include "config/document.hpp"
#include "config/schema.hpp"

namespace luff::config {

/// What is being read, for messages.
struct ValueContext {
  std::string path;  ///< "shell.thickness"
  Place place;
  std::filesystem::path folder;  ///< relative paths start here
  const Spec& spec;
  Issues& issues;
};

/// Set the option from the TOML value, or add an issue that says what would be allowed.
void read_value(const toml::node& node, const Value& value, const ValueContext& context);

}  // namespace luff::config
