// SPDX-License-Identifier: BSD-3-Clause
// Linear systems of the shell on its free displacements.
#include "shell/linear_solver.hpp"

#include "core/error.hpp"
#include "shell/conjugate_gradients.hpp"
#include "shell/free_unknowns.hpp"
#include "shell/multifrontal.hpp"

namespace luff::shell {

namespace {

class DirectSolver : public LinearSolver {
 public:
  DirectSolver(const BlockPattern& pattern, const std::vector<char>& held)
      : unknowns_(held), triangle_(pattern, unknowns_), factor_(triangle_.pattern())
  {
  }

  Factorisation factorise(const BlockMatrix& A) override
  {
    if (!factor_.factorise(triangle_.values(A)))
      fail_run(
          "the shell's stiffness is singular: it can move without resistance; add a support or mass, or take "
          "smaller steps");
    return {.negative_pivots = factor_.n_negative_pivots()};
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override
  {
    Eigen::VectorXd u = unknowns_.restricted(b);
    factor_.solve(u);
    return unknowns_.expanded(u);
  }

 private:
  FreeUnknowns unknowns_;
  FreeTriangle triangle_;
  Multifrontal factor_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(LinearSolverKind kind, const BlockPattern& pattern,
                                                 const std::vector<char>& held)
{
  switch (kind) {
    case LinearSolverKind::ConjugateGradients:
      return std::make_unique<ConjugateGradients>(make_block_jacobi(pattern, held), held);
    case LinearSolverKind::CgIncompleteCholesky:
      return std::make_unique<ConjugateGradients>(make_incomplete_cholesky(pattern, held), held);
    case LinearSolverKind::Direct:
      break;
  }
  return std::make_unique<DirectSolver>(pattern, held);
}

}  // namespace luff::shell
