// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients in single precision, preconditioned by the multigrid cycle.
#pragma once

#include <vector>

#include "poisson/multigrid.hpp"

namespace luff::poisson {

class ConjugateGradients {
 public:
  struct Result {
    int iterations = 0;
    double reduction = 1.0;  ///< of the residual's 2-norm, by recursion
    bool finite = true;
  };

  ConjugateGradients(Multigrid& multigrid, MPI_Comm comm);

  /// Solves A e = f, f being the right-hand side in finest().f, which is overwritten by the residual; stops when its
  /// 2-norm fell by `tolerance`.  e gets its halo.  Collective.
  Result solve(double tolerance, int max_iterations);
  [[nodiscard]] const Values& solution() const { return e_; }

 private:
  template <class Plane>
  double sum_planes(Plane plane) const;
  [[nodiscard]] double total(double value) const;
  double residual_dot_direction();
  double advance_direction(float beta);
  double step(float alpha, bool first);

  Multigrid& multigrid_;
  MPI_Comm comm_;
  Values e_, p_, q_;
};

}  // namespace luff::poisson
