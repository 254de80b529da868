// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/newton_krylov.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "parallel/for_each.hpp"
#include "poisson/petsc.hpp"

namespace luff::fluid {

using petsc::check;

namespace {

constexpr int max_newton_steps = 20;
/// Of the first residual: enough where nothing gives a scale.
constexpr double relative_tolerance = 1e-12;
constexpr int max_krylov_steps = 200;  ///< of each Newton step
constexpr int krylov_restart = 30;

}  // namespace

class NewtonKrylov::Solver {
 public:
  Solver(const grid::Grid& grid, Map map, Preconditioner preconditioner)
      : grid_(grid),
        map_(std::move(map)),
        preconditioner_(std::move(preconditioner)),
        work_(make_field3<double>(grid.owned()))
  {
    const auto rows = static_cast<PetscInt>(3 * grid.owned().volume());
    check(VecCreateMPI(grid.ranks().comm(), rows, PETSC_DETERMINE, x_.out()));
    check(VecDuplicate(x_, residual_.out()));
    create();
  }

  NewtonReport solve(const View3<double>& x, double tolerance)
  {
    put({x[0], x[1], x[2]}, x_);
    PetscInt rows = 0;
    check(VecGetSize(x_, &rows));
    const double unknowns = static_cast<double>(rows) / 3.0;
    const double norm = std::max(tolerance * std::sqrt(unknowns), std::numeric_limits<double>::min());
    check(SNESSetTolerances(snes_, norm, relative_tolerance, 0.0, max_newton_steps, PETSC_DEFAULT));
    const PetscErrorCode code = SNESSolve(snes_, nullptr, x_);
    if (thrown_) {  // PETSc's solver has been left half way
      create();
      std::rethrow_exception(std::exchange(thrown_, nullptr));
    }
    check(code);
    take(x_, x);
    return report(unknowns);
  }

 private:
  void create()
  {
    snes_.reset();
    jacobian_.reset();
    check(SNESCreate(grid_.ranks().comm(), snes_.out()));
    check(SNESSetFunction(snes_, residual_, evaluate, this));
    check(MatCreateSNESMF(snes_, jacobian_.out()));
    check(SNESSetJacobian(snes_, jacobian_, jacobian_, MatMFFDComputeJacobian, nullptr));
    check(SNESSetType(snes_, SNESNEWTONLS));
    SNESLineSearch search = nullptr;
    check(SNESGetLineSearch(snes_, &search));
    check(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
    check(SNESKSPSetUseEW(snes_, PETSC_TRUE));
    check(SNESKSPSetParametersEW(snes_, 2, 0.01, 0.1, 0.9, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    check(SNESSetMaxLinearSolveFailures(snes_, max_newton_steps));
    KSP krylov = nullptr;
    check(SNESGetKSP(snes_, &krylov));
    check(KSPSetType(krylov, KSPGMRES));
    check(KSPGMRESSetRestart(krylov, krylov_restart));
    check(KSPSetPCSide(krylov, PC_RIGHT));
    check(KSPSetTolerances(krylov, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, max_krylov_steps));
    PC pc = nullptr;
    check(KSPGetPC(krylov, &pc));
    check(PCSetType(pc, PCSHELL));
    check(PCShellSetContext(pc, this));
    check(PCShellSetApply(pc, precondition));
  }

  NewtonReport report(double unknowns) const
  {
    NewtonReport report;
    PetscInt newton = 0;
    PetscInt krylov = 0;
    SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
    check(SNESGetIterationNumber(snes_, &newton));
    check(SNESGetLinearSolveIterations(snes_, &krylov));
    check(SNESGetFunctionNorm(snes_, &report.residual));
    check(SNESGetConvergedReason(snes_, &reason));
    report.iterations = static_cast<int>(newton);
    report.krylov_iterations = static_cast<int>(krylov);
    report.residual /= std::sqrt(unknowns);
    report.converged = reason > 0;
    return report;
  }

  void put(const View3<const double>& field, Vec vector) const
  {
    PetscScalar* values = nullptr;
    check(VecGetArray(vector, &values));
    for (int d = 0; d < 3; ++d)
      for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) { *values++ = field[d](i, j, k); });
    values -= 3 * grid_.owned().volume();
    check(VecRestoreArray(vector, &values));
  }

  void take(Vec vector, const View3<double>& field) const
  {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(vector, &values));
    for (int d = 0; d < 3; ++d)
      for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) { field[d](i, j, k) = *values++; });
    values -= 3 * grid_.owned().volume();
    check(VecRestoreArrayRead(vector, &values));
  }

  /// result = act(argument); an exception is kept for solve(), as PETSc's own frames cannot pass it on.
  template <class Act>
  PetscErrorCode apply(Vec argument, Vec result, const Act& act)
  {
    try {
      take(argument, views(work_));
      act(views(work_));
      put(views(std::as_const(work_)), result);
    } catch (...) {
      thrown_ = std::current_exception();
      return PETSC_ERR_USER;
    }
    return 0;
  }

  /// F = x - T(x).
  static PetscErrorCode evaluate(SNES, Vec x, Vec F, void* context)
  {
    auto& self = *static_cast<Solver*>(context);
    const PetscErrorCode code = self.apply(x, F, self.map_);
    return code != 0 ? code : VecAYPX(F, -1.0, x);
  }

  static PetscErrorCode precondition(PC pc, Vec r, Vec z)
  {
    void* context = nullptr;
    check(PCShellGetContext(pc, &context));
    auto& self = *static_cast<Solver*>(context);
    return self.apply(r, z, self.preconditioner_);
  }

  const grid::Grid& grid_;
  Map map_;
  Preconditioner preconditioner_;
  Field3<double> work_;
  petsc::Vector x_, residual_;
  petsc::Matrix jacobian_;
  petsc::Nonlinear snes_;
  std::exception_ptr thrown_;
};

NewtonKrylov::NewtonKrylov(const grid::Grid& grid, Map map, Preconditioner preconditioner)
    : solver_(std::make_unique<Solver>(grid, std::move(map), std::move(preconditioner)))
{
}

NewtonKrylov::~NewtonKrylov() = default;

NewtonReport NewtonKrylov::solve(const View3<double>& x, double tolerance)
{
  return solver_->solve(x, tolerance);
}

}  // namespace luff::fluid
