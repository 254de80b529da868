// SPDX-License-Identifier: BSD-3-Clause
// Direct and iterative solvers of the shell's linear systems.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <omp.h>

#include "core/error.hpp"
#include "shell/conjugate_gradients.hpp"
#include "shell/multifrontal.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties soft{.thickness = 0.02, .density = 1, .material = SaintVenantKirchhoff{1e6, 0.4}};

Shell clamped_shell(const surface::TriangleMesh& mesh)
{
  return Shell(
      mesh, soft,
      {{.kind = SupportKind::Clamped, .vertices = test::vertices_where(mesh, [](auto& X) { return X.y() == 0; })}});
}

BlockMatrix stiffness(const Shell& shell)
{
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  return K;
}

Eigen::VectorXd solved(LinearSolverKind kind, const Shell& shell, const BlockMatrix& A, const Eigen::VectorXd& b)
{
  const auto solver = make_linear_solver(kind, *shell.pattern(), shell.held());
  solver->factorise(A);
  return solver->solve(b);
}

/// |A u - b| on the free displacements relative to |A| |u|: what a stable factorisation keeps at round-off.
double backward_error(const Shell& shell, const BlockMatrix& A, const Eigen::VectorXd& u, const Eigen::VectorXd& b)
{
  Eigen::VectorXd r = A * u - b;
  shell.clear_held(r);
  const double largest = Eigen::Map<const Eigen::VectorXd>(A.values().data(), std::ssize(A.values())).norm();
  return r.norm() / (largest * u.norm());
}

/// A symmetric matrix of random entries: banded, some columns coupled to none, far from definite.
Eigen::MatrixXd random_symmetric(int n, int band)
{
  const Eigen::VectorXd random = test::random_vector(n * n, 3);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    A(j, j) = (j % 3 == 0 ? -1 : 1) * (3 * band + random[j]);
    for (int i = std::max(0, j - band); i < j; ++i)
      if (j % 11 != 0 && i % 11 != 0)
        A(i, j) = A(j, i) = random[n * i + j];
  }
  return A;
}

TEST(Multifrontal, SolvesIndefiniteMatricesAndCountsTheirNegativeEigenvalues)
{
  for (const int n : {1, 2, 10, 200}) {
    const Eigen::MatrixXd A = random_symmetric(n, 7);
    UpperTriangle pattern{{0}, {}};
    std::vector<double> values;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i <= j; ++i)
        if (A(i, j) != 0) {
          pattern.row.push_back(i);
          values.push_back(A(i, j));
        }
      pattern.start.push_back(static_cast<int>(pattern.row.size()));
    }
    Multifrontal factor(pattern);
    ASSERT_TRUE(factor.factorise(values));
    const Eigen::VectorXd exact = test::random_vector(n, 5);
    Eigen::VectorXd u = A * exact;
    factor.solve(u);
    EXPECT_LT((u - exact).norm(), 1e-13 * exact.norm()) << n;
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
    EXPECT_EQ(factor.n_negative_pivots(), (eigenvalues.array() < 0).count()) << n;
  }
}

TEST(Multifrontal, SaysThatAPivotIsZero)
{
  Multifrontal factor({{0, 1, 2}, {0, 1}});
  EXPECT_FALSE(factor.factorise(std::vector<double>{1.0, 0.0}));
  EXPECT_TRUE(factor.factorise(std::vector<double>{1.0, 2.0}));
}

TEST(LinearSolver, DirectSolutionsHaveResidualsOfRoundOff)
{
  const Shell shell = clamped_shell(test::curved_sheet(24, 22));
  const BlockMatrix K = stiffness(shell);
  const Eigen::VectorXd b = test::random_vector(3 * shell.n_vertices(), 1);
  const Eigen::VectorXd u = solved(LinearSolverKind::Direct, shell, K, b);
  EXPECT_LT(backward_error(shell, K, u, b), 1e-15);
}

TEST(LinearSolver, DirectSolutionsAreTheSameBitsOnOneAndTwoThreads)
{
  const Shell shell = clamped_shell(test::curved_sheet(40, 40));
  const BlockMatrix K = stiffness(shell);
  const Eigen::VectorXd b = test::random_vector(3 * shell.n_vertices(), 1);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Eigen::VectorXd one = solved(LinearSolverKind::Direct, shell, K, b);
  omp_set_num_threads(2);
  const Eigen::VectorXd two = solved(LinearSolverKind::Direct, shell, K, b);
  omp_set_num_threads(before);
  EXPECT_EQ(one, two);
}

TEST(LinearSolver, NegativePivotsAreTheFrequenciesBelowAShift)
{
  const Shell shell = clamped_shell(test::curved_sheet(8, 7));
  const Eigen::VectorXd omega = test::natural_frequencies(shell);
  const auto solver = make_linear_solver(LinearSolverKind::Direct, *shell.pattern(), shell.held());
  for (const int below : {0, 1, 7, 30}) {
    const double middle = below == 0 ? 0.5 * omega[0] : 0.5 * (omega[below - 1] + omega[below]);
    BlockMatrix A = stiffness(shell);
    shell.add_mass(-middle * middle, A);
    EXPECT_EQ(solver->factorise(A).negative_pivots, below);
  }
}

TEST(LinearSolver, AShellWithoutStiffnessIsSingular)
{
  const Shell shell = clamped_shell(test::curved_sheet());
  const auto solver = make_linear_solver(LinearSolverKind::Direct, *shell.pattern(), shell.held());
  EXPECT_THROW(solver->factorise(BlockMatrix(shell.pattern())), RunError);
}

TEST(LinearSolver, NothingIsUnknownWhereAllIsHeld)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 2, 2);
  const Shell shell(mesh, soft,
                    {{.kind = SupportKind::Fixed, .vertices = test::vertices_where(mesh, [](auto&) { return true; })}});
  for (const auto kind :
       {LinearSolverKind::Direct, LinearSolverKind::ConjugateGradients, LinearSolverKind::CgIncompleteCholesky})
    EXPECT_EQ(solved(kind, shell, stiffness(shell), test::random_vector(3 * shell.n_vertices(), 1)).norm(), 0);
}

// Bending alone resists the load: the worst case for iterations.
TEST(LinearSolver, IncompleteCholeskyTakesAFifthOfBlockJacobisIterations)
{
  const Shell shell = clamped_shell(test::curved_sheet(20, 20));
  const BlockMatrix K = stiffness(shell);
  const Eigen::VectorXd b = test::random_vector(3 * shell.n_vertices(), 1);
  const Eigen::VectorXd direct = solved(LinearSolverKind::Direct, shell, K, b);
  ConjugateGradients jacobi(make_block_jacobi(*shell.pattern(), shell.held()), shell.held());
  ConjugateGradients cholesky(make_incomplete_cholesky(*shell.pattern(), shell.held()), shell.held());
  for (ConjugateGradients* solver : {&jacobi, &cholesky}) {
    solver->factorise(K);
    EXPECT_LT((solver->solve(b) - direct).norm(), 1e-6 * direct.norm());
  }
  std::printf("  %d unknowns: %d iterations with block Jacobi, %d with incomplete Cholesky\n", 3 * shell.n_vertices(),
              jacobi.iterations(), cholesky.iterations());
  EXPECT_LT(5 * cholesky.iterations(), jacobi.iterations());
}

TEST(LinearSolver, ConjugateGradientsNameTheDirectSolverWhereTheShellBuckles)
{
  const Shell shell = clamped_shell(test::curved_sheet(8, 7));
  BlockMatrix A = stiffness(shell);
  shell.add_mass(-1.5 * std::pow(test::natural_frequencies(shell)[0], 2), A);
  for (const auto kind : {LinearSolverKind::ConjugateGradients, LinearSolverKind::CgIncompleteCholesky})
    try {
      solved(kind, shell, A, test::random_vector(3 * shell.n_vertices(), 1));
      ADD_FAILURE() << "nothing was thrown";
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find("use the direct solver"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace luff::shell
