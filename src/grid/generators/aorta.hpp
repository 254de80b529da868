// SPDX-License-Identifier: BSD-3-Clause
// A human aorta with its root, from measured sizes.
#pragma once

#include <vector>

#include "grid/generators/centreline.hpp"
#include "grid/node_source.hpp"

namespace luff::grid {

/// Arc length along the centreline, from the outflow tract of the ventricle through the plane of the annulus (s = 0) to
/// the descending aorta, in units of the annulus's radius R; a human's is near 12.7 mm.
inline constexpr double aorta_inlet = -20.0 / 12.7;
[[nodiscard]] double aorta_outlet();

/// The root with its three sinuses, which begin on the crown where the valve's leaflets are attached (lobes at angles
/// 0, 120 and 240 degrees from e1), the ascending aorta, the arch (half a turn, out of plane by 12 degrees at both
/// ends) and the descending aorta.  The annulus lies in z = 0 about the origin, the flow comes along +z, e1 is x.
///
/// `stations`: arc length of the rings of nodes over R, from aorta_inlet to aorta_outlet(); `radius`: R [L].
/// Curvature, radii and sinuses are smooth (twice differentiable) functions of s.
[[nodiscard]] CurvilinearNodes make_aorta(const std::vector<double>& stations, int across, double radius);

}  // namespace luff::grid
