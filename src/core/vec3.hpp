// SPDX-License-Identifier: BSD-3-Clause
// Points and vectors of physical space.
#pragma once

#include <Eigen/Core>

namespace luff {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace luff
