// SPDX-License-Identifier: BSD-3-Clause
// The domain's walls as a surface with what the fluid exerts on it.
#pragma once

#include "fluid/flow_solver.hpp"
#include "output/snapshot.hpp"
#include "simulation/shear_history.hpp"

namespace luff::simulation {

/// All faces of sides of type wall, side by side, with `shear_stress` (the tangential force on the wall per area),
/// `pressure` and `side` (0 ... 5: low and high end of the first axis, the second, the third) by face, with a history
/// also `tawss` and `osi`; complete on the first rank of `comm`, empty on the others.  Halos filled by fill_halos().
/// Collective over `comm`, whose ranks share the flow.
[[nodiscard]] output::SurfaceSnapshot wall_snapshot(const fluid::FlowSolver& flow, MPI_Comm comm,
                                                    const ShearHistory* history = nullptr);

/// `shear_stress` of this rank's faces of walls, always in the same order.  Halos filled by fill_halos().
[[nodiscard]] std::vector<Vec3> wall_shear(const fluid::FlowSolver& flow);
/// The faces' numbers in the whole grid, in the same order.
[[nodiscard]] std::vector<std::int64_t> wall_faces(const fluid::FlowSolver& flow);

}  // namespace luff::simulation
