// SPDX-License-Identifier: BSD-3-Clause
// From the options of a mesh to its triangles.
#pragma once

#include "config/options.hpp"
#include "surface/mesh.hpp"

namespace luff::simulation {

/// The mesh as made or read, before it is put in its place. \throws InputError as the generators and readers do.
[[nodiscard]] surface::TriangleMesh build_unplaced(const config::MeshOptions& mesh);

}  // namespace luff::simulation
