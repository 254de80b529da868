// SPDX-License-Identifier: BSD-3-Clause
// Where the nodes of a curvilinear grid come from.
#pragma once

#include <functional>
#include <vector>

#include "core/vec3.hpp"
#include "parallel/for_each.hpp"
#include "parallel/index_box.hpp"

namespace luff::grid {

/// Coordinates [L] of the nodes of a box, i fastest; node (i, j, k), 0 <= i <= cells[0], is the low corner of cell
/// (i, j, k).
using NodeSource = std::function<std::vector<Vec3>(const IndexBox& nodes)>;

/// A curvilinear grid before it is shared among ranks: each asks for the nodes that it needs.
struct CurvilinearNodes {
  Index3 cells{};
  NodeSource source;
};

/// The nodes for which node(i, j, k) gives the place.
template <class Node>
NodeSource node_source(Node node)
{
  return [node = std::move(node)](const IndexBox& box) {
    std::vector<Vec3> nodes;
    nodes.reserve(box.volume());
    for_each_cell_in_order(box, [&](int i, int j, int k) { nodes.push_back(node(i, j, k)); });
    return nodes;
  };
}

}  // namespace luff::grid
