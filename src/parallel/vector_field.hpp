// SPDX-License-Identifier: BSD-3-Clause
// A vector read from its three component fields.
#pragma once

#include "core/vec3.hpp"
#include "parallel/field.hpp"

namespace luff {

template <class T>
[[nodiscard]] Vec3 at(const View3<T>& u, const Index3& c)
{
  return {u[0](c), u[1](c), u[2](c)};
}

}  // namespace luff
