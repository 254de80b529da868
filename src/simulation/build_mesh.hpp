// SPDX-License-Identifier: BSD-3-Clause
// From the options of a mesh to its triangles.
#pragma once

#include <string>

#include "config/options.hpp"
#include "surface/marked_mesh.hpp"

namespace luff::simulation {

/// The mesh, made or read, and put in its place; sets and directions go with it. \throws InputError as the generators
/// and readers do, led by the place in the case file.
[[nodiscard]] surface::MarkedMesh build_mesh(const config::MeshOptions& mesh, const config::PlacementOptions& placement,
                                             const std::string& owner);

}  // namespace luff::simulation
