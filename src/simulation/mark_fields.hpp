// SPDX-License-Identifier: BSD-3-Clause
// The named sets and directions of a mesh as fields that ParaView shows and that can be read again.
#pragma once

#include "output/snapshot.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Adds a field for each set, 1 on its members and 0 elsewhere (of an edge: on its ends), and one for each field of
/// vectors.
void add_marks(const SheetRange& sheet, output::SurfaceSnapshot& snapshot);

}  // namespace luff::simulation
