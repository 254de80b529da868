// SPDX-License-Identifier: BSD-3-Clause
// Incompressible flow around moving sheets: projection schemes of Runge-Kutta type.
//
//   du/dt = -div(u u) + nu lap u - grad p + f,   div u = 0,   u = u_b on sheets.
//
// "rk3": Wray's three stages, projected in stages 2 and 3, with the diagonal of cut links implicit
// (docs/numerics/time-scheme.md):
//
//   du <- du + dt (gamma_s N(u^{s-1}) + zeta_s N(u^{s-2}))
//   cut cells:  u* = [u^n + du + delta_s dt sum_cut v_k u_b - c_s dt G p]/(1 + delta_s dt sum_cut v_k)
//   faces:      U* = U^n + A <du>,  on cut faces A (u_b . e + eps exp(-c_s dt/tau))
//   s = 1:      U^1 = U* - c_1 dt G p^n
//   s = 2, 3:   div G p_s = div U*/(c_s dt),  U^s = U* - c_s dt G p_s
//   u^s from U^s.
//
// "newton-krylov": Alexander's two stages, both projected, of second order for steps of any length:
//
//   du = du_known + gamma dt N(u, U),   u = u^n + du - c dt G p + e,   U = U^n + A <du> - c dt G p,
//
// solved by Newton's method without a Jacobian; p from the stage before, e what recovering u from U changes.
//
// What does not depend on the sheet's current velocity (the stages before the last, and the rates of the last) is done
// once per step in begin_step(); a coupling iteration, project(), touches the cut cells, the faces and the pressure of
// the last stage only.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/profile.hpp"
#include "core/time_step.hpp"
#include "fluid/boundary.hpp"
#include "fluid/component_balance.hpp"
#include "fluid/momentum_balance.hpp"
#include "fluid/newton_krylov.hpp"
#include "fluid/stages.hpp"
#include "immersed/cross_terms.hpp"
#include "immersed/cut_cells.hpp"
#include "immersed/cut_links.hpp"
#include "immersed/loads.hpp"
#include "immersed/wall_nodes.hpp"
#include "operators/line_factors.hpp"
#include "operators/momentum.hpp"
#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::fluid {

/// How the flow sees sheets and bodies (docs/numerics/immersed.md, docs/numerics/curvib.md).  The links they cut carry
/// no pressure, and their faces the sheet's flux, in both.  They differ in the velocity of the cells beside them and in
/// the loads.
enum class ImmersedScheme {
  CutLink,  ///< momentum with differences that end on the sheet; loads link by link
  Curvib    ///< velocity reconstructed along the normal; loads by side and triangle from the nodes beside it
};

struct FlowOptions {
  TimeScheme scheme = TimeScheme::Rk3;
  ImmersedScheme immersed = ImmersedScheme::CutLink;
  bool edges_cover_in_part = false;  ///< of faces at free edges (CutLinks); cut-link only
  double density = 1.0;
  double viscosity = 0.0;                                               ///< kinematic [L^2/T]
  VectorFunction acceleration = VectorFunction::uniform(Vec3::Zero());  ///< body force per mass [L/T^2]
  double divergence = 5e-14;  ///< target of max |div U| h/|U| in the last stage
  /// Relative residual left by projections before the last.  A tenth would do for stability and second order, but what
  /// is left depends on the multigrid hierarchy, and with it on the number of ranks.
  double stage_reduction = 1e-9;
  int max_iterations = 100;  ///< of each pressure solve
};

/// The accepted flow at t^n: what a restart needs, with the offsets of cut faces.
struct FlowState {
  Field3<double> u;         ///< velocity at centres [L/T]
  Field3<double> U;         ///< volume fluxes [L^3/T]
  Field3<double> U_before;  ///< at t^{n-1}
  Field<double> p;          ///< kinematic pressure at t^{n-1/2} [L^2/T^2]
  Field<double> p_before;   ///< at t^{n-3/2}
  double dt = 0.0;          ///< t^n - t^{n-1} [T]; zero at t_0
  int steps = 0;            ///< accepted so far
};

struct PressureLoads {
  immersed::SheetLoads at_end;
  immersed::SheetLoads in_middle;
};

class FlowSolver {
 public:
  FlowSolver(const grid::Grid& grid, FlowOptions options, Boundaries boundaries,
             std::unique_ptr<poisson::PressureSolver> pressure);

  /// Sets and projects the velocity at t_0; no sheets yet.  Throws RunError when the projection fails.
  void start(const VectorFunction& velocity, double t_0);

  /// The stages before the last, and of the last what the sheets' current velocity leaves, from the accepted state; the
  /// geometry of the sheets is frozen.
  void begin_step(const TimeStep& step, const immersed::SheetMotion& predicted);

  /// The last stage with the sheets' current velocity: trial fluxes, divergence-free in every cell, and pressure.
  /// Repeatable within a step.  Throws RunError, naming step, time and place, when the pressure does not converge.
  poisson::Report project(std::span<const Vec3> sheet_velocity);

  /// Forces on the vertices of the sheets by the trial flow, the pressure extrapolated to t^{n+1}.
  [[nodiscard]] immersed::SheetLoads loads() const;
  /// What the pressure alone does to the vertices in the accepted step: at its end as in loads(), extrapolated, and in
  /// its middle, where it is solved for.  Halos filled by fill_halos().  Collective.
  [[nodiscard]] PressureLoads pressure_loads() const;
  /// Tractions per triangle and side by the trial (before accept) or accepted flow.
  [[nodiscard]] std::vector<immersed::SideTraction> tractions() const;

  /// Shear stress and pressure by the accepted flow on this rank's sides with a prescribed velocity, or on walls only,
  /// times the density [M/(L T^2)].  Halos filled by fill_halos().
  [[nodiscard]] std::vector<SideStress> side_stresses(bool walls_only) const;

  /// Commits the trial flow as the state at t^{n+1}.
  void accept();

  /// The cells with links that triangles [first, first + count) cut, widened by `margin` cells, in the grid.
  /// Collective.
  [[nodiscard]] IndexBox cells_around(int first_triangle, int count, int margin) const;
  /// Both ends of the accepted step, for balances, with valid halos; good until the next step begins.  Collective.
  [[nodiscard]] FlowOverStep accepted_step();
  /// What the fluid in a box of cells has lost in that step to what stands in it, by its momentum, in the mean of the
  /// step [M L/T^2]: independent of loads(), with which it has to agree.  Collective.
  [[nodiscard]] Vec3 force_by_momentum(const FlowOverStep& accepted, const IndexBox& box) const;

  /// Go on from an accepted state at time t and the offsets of all ranks' cut faces: with state() and
  /// links().accepted_offsets() of the same grid, boundaries and options the same bits as going on. Collective.
  void restore(FlowState state, const immersed::FluxOffsets& offsets, const immersed::NodeOffsets& node_offsets,
               double t);

  [[nodiscard]] const FlowState& state() const { return state_; }
  /// Velocity at the start of the accepted step; halos as they happen to be.
  [[nodiscard]] View3<const double> velocity_before() const { return views(u_before_); }
  [[nodiscard]] const immersed::CutLinks& links() const { return links_; }
  /// Null with the scheme "cut-link".
  [[nodiscard]] const immersed::WallNodes* wall_nodes() const { return wall_nodes_ ? &*wall_nodes_ : nullptr; }
  /// Parts of the fluid that sheets seal off from every outlet, and what leaks out of them.
  [[nodiscard]] const ComponentBalance& balance() const { return balance_; }
  [[nodiscard]] const grid::Grid& grid() const { return grid_; }
  [[nodiscard]] const FlowOptions& options() const { return options_; }
  /// Of the step's implicit stages together; the residual is the largest [L/T].  All zero with an explicit scheme.
  [[nodiscard]] const NewtonReport& newton() const { return newton_; }
  /// Time spent since the caller last reset it.
  [[nodiscard]] Profile& profile() const { return profile_; }
  /// Halos of velocity and pressure of the accepted state, as output and probes need them.
  void fill_halos();

  /// sum_d |U_d|/h_d of the accepted state [1/T].
  [[nodiscard]] double convective_rate() const;
  /// nu sum_d 1/h_d^2 of the finest cell [1/T].
  [[nodiscard]] double diffusive_rate() const { return diffusive_rate_; }

 private:
  void fill_velocity_halo(const View3<double>& u);
  void find_cut_links(const immersed::SheetMotion& predicted, double speed);
  void begin_explicit(std::span<const Stage> stages);
  void begin_implicit(std::span<const Stage> stages);
  void solve_stage(const Stage& stage);
  void freeze_pressure_part(const Stage& stage);
  void set_implicit_velocity();
  void find_recovered_part();
  void implicit_increment(const View3<double>& du);
  void set_body_velocity(const immersed::StageTime& time);
  void advance_stage(const Stage& stage, const Field3<double>& U);
  void add_cross_terms(const immersed::StageTime& time);
  void change_cross_terms_beside(const operators::StageWeights& weights);
  void add_varying_force(const operators::StageWeights& weights, double t);
  void replace_rates_of_cut_cells(const Stage& stage, const operators::StageWeights& weights);
  void freeze_pressure_push(const Stage& stage);
  void give_to_wall_nodes(const Stage& stage);
  void bind_to_walls(const Stage& stage, immersed::SheetVelocity velocity);
  [[nodiscard]] Vec3 momentum_beside_wall(std::size_t n, const Stage& stage, immersed::SheetVelocity velocity) const;
  void interpolate_increment();
  void prescribe_fluxes(const immersed::StageTime& time);
  void compute_fluxes(const immersed::StageTime& time);
  void predict_with_old_pressure(const immersed::StageTime& time);
  void guess_pressure(const View<const double>& before, double ahead);
  poisson::Report project_stage(double dt, double reduction);
  [[noreturn]] void fail_as_no_number() const;
  void recover(const immersed::StageTime& time);
  void repair_pressure();
  void update_load_fields();
  void find_face_accelerations();
  [[nodiscard]] double largest_speed() const;
  [[nodiscard]] double largest_flux_velocity() const;
  [[nodiscard]] immersed::LoadFields load_fields() const;
  [[nodiscard]] immersed::SheetLoads loads_of_pressure(const View<const double>& p) const;

  const grid::Grid& grid_;
  FlowOptions options_;
  BoundaryConditions boundary_;
  std::unique_ptr<poisson::PressureSolver> pressure_;
  HaloExchange halo_;
  double diffusive_rate_;
  immersed::CutLinks links_;
  std::optional<immersed::CrossTerms> cross_terms_;  ///< on curvilinear grids
  std::optional<immersed::WallNodes> wall_nodes_;    ///< of the scheme "curvib"
  ComponentBalance balance_;
  TimeStep step_;
  mutable Profile profile_;
  std::size_t sheet_vertices_ = 0;
  double speed_ = 0.0;     ///< scale of the velocity in this step [L/T]
  bool from_rest_ = true;  ///< nothing moved when this step began: the scale grows with its stages

  FlowState state_;
  Field3<double> u_before_;                ///< velocity at the start of the accepted step
  Field3<double> u_;                       ///< velocity of the latest stage
  Field3<double> U_;                       ///< fluxes of the latest stage
  Field<double> p_;                        ///< pressure of the latest stage
  bool trial_is_accepted_ = false;         ///< u_ and p_ are those of the accepted state
  Field<double> p_load_;                   ///< pressure extrapolated to t^{n+1}
  std::vector<double> repaired_pressure_;  ///< p^{n-1/2} of links_.flipped() on their new side; no number: not known
  Field3<double> increment_;               ///< du = u^ - u^n, u^ the pressure-free velocity
  Field3<double> rate_;                    ///< N of the stage before

  std::unique_ptr<NewtonKrylov> momentum_;  ///< of the implicit scheme; so are the next ones
  std::optional<operators::LineFactors> lines_;
  Field3<double> known_;      ///< part of du that earlier stages give
  Field3<double> unpushed_;   ///< u^n - c dt G p
  Field3<double> recovered_;  ///< e, see find_recovered_part()
  Stage implicit_stage_{};
  NewtonReport newton_;

  std::vector<immersed::CutCellTerms> terms_;  ///< of links_.cells()
  std::vector<Vec3> explicit_increment_;       ///< du of cut cells before the implicit wall terms of the stage
  std::vector<Vec3> pressure_push_;            ///< c dt G p of cut cells in the stage
  Field3<double> given_;                       ///< velocity of donors and wall nodes
  std::vector<std::array<double, 6>> face_acceleration_;  ///< of the fluid that passes the faces of links_.cells()
  std::vector<Vec3> u_star_;  ///< velocity of cut cells that the wall terms of the stage have seen
};

}  // namespace luff::fluid
