// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients in single precision, preconditioned by the multigrid cycle.
#pragma once

#include <span>
#include <vector>

#include "poisson/cross_terms.hpp"
#include "poisson/multigrid.hpp"

namespace luff::poisson {

class ConjugateGradients {
 public:
  struct Result {
    int iterations = 0;
    double reduction = 1.0;  ///< of the residual's 2-norm, by recursion
    bool finite = true;
  };

  /// A is the operator of the finest level, and the cross terms where there are some.
  ConjugateGradients(Multigrid& multigrid, CrossTerms* cross_terms, MPI_Comm comm);

  /// Solves A e = f, f being the right-hand side in finest().f, which is overwritten by the residual; stops when its
  /// 2-norm fell by `tolerance`, or to what the rounding of e makes of A e.  e gets its halo.  Collective.
  Result solve(double tolerance, int max_iterations);
  [[nodiscard]] const Values& solution() const { return e_; }

 private:
  template <class Plane>
  double sum_planes(Plane plane) const;
  void sum_over_ranks(std::span<double> sums) const;
  [[nodiscard]] double norm_of_residual() const;
  double precondition();
  double advance_direction(float beta);
  void fill_halo(Values& values);
  struct Norms {
    double residual, solution;
  };
  Norms step(float alpha, bool first);

  Multigrid& multigrid_;
  CrossTerms* cross_terms_;
  MPI_Comm comm_;
  double diagonal_ = 0.0;  // root mean square of A's
  Values e_, p_, q_;
};

}  // namespace luff::poisson
