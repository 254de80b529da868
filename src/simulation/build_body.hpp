// SPDX-License-Identifier: BSD-3-Clause
// From [[body]] to a rigid sheet or closed body.
#pragma once

#include "config/case.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

[[nodiscard]] shell::Motion build_motion(const config::VectorExpression& translation,
                                         const std::optional<config::RotationOptions>& rotation);

/// Finds out whether the mesh is closed: it has no edges, or, where the case says so, its edges lie on symmetry, slip
/// and periodic sides of the grid; then its normals are made to point outwards.  Throws InputError, which names edges
/// that leak.
[[nodiscard]] RigidSheet build_rigid(const config::BodyOptions& options, const config::Case& all);

}  // namespace luff::simulation
