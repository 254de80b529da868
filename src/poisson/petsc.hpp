// SPDX-License-Identifier: BSD-3-Clause
// PETSc's objects with owners, its error codes as exceptions.
#pragma once

#include <petscsnes.h>

#include "core/error.hpp"

namespace luff::petsc {

inline void check(PetscErrorCode code)
{
  if (code == 0)
    return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  fail_run("PETSc failed with error {}: {}", static_cast<int>(code), text != nullptr ? text : "no message");
}

/// Once per process; MPI must run.
inline void initialise()
{
  PetscBool ready = PETSC_FALSE;
  check(PetscInitialized(&ready));
  if (ready == PETSC_TRUE)
    return;
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

/// Owns a PETSc object.
template <class Handle, PetscErrorCode (*destroy)(Handle*)>
class Owned {
 public:
  Owned() { initialise(); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { reset(); }
  void reset()
  {
    if (handle_ != nullptr)
      destroy(&handle_);
    handle_ = nullptr;
  }
  operator Handle() const { return handle_; }  // NOLINT: stands in for the handle in PETSc's calls
  Handle* out() { return &handle_; }

 private:
  Handle handle_ = nullptr;
};

using Vector = Owned<Vec, VecDestroy>;
using Matrix = Owned<Mat, MatDestroy>;
using Krylov = Owned<KSP, KSPDestroy>;
using Nonlinear = Owned<SNES, SNESDestroy>;

}  // namespace luff::petsc
