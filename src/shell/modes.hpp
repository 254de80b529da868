// SPDX-License-Identifier: BSD-3-Clause
// Natural frequencies and modes of a shell: K phi = omega^2 M phi.
#pragma once

#include <Eigen/Core>

#include "shell/block_matrix.hpp"
#include "shell/shell.hpp"

namespace luff::shell {

/// The lowest vibrations, ascending; column k of `shapes` belongs to entry k of `omega_squared`.
struct Modes {
  /// [1/T^2]. Rigid motions of a free shell have zero to round-off; below zero, the state is unstable.
  Eigen::VectorXd omega_squared;
  /// 3n x count, zero where held, phi' M phi = 1 [1/sqrt(M)], largest component positive.
  Eigen::MatrixXd shapes;

  int count() const { return static_cast<int>(omega_squared.size()); }
  /// omega_k [1/T]; where the state is unstable, minus the rate at which the mode grows.
  double angular_frequency(int k) const;
  /// Share of the shell's mass that a shaking of its supports along x, y or z moves in mode k [-],
  /// (phi' M e)^2 / (e' M e), e the translation; over all modes they sum to 1 but for the mass that is held.
  Vec3 mass_share(const Shell& shell, int k) const;
};

/// \throws InputError where the shell has no mass or fewer than `count` unknowns.
void check_modes(const Shell& shell, int count);

/// The `count` lowest modes for a symmetric stiffness K on the shell's pattern and its consistent mass.
/// \throws InputError as check_modes. \throws RunError when modes are missed or don't converge.
Modes natural_modes(const Shell& shell, const BlockMatrix& K, int count);

/// About the reference configuration, without loads. \throws as above.
Modes natural_modes(const Shell& shell, int count);

}  // namespace luff::shell
