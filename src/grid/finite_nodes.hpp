// SPDX-License-Identifier: BSD-3-Clause
// Nodes that are numbers.
#pragma once

#include <string>

#include "grid/node_source.hpp"

namespace luff::grid {

/// The nodes of a source, which throws InputError, led by `origin`, when one of them is no number.
[[nodiscard]] NodeSource finite_nodes(NodeSource source, std::string origin);

}  // namespace luff::grid
