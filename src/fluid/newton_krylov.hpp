// SPDX-License-Identifier: BSD-3-Clause
// Newton's method without a Jacobian [knoll_2004_jacobianfree] for vector fields that solve x = T(x).
#pragma once

#include <functional>
#include <memory>

#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::fluid {

struct NewtonReport {
  int iterations = 0;         ///< of Newton
  int krylov_iterations = 0;  ///< all together; as many products of the Jacobian with a vector
  double residual = 0.0;      ///< root mean square of x - T(x), per cell
  bool converged = false;
};

/// F(x) = x - T(x) = 0 by PETSc's SNES: products J v = [F(x + eps v) - F(x)]/eps, restarted GMRES, forcing terms after
/// Eisenstat and Walker.  T is a pure function of x.
class NewtonKrylov {
 public:
  /// Replaces x, given on the cells of this rank, by T(x).  Collective.
  using Map = std::function<void(const View3<double>& x)>;
  /// Replaces the residual r by an approximate solution of J z = r.
  using Preconditioner = std::function<void(const View3<double>& r)>;

  NewtonKrylov(const grid::Grid& grid, Map map, Preconditioner preconditioner);
  NewtonKrylov(const NewtonKrylov&) = delete;
  NewtonKrylov& operator=(const NewtonKrylov&) = delete;
  ~NewtonKrylov();

  /// From x to a root mean square residual of `tolerance`.  What T throws comes out.  Collective.
  NewtonReport solve(const View3<double>& x, double tolerance);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace luff::fluid
