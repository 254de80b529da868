// SPDX-License-Identifier: BSD-3-Clause
#include "grid/finite_nodes.hpp"

#include "core/error.hpp"

namespace luff::grid {

NodeSource finite_nodes(NodeSource source, std::string origin)
{
  return [source = std::move(source), origin = std::move(origin)](const IndexBox& box) {
    std::vector<Vec3> nodes = source(box);
    std::size_t n = 0;
    for_each_cell_in_order(box, [&](int i, int j, int k) {
      const Vec3& x = nodes[n++];
      if (!x.allFinite())
        fail_input("{}: node ({}, {}, {}) is at ({}, {}, {}); it must be at a place", origin, i, j, k, x[0], x[1],
                   x[2]);
    });
    return nodes;
  };
}

}  // namespace luff::grid
