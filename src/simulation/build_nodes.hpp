// SPDX-License-Identifier: BSD-3-Clause
// From the options of a grid to its nodes.
#pragma once

#include <array>
#include <vector>

#include "config/options.hpp"
#include "grid/node_source.hpp"

namespace luff::simulation {

/// Face coordinates of a box.  Throws InputError.
[[nodiscard]] std::array<std::vector<double>, 3> build_coordinates(const config::GridOptions& options);

/// Nodes of a grid of any other kind.  Throws InputError, at once or when nodes are asked for, where one of them is no
/// number.
[[nodiscard]] grid::CurvilinearNodes build_nodes(const config::GridOptions& options);

/// Cells along the three directions of a grid of any kind.
[[nodiscard]] Index3 cells_of(const config::GridOptions& options);

}  // namespace luff::simulation
