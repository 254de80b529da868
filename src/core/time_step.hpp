// SPDX-License-Identifier: BSD-3-Clause
// One step of the clock.
#pragma once

namespace luff {

/// From t_old to t_new; passed down as a value, so that nobody reads a global time.
struct TimeStep {
  double t_old = 0.0;
  double t_new = 0.0;
  double dt = 0.0;
  int index = 0;  ///< 1 for the first step
};

}  // namespace luff
