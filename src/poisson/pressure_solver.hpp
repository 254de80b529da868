// SPDX-License-Identifier: BSD-3-Clause
// Exact projection of volume fluxes: the interface that the fluid sees, whatever solves the pressure equation.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::poisson {

/// What holds on a side of the domain: p_n = 0 (walls, prescribed velocity, symmetry) or p = g on the face (outflow).
/// Periodic sides come from the grid; what is given for them is not read.
enum class SideCondition { Neumann, Dirichlet };
/// Indexed [axis][0 low, 1 high].
using SideConditions = std::array<std::array<SideCondition, 2>, 3>;

/// The low face of `cell` normal to `axis`; the high side of the domain is the low face of cell n.
struct FaceIndex {
  int axis = 0;
  Index3 cell{};
  double open = 0.0;  ///< part of a blocked face that lets the flow through all the same, in [0, 1)

  friend auto operator<=>(const FaceIndex&, const FaceIndex&) = default;
  friend bool operator==(const FaceIndex&, const FaceIndex&) = default;
};

/// When a projection is good enough.
struct Target {
  double relative = 0.0;  ///< the 2-norm of the net outflows fell by this factor, or
  double divergence =
      0.0;             ///< max over cells of |net outflow| h / (V speed) is at most this; h: smallest width of the cell
  double speed = 1.0;  ///< velocity scale of `divergence` [L/T]
  int max_iterations = 100;
};

/// What a projection did.
struct Report {
  int iterations = 0;       ///< multigrid cycles
  int refinements = 0;      ///< times the net outflows were recomputed from the corrected fluxes
  double divergence = 0.0;  ///< max over cells of |net outflow| h / (V speed) on return, computed from the fluxes
  Index3 worst_cell{};      ///< where
  bool converged = false;   ///< the target was met
};

/// Makes volume fluxes divergence-free with the gradient of a pressure.
///
/// The gradient through a face of area A between cells P and N, whose centres are d apart, is
///
///   (G p) = A (p_N - p_P) / d          on open faces
///   (G p) = A (g - p_P) / (h_P / 2)    on a high Dirichlet side; A (p_P - g) / (h_P / 2) on a low one
///   (G p) = 0                          on blocked faces and Neumann sides,
///
/// g the pressure given there; on curvilinear grids it is the one of CurvilinearOperator.  Through a face that is
/// blocked in part it is that of an open face times the part that is open.
///
/// Calls are collective over the grid's ranks.  Ranks that share a face end with the same bits of flux there, and any
/// number of threads gives the same bits everywhere.
class PressureSolver {
 public:
  virtual ~PressureSolver() = default;

  /// Declares the faces that carry no pressure gradient, or less of it (cut by a sheet), among the faces of owned
  /// cells, those on this rank's edges included (both ranks that share a face list it).  Replaces the earlier set;
  /// cheap when little changes.
  virtual void set_blocked(std::span<const FaceIndex> faces) = 0;

  /// U <- U - dt G p with net outflow zero from every cell.
  ///
  /// On entry U = U* on all faces of owned cells (volume fluxes, low-face convention) and p is the first guess in owned
  /// cells.  Its halo beyond Dirichlet sides tells the pressure given there, which is the mean of p in the cell inside
  /// and in the one beyond: p_beyond = 2 g - p_inside.
  /// On return p solves div(G p) = div(U*)/dt, its halo is filled by exchange and, beyond Dirichlet sides, so that the
  /// means stay as they were (beyond other sides it is left alone), and U holds the corrected fluxes on all faces of
  /// owned cells.
  /// Where no pressure is prescribed, p has zero mean over each connected part of the fluid; in isolated cells, whose
  /// faces are all blocked, p = 0, and what flows into them does not count.
  virtual Report project(const View3<double>& U, const View<double>& p, double dt, const Target& target) = 0;

  /// U <- U - dt G p on all faces of owned cells, with the G of project(), for a p that is known.  The halo of p is
  /// filled by exchange; beyond Dirichlet sides it tells the pressure there, as for project().
  virtual void subtract_gradient(const View3<double>& U, const View<double>& p, double dt) = 0;

  /// Connected parts of the fluid, the same numbers on every rank.
  [[nodiscard]] virtual int components() const = 0;
  /// Whether no Dirichlet side touches a component: it has no outlet.
  [[nodiscard]] virtual bool is_floating(int component) const = 0;
  /// Of an owned cell.
  [[nodiscard]] virtual int component_of(const Index3& cell) const = 0;
};

struct SolverOptions {
  std::string kind = "multigrid";  ///< "multigrid", or "petsc" (conjugate gradients with algebraic multigrid)
};

/// Collective.  Throws InputError for an unknown kind.
[[nodiscard]] std::unique_ptr<PressureSolver> make_pressure_solver(const grid::Grid& grid, const SideConditions& sides,
                                                                   const SolverOptions& options = {});

}  // namespace luff::poisson
