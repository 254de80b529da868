// SPDX-License-Identifier: BSD-3-Clause
// The known name that a misspelt one probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luff {

/// The known name with the least edit distance (insertions, deletions, substitutions, swaps of neighbours), unless even
/// that one differs in more than a third of its letters (but two at least may differ in a name of four or more).
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& known);

/// " (did you mean 'step'?)", or what is known if nothing is near: " (known: end, step)".
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

/// "a, b, c"
std::string joined(const std::vector<std::string>& names);

}  // namespace luff
