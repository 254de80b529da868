// SPDX-License-Identifier: BSD-3-Clause
// What the dimensions of a grid file must be.
#pragma once

#include <string>

#include "core/error.hpp"
#include "parallel/index_box.hpp"

namespace luff::grid {

/// Throws InputError unless there is one block.
inline void require_one_block(int blocks, const std::string& file)
{
  if (blocks != 1)
    fail_input("{}: holds {} blocks; a grid is read from a file with one block: split the file", file, blocks);
}

/// Throws InputError unless there are cells along all three directions.
inline void require_cells(const Index3& nodes, const std::string& file)
{
  if (nodes[0] < 2 || nodes[1] < 2 || nodes[2] < 2)
    fail_input("{}: holds {} x {} x {} nodes; a grid has two at least along each direction", file, nodes[0], nodes[1],
               nodes[2]);
}

}  // namespace luff::grid
