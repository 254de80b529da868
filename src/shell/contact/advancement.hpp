// SPDX-License-Identifier: BSD-3-Clause
// How far two pieces of surface may move before they come too close.
#pragma once

#include "shell/contact/barrier.hpp"

namespace luff::shell {

/// A fraction of the move dx, at most `limit`, up to which the distance of the pieces stays above `keep` of its present
/// value, 0 < keep < 1. Conservative advancement: pieces that approach no faster than a bound can safely go until that
/// bound would bring them together, and again from there. The result is safe whatever the motion, and comes within a
/// hundredth of the room there is. Source: \cite li_2021_codimensional (additive continuous collision detection).
double safe_fraction(PairKind kind, const Corners& x, const Corners& dx, double keep, double limit = 1.0);

}  // namespace luff::shell
