// SPDX-License-Identifier: BSD-3-Clause
// The projection by multigrid-preconditioned conjugate gradients inside refinement of the fluxes themselves.
#pragma once

#include <memory>
#include <vector>

#include "poisson/conjugate_gradients.hpp"
#include "poisson/curvilinear_correction.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Refinement in flux form: the right-hand side of every round is the net outflow of the fluxes as they are, in double
/// precision, so that round-off of the pressure never shows in the divergence; the correction is found in single.
class MultigridSolver final : public PressureSolver {
 public:
  MultigridSolver(const grid::Grid& grid, const SideConditions& sides);
  ~MultigridSolver() override;

  void set_blocked(std::span<const FaceIndex> faces) override;
  Report project(const View3<double>& U, const View<double>& p, double dt, const Target& target) override;
  void subtract_gradient(const View3<double>& U, const View<double>& p, double dt) override;
  [[nodiscard]] int components() const override { return static_cast<int>(floating_.size()); }
  [[nodiscard]] bool is_floating(int component) const override { return floating_[component] != 0; }
  [[nodiscard]] int component_of(const Index3& cell) const override;

 private:
  [[nodiscard]] Index3 internal(const Index3& c) const { return {c[0], c[axis_[1]], c[axis_[2]]}; }
  [[nodiscard]] FaceIndex internal(const FaceIndex& f) const { return {axis_[f.axis], internal(f.cell), f.open}; }
  [[nodiscard]] Neighbourhood neighbourhood() const;
  [[nodiscard]] std::unique_ptr<FluxCorrection> make_fluxes(const SideConditions& sides);
  [[nodiscard]] Box make_box(const SideConditions& sides) const;
  [[nodiscard]] std::vector<double> mean_widths(int axis) const;
  [[nodiscard]] StoredCoefficients::Source coefficient_source() const;
  [[nodiscard]] CrossTerms::Source cross_source() const;
  void make_cross_terms();
  void update_operator();
  void label_components();
  [[nodiscard]] std::vector<double> means(const View<const double>& values, bool by_volume) const;
  [[nodiscard]] std::vector<double> mean_of_all(const View<const double>& values, bool by_volume) const;
  void remove_means(const View<double>& values, bool by_volume) const;
  void load_row(int j, int k, const double* values, double shift, double scale);
  double load_right_hand_side(const Outflow& outflow);
  void unload_row(int j, int k);
  void mirror_row(int axis, int j, int k);
  void unload_plane(int t, const View<double>& p, double to_pressure);
  [[nodiscard]] double inner_tolerance(const Outflow& outflow, double initial_norm, const Target& target) const;

  const grid::Grid& grid_;
  SideConditions sides_;
  Index3 axis_;  // grid axis of each axis of the multigrid: the longer of y and z comes last
  double unit_;  // smallest width
  Neighbourhood neighbourhood_;
  CurvilinearCorrection* curvilinear_ = nullptr;  // fluxes_ on curvilinear grids
  std::unique_ptr<FluxCorrection> fluxes_;
  Multigrid multigrid_;
  std::unique_ptr<CrossTerms> cross_terms_;  // on curvilinear grids
  std::unique_ptr<ConjugateGradients> inner_;
  HaloExchange halo_;
  Field<double> net_;  // minus the net outflow
  Field<float> correction_;
  double scale_ = 1.0;              // of the right-hand side that the inner solver sees
  std::vector<FaceIndex> blocked_;  // of this rank
  std::vector<int> component_;      // see Multigrid::label_components
  std::vector<char> floating_;      // per component
};

}  // namespace luff::poisson
