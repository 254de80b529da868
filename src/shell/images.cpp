// SPDX-License-Identifier: BSD-3-Clause
// Images of vertices in the mirrors at clamped and symmetry edges.
#include "shell/images.hpp"

namespace luff::shell {

Image reflection(const Vec3& normal, const Vec3& on_plane)
{
  return {Mat3::Identity() - 2 * normal * normal.transpose(), 2 * normal * normal.dot(on_plane)};
}

Image compose(const Image& outer, const Image& inner)
{
  Image both{outer.T * inner.T, outer.T * inner.t + outer.t, outer.mirrors};
  both.mirrors.insert(both.mirrors.end(), inner.mirrors.begin(), inner.mirrors.end());
  return both;
}

}  // namespace luff::shell
