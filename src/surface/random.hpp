// SPDX-License-Identifier: BSD-3-Clause
// Repeatable random numbers.
#pragma once

#include <random>

#include "core/vec3.hpp"

namespace luff::surface {

/// The same numbers with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// Uniform in [-1, 1).
  double symmetric() { return 2 * (static_cast<double>(engine_() >> 11) * 0x1p-53) - 1; }
  Vec3 vector()
  {
    const double x = symmetric(), y = symmetric(), z = symmetric();
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace luff::surface
