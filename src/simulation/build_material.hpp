// SPDX-License-Identifier: BSD-3-Clause
// What shells are made of, and where their fibres run.
#pragma once

#include <vector>

#include "config/options.hpp"
#include "shell/material/material.hpp"
#include "surface/marked_mesh.hpp"

namespace luff::simulation {

[[nodiscard]] shell::Material build_material(const config::MaterialOptions& options);

/// A direction at each triangle of the placed mesh; empty if the case gives none.
/// \throws InputError where one is normal to its triangle, or the mesh file has no such field.
[[nodiscard]] std::vector<Vec3> build_fibres(const config::ShellOptions& options, const surface::MarkedMesh& marked);

}  // namespace luff::simulation
