// SPDX-License-Identifier: BSD-3-Clause
// The accepted flow as people look at it.
#pragma once

#include <span>
#include <vector>

#include "config/options.hpp"
#include "fluid/flow_solver.hpp"
#include "grid/locate.hpp"
#include "output/snapshot.hpp"

namespace luff::simulation {

/// Velocity, pressure (physical), vorticity and Q = (|Omega|^2 - |S|^2)/2 in the owned cells; gradients by central
/// differences along index directions.  With closed `bodies` also `fluid`, 0 in the cells inside them, 1 elsewhere and
/// before the first step.  Halos must be filled.
[[nodiscard]] output::FlowSnapshot flow_snapshot(const fluid::FlowSolver& flow, std::span<const config::FlowField> what,
                                                 bool bodies = false);

/// Velocity and physical pressure at places of the grid (grid::locate), trilinear between cell centres.  Collective.
struct PointSample {
  Vec3 velocity = Vec3::Zero();
  double pressure = 0.0;
};
[[nodiscard]] std::vector<PointSample> sample(const fluid::FlowSolver& flow, std::span<const grid::Location> places);

}  // namespace luff::simulation
