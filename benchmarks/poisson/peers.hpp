// SPDX-License-Identifier: BSD-3-Clause
// The pressure equation solved by other libraries.  Their matrix has its diagonal raised by 1e-9, without which their
// conjugate gradients break down on closed domains.
#pragma once

#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_struct_ls.h>
#include <petscdmda.h>
#include <petscksp.h>

#include "poisson/projection.hpp"

namespace luff::benchmark {

constexpr double raised = 1.0 + 1e-9;

/// hypre's structured multigrid (PFMG-preconditioned conjugate gradients).
class Pfmg {
 public:
  explicit Pfmg(const Flow& flow) : cells_(flow.grid.cells())
  {
    HYPRE_StructGridCreate(MPI_COMM_SELF, 3, &grid_);
    HYPRE_StructGridSetExtents(grid_, lo_.data(), hi());
    HYPRE_StructGridAssemble(grid_);
    HYPRE_StructStencilCreate(3, 4, &stencil_);
    std::array<Index3, 4> offsets{Index3{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (int s = 0; s < 4; ++s)
      HYPRE_StructStencilSetElement(stencil_, s, offsets[s].data());
    HYPRE_StructMatrixCreate(MPI_COMM_SELF, grid_, stencil_, &matrix_);
    HYPRE_StructMatrixSetSymmetric(matrix_, 1);
    HYPRE_StructMatrixInitialize(matrix_);
    HYPRE_StructVectorCreate(MPI_COMM_SELF, grid_, &b_);
    HYPRE_StructVectorCreate(MPI_COMM_SELF, grid_, &x_);
    HYPRE_StructVectorInitialize(b_);
    HYPRE_StructVectorInitialize(x_);
    fill(flow);
    HYPRE_StructMatrixAssemble(matrix_);
    HYPRE_StructVectorAssemble(b_);
    HYPRE_StructVectorAssemble(x_);
  }
  Pfmg(const Pfmg&) = delete;
  Pfmg& operator=(const Pfmg&) = delete;
  ~Pfmg()
  {
    HYPRE_StructVectorDestroy(x_);
    HYPRE_StructVectorDestroy(b_);
    HYPRE_StructMatrixDestroy(matrix_);
    HYPRE_StructStencilDestroy(stencil_);
    HYPRE_StructGridDestroy(grid_);
  }

  void run(Timing& best)
  {
    HYPRE_StructSolver krylov = nullptr;
    HYPRE_StructSolver multigrid = nullptr;
    HYPRE_StructPCGCreate(MPI_COMM_SELF, &krylov);
    HYPRE_StructPCGSetTol(krylov, reduction);
    HYPRE_StructPCGSetMaxIter(krylov, 300);
    HYPRE_StructPCGSetTwoNorm(krylov, 1);
    HYPRE_StructPFMGCreate(MPI_COMM_SELF, &multigrid);
    HYPRE_StructPFMGSetMaxIter(multigrid, 1);
    HYPRE_StructPFMGSetTol(multigrid, 0.0);
    HYPRE_StructPFMGSetZeroGuess(multigrid);
    HYPRE_StructPFMGSetRelaxType(multigrid, 2);  // red-black Gauss-Seidel
    HYPRE_StructPFMGSetNumPreRelax(multigrid, 1);
    HYPRE_StructPFMGSetNumPostRelax(multigrid, 1);
    HYPRE_StructPFMGSetSkipRelax(multigrid, 1);
    HYPRE_StructPCGSetPrecond(krylov, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid);
    HYPRE_StructVectorSetConstantValues(x_, 0.0);
    const double start = thread_time();
    HYPRE_StructPCGSetup(krylov, matrix_, b_, x_);
    const double ready = thread_time();
    HYPRE_StructPCGSolve(krylov, matrix_, b_, x_);
    const double done = thread_time();
    best.set_up = std::min(best.set_up, ready - start);
    best.solve = std::min(best.solve, done - ready);
    double residual = 0.0;
    HYPRE_StructPCGGetNumIterations(krylov, &best.iterations);
    HYPRE_StructPCGGetFinalRelativeResidualNorm(krylov, &residual);
    best.converged = residual <= reduction;
    HYPRE_ClearAllErrors();
    HYPRE_StructPCGDestroy(krylov);
    HYPRE_StructPFMGDestroy(multigrid);
  }

 private:
  int* hi()
  {
    for (int a = 0; a < 3; ++a)
      hi_[a] = cells_[a] - 1;
    return hi_.data();
  }

  void fill(const Flow& flow)
  {
    const Field3<double> c = flow.conductances();
    std::vector<double> rows;
    std::vector<double> b;
    for (int k = 0; k < cells_[2]; ++k)
      for (int j = 0; j < cells_[1]; ++j)
        for (int i = 0; i < cells_[0]; ++i) {
          const double diagonal =
              c[0](i, j, k) + c[0](i + 1, j, k) + c[1](i, j, k) + c[1](i, j + 1, k) + c[2](i, j, k) + c[2](i, j, k + 1);
          rows.push_back(diagonal > 0.0 ? diagonal * raised : 1.0);
          rows.push_back(i > 0 ? -c[0](i, j, k) : 0.0);
          rows.push_back(j > 0 ? -c[1](i, j, k) : 0.0);
          rows.push_back(k > 0 ? -c[2](i, j, k) : 0.0);
          b.push_back(flow.U[0](i, j, k) - flow.U[0](i + 1, j, k) + flow.U[1](i, j, k) - flow.U[1](i, j + 1, k) +
                      flow.U[2](i, j, k) - flow.U[2](i, j, k + 1));
        }
    std::array<int, 4> entries{0, 1, 2, 3};
    HYPRE_StructMatrixSetBoxValues(matrix_, lo_.data(), hi_.data(), 4, entries.data(), rows.data());
    HYPRE_StructVectorSetBoxValues(b_, lo_.data(), hi_.data(), b.data());
  }

  Index3 cells_;
  Index3 lo_{0, 0, 0};
  Index3 hi_{};
  HYPRE_StructGrid grid_ = nullptr;
  HYPRE_StructStencil stencil_ = nullptr;
  HYPRE_StructMatrix matrix_ = nullptr;
  HYPRE_StructVector b_ = nullptr;
  HYPRE_StructVector x_ = nullptr;
};

/// PETSc's conjugate gradients on an assembled matrix over a DMDA, with algebraic or geometric (Galerkin) multigrid.
class Petsc {
 public:
  enum class Preconditioner { Gamg, BoomerAmg, Geometric };

  Petsc(const Flow& flow, Preconditioner kind) : kind_(kind)
  {
    const Index3& n = flow.grid.cells();
    DMDACreate3d(PETSC_COMM_SELF, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, n[0], n[1],
                 n[2], 1, 1, 1, 1, 1, nullptr, nullptr, nullptr, &dm_);
    DMSetUp(dm_);
    DMDASetInterpolationType(dm_, DMDA_Q0);
    DMCreateMatrix(dm_, &matrix_);
    DMCreateGlobalVector(dm_, &b_);
    VecDuplicate(b_, &x_);
    fill(flow);
  }
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;
  ~Petsc()
  {
    VecDestroy(&x_);
    VecDestroy(&b_);
    MatDestroy(&matrix_);
    DMDestroy(&dm_);
  }

  void run(Timing& best)
  {
    KSP krylov = nullptr;
    PC preconditioner = nullptr;
    KSPCreate(PETSC_COMM_SELF, &krylov);
    KSPSetType(krylov, KSPCG);
    KSPSetNormType(krylov, KSP_NORM_UNPRECONDITIONED);
    KSPSetTolerances(krylov, reduction, PETSC_DEFAULT, PETSC_DEFAULT, 300);
    KSPGetPC(krylov, &preconditioner);
    choose(krylov, preconditioner);
    KSPSetOperators(krylov, matrix_, matrix_);
    const double start = thread_time();
    KSPSetUp(krylov);
    PCSetUp(preconditioner);
    const double ready = thread_time();
    KSPSolve(krylov, b_, x_);
    const double done = thread_time();
    best.set_up = std::min(best.set_up, ready - start);
    best.solve = std::min(best.solve, done - ready);
    PetscInt iterations = 0;
    KSPConvergedReason reason{};
    KSPGetIterationNumber(krylov, &iterations);
    KSPGetConvergedReason(krylov, &reason);
    best.iterations = static_cast<int>(iterations);
    best.converged = reason > 0;
    KSPDestroy(&krylov);
  }

 private:
  /// Each with the settings its manual recommends for such a problem.
  void choose(KSP krylov, PC preconditioner)
  {
    if (kind_ == Preconditioner::Gamg) {
      PCSetType(preconditioner, PCGAMG);
    } else if (kind_ == Preconditioner::BoomerAmg) {
      PCSetType(preconditioner, PCHYPRE);
      PCHYPRESetType(preconditioner, "boomeramg");
      PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_coarsen_type", "HMIS");
      PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_interp_type", "ext+i");
      PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_strong_threshold", "0.25");
      PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_P_max", "4");
      PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_relax_type_all", "symmetric-SOR/Jacobi");
      PCSetFromOptions(preconditioner);
    } else {
      KSPSetDM(krylov, dm_);
      KSPSetDMActive(krylov, PETSC_FALSE);
      PCSetType(preconditioner, PCMG);
      PCMGSetLevels(preconditioner, 5, nullptr);
      PCMGSetGalerkin(preconditioner, PC_MG_GALERKIN_BOTH);
    }
  }

  void fill(const Flow& flow)
  {
    const Index3& n = flow.grid.cells();
    const Field3<double> c = flow.conductances();
    PetscScalar*** b = nullptr;
    DMDAVecGetArray(dm_, b_, &b);
    for_each_cell_in_order(flow.grid.owned(), [&](int i, int j, int k) {
      const Index3 cell{i, j, k};
      const MatStencil row{k, j, i, 0};
      std::array<MatStencil, 7> columns;
      std::array<PetscScalar, 7> values;
      PetscInt count = 0;
      double diagonal = 0.0;
      b[k][j][i] = 0.0;
      for (int side = 0; side < 6; ++side) {
        const int a = side / 2;
        const Index3 face = stepped(cell, a, side % 2);
        const Index3 other = stepped(cell, a, side % 2 == 0 ? -1 : 1);
        const double value = c[a](face[0], face[1], face[2]);
        diagonal += value;
        b[k][j][i] += (side % 2 == 0 ? 1.0 : -1.0) * flow.U[a](face[0], face[1], face[2]);
        if (other[a] < 0 || other[a] == n[a])
          continue;
        columns[count] = {other[2], other[1], other[0], 0};
        values[count++] = -value;
      }
      columns[count] = row;
      values[count++] = diagonal > 0.0 ? diagonal * raised : 1.0;
      MatSetValuesStencil(matrix_, 1, &row, count, columns.data(), values.data(), INSERT_VALUES);
    });
    DMDAVecRestoreArray(dm_, b_, &b);
    MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY);
    MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY);
    MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE);
  }

  Preconditioner kind_;
  DM dm_ = nullptr;
  Mat matrix_ = nullptr;
  Vec b_ = nullptr;
  Vec x_ = nullptr;
};

}  // namespace luff::benchmark
