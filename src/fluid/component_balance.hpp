// SPDX-License-Identifier: BSD-3-Clause
// What flows into a part of the fluid that sheets seal off must flow out of it.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "core/time_step.hpp"
#include "grid/grid.hpp"
#include "immersed/cut_links.hpp"
#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::fluid {

/// Sheets and sides prescribe the flux through the boundary of a component of the fluid without an outlet.  Where it is
/// not zero in all, no pressure makes the flow divergence-free: a valve that still moves when the last gap of the grid
/// has closed, a pocket whose wall is known at single points only.  What is left over leaks through the cut faces,
///
///   U_f <- U_f + A_f (lambda_P - lambda_N),   sum_f A_f (lambda_C - lambda_C') = - sum_f U_f of each such component C,
///
/// with the smallest change sum (dU)^2/A; lambda = 0 in components with an outlet.
class ComponentBalance {
 public:
  explicit ComponentBalance(const grid::Grid& grid) : grid_(grid), label_(grid.owned(), -1), halo_(grid.ranks()) {}

  /// Learns which components the cut links leave.  Collective.
  void update(const immersed::CutLinks& links, const poisson::PressureSolver& pressure);

  /// Balances U, whose prescribed fluxes are set.  Throws RunError when the sides alone bring a flow into a component
  /// without an outlet.  Collective.
  void apply(const View3<double>& U, const TimeStep& step);

  /// Largest |lambda_P - lambda_N| of the last apply(): velocity through sheets that seal something off [L/T].
  [[nodiscard]] double leak() const { return leak_; }
  [[nodiscard]] int sealed_components() const { return static_cast<int>(sealed_.size()); }

 private:
  /// A cut face between two components.
  struct Gate {
    int axis = 0;
    Index3 cell{};
    int below = 0;  ///< component of P
    int above = 0;  ///< of N
    bool owned = false;
  };
  void label_beside(const immersed::CutLinks& links, const poisson::PressureSolver& pressure);
  void find_gates(const immersed::CutLinks& links);
  void factorise();
  /// Of a sealed component through the sides of the domain.
  struct Outflow {
    double net = 0.0;              ///< [L^3/T]
    double gross = 0.0;            ///< without signs
    double moment[3] = {0, 0, 0};  ///< gross times place
  };
  [[nodiscard]] std::vector<Outflow> outflow_of_sides(const View3<double>& U) const;
  void refuse_inflow(const std::vector<Outflow>& outflow, const TimeStep& step) const;
  [[nodiscard]] Eigen::VectorXd net_outflow(const View3<double>& U, const TimeStep& step) const;

  const grid::Grid& grid_;
  const poisson::PressureSolver* pressure_ = nullptr;
  Field<int> label_;  ///< of cells beside cut faces
  HaloExchange halo_;
  std::vector<int> unknown_;  ///< number among the sealed ones of each component, or -1
  std::vector<int> sealed_;   ///< components without an outlet, when there is another one
  std::vector<Gate> gates_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> laplacian_;
  double leak_ = 0.0;
};

}  // namespace luff::fluid
