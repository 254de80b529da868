// SPDX-License-Identifier: BSD-3-Clause
// What the program understood: non-dimensional groups, resolution, cost.
#pragma once

#include <string>
#include <vector>

#include "config/case.hpp"
#include "grid/grid.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Lines "name = value" for a person: Re, mass ratio, bending stiffness, cells per length, CFL and diffusion numbers,
/// memory, and warnings.  Length: the longest side of the first sheet's bounding box; speed: the fastest prescribed or
/// initial velocity.
///
/// `grid`: null without a fluid.  Collective.
[[nodiscard]] std::vector<std::string> describe_groups(const config::Case& options, const Structure& structure,
                                                       const grid::Grid* grid);

}  // namespace luff::simulation
