// SPDX-License-Identifier: BSD-3-Clause
// Values of options in words (what is allowed) and in TOML.
#pragma once

#include <string>

#include "config/schema.hpp"

namespace luff::config {

/// What a key may hold, so that "must be " + allowed(...) is a sentence: "a number > 0", "\"strong\" or \"loose\"".
std::string allowed(const Value& value, const Spec& spec);

/// The value in TOML; reading it gives the same value again, bit for bit.
std::string to_toml(const Value& value);

/// "a", "b" or "c", in quotes.
std::string alternatives(const std::vector<std::string>& words);

/// A string in TOML's quotes and escapes.
std::string toml_string(const std::string& text);

}  // namespace luff::config
