// SPDX-License-Identifier: BSD-3-Clause
// How sharply a deformed shell folds over the edges of its mesh.
#pragma once

#include <string>

#include <Eigen/Core>

#include "shell/shell.hpp"

namespace luff::shell {

/// Folds of a deformed shell: change of the angle between neighbouring triangles since the reference [degrees]. Over
/// clamped and symmetry edges the neighbour is the mirror image, so that the shell folds by twice what it turns there.
struct Folds {
  double largest = 0;
  surface::TriangleEdge at{-1, -1};
  int n_sharp = 0;  ///< edges folded by more than 45 degrees: the element loses accuracy there
};

/// In configuration x, with supports at time t, moved by the part `factor` of their motion.
Folds folds(const Shell& shell, const Eigen::VectorXd& x, double t = 0, double factor = 1);

/// Folds, none above `limit` [degrees]: the element's energy has a maximum at 90 and falls beyond.
/// \throws RunError that starts with `when` and names the place.
Folds check_folds(const Shell& shell, const Eigen::VectorXd& x, double limit, const std::string& when, double t = 0,
                  double factor = 1);

}  // namespace luff::shell
