// SPDX-License-Identifier: BSD-3-Clause
// The accepted flow at points, for surfaces through it.
#pragma once

#include <span>
#include <vector>

#include "config/options.hpp"
#include "fluid/flow_solver.hpp"
#include "output/cut_surface.hpp"

namespace luff::simulation {

/// Fields at the centres of this rank's cells and of the next ones above, so that the blocks of all ranks join, and
/// where the domain ends on its sides: there velocities are the mean with the halo, the others those of the cell
/// inside.  With closed `bodies` also `fluid`, 0 inside them.  Halos filled by fill_halos().  Collective.
[[nodiscard]] output::PointBlock flow_points(const fluid::FlowSolver& flow, std::span<const config::FlowField> what,
                                             bool bodies);

/// A field by point of such a block; of a vector its magnitude.
[[nodiscard]] std::vector<float> magnitudes(const output::NamedField& field);

}  // namespace luff::simulation
