// SPDX-License-Identifier: BSD-3-Clause
// What can be wrong with the output that a case asks for, besides what its file says key by key.
#pragma once

#include "config/options.hpp"
#include "grid/grid.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Refuses probes and rakes outside the grid, and sections across surfaces that have no width along their axis.
/// Collective; throws InputError on every rank.
void check_output(const grid::Grid& grid, const config::OutputOptions& output, const Structure& structure);

}  // namespace luff::simulation
