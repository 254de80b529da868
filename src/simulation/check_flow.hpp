// SPDX-License-Identifier: BSD-3-Clause
// What can be wrong with a flow besides what its case file says key by key.
#pragma once

#include "config/options.hpp"
#include "grid/grid.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Whether edges of sheets and of closed bodies may lie on a side.
[[nodiscard]] bool sheets_may_end_on(config::SideType type);

/// Refuses sheets that leave a box or touch sides of it other than symmetry, slip and periodic ones.
/// Throws InputError.
void check_sheets_inside(const config::Case& options, const Structure& structure);

/// The same in a curvilinear grid, and closed bodies whose edges don't lie on such sides.  Collective; throws
/// InputError on every rank.
void check_sheets_inside(const grid::Grid& grid, const config::Case& options, const Structure& structure);

/// Refuses velocities that are no numbers, at t = 0 in the cells and on the sides, and sides that bring in more than
/// they let out at the start or later.  Takes a sweep over the cells.  Collective; throws InputError on every rank.
void check_flow(const grid::Grid& grid, const config::Case& options);

}  // namespace luff::simulation
