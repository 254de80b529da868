// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium paths on which the load factor is an unknown: through limit points and snap-back.
#pragma once

#include <vector>

#include "shell/statics.hpp"

namespace luff::shell {

struct ArcLengthOptions {
  StaticOptions statics;  ///< the first step is as long as that of the first of `steps` load steps
  int max_steps = 1000;   ///< the analysis fails when so many don't reach load factor 1
};

/// Cylindrical arc-length method [crisfield_1981_fast]: every step has a given root mean square displacement (by
/// reference area), which adapts to the iterations it takes. Ends at load factor 1 exactly, where the path first gets
/// there. Negative pivots in the reports tell unstable equilibria. Needs the direct solver.
/// \throws InputError as solve_static does.
/// \throws RunError naming the step and load factor where no step, however short, finds an equilibrium, the shell
/// folds, or load factor 1 is not reached.
StaticStep follow_arc_length(const Shell& shell, const std::vector<Load>& loads, const ArcLengthOptions& options = {},
                             const OnStaticStep& on_step = {});

/// The mean over vertices of one component of the displacement.
struct ControlledDisplacement {
  std::vector<int> vertices;
  int component = 2;  ///< 0, 1, 2 for x, y, z
  double end = 0;     ///< value at the last step [L], of either sign, not zero
};

/// \throws InputError for no vertex, one that is not there or held in this component, a component out of range, end =
/// 0.
void check_controllable(const Shell& shell, const ControlledDisplacement& controlled);

/// Steps of equal size in the controlled displacement; the load factor follows from it and may fall or change sign.
/// \throws InputError as solve_static and check_controllable do.
/// \throws RunError naming the step where there is no equilibrium (the path snaps back in this displacement) or the
/// shell folds.
StaticStep control_displacement(const Shell& shell, const std::vector<Load>& loads,
                                const ControlledDisplacement& controlled, const StaticOptions& options = {},
                                const OnStaticStep& on_step = {});

}  // namespace luff::shell
