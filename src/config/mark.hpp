// SPDX-License-Identifier: BSD-3-Clause
// Where a table of a case was written.
#pragma once

#include <string>

namespace luff::config {

/// "case.toml:22", for messages about what a table describes; empty if it was not read. It is not part of what the
/// case says, so any two are equal.
struct Mark {
  std::string text;

  bool operator==(const Mark&) const { return true; }
};

}  // namespace luff::config
