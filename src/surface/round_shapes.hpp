// SPDX-License-Identifier: BSD-3-Clause
// Disks, annuli, cylinders and zones of spheres.
#pragma once

#include "surface/generators.hpp"

namespace luff::surface {

/// As make() has them.
MarkedMesh made(const Disk& shape);
MarkedMesh made(const Annulus& shape);
MarkedMesh made(const Cylinder& shape);
MarkedMesh made(const SphereCap& shape);

}  // namespace luff::surface
