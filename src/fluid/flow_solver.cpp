// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/flow_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "operators/vector_algebra.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

using immersed::SheetVelocity;
using immersed::StageTime;

namespace {

/// Root mean square residual of the implicit increments in parts of the speed, above their rounding by rates of a
/// diffusion number of one.
constexpr double momentum_tolerance = 1e-11;
constexpr double momentum_rounding = 1e-14;

/// What a prescribed pressure does to the cell beside it in a step leaves a round-off that no projection takes away:
/// this part of it counts as a speed.
constexpr double side_pressure_share = 0.05;

/// The pressures of the stages of a step of Wray's act over [t^n, t^n + c dt], c = 2/3 and 1, so their means belong to
/// t^n + dt/3 and t^n + dt/2, and the last one of the step before to t^n - dt/2.  From two of these the next:
constexpr double second_stage_ahead = 5.0 / 6.0;  ///< of p^{n-1/2} - p^{n-3/2}, for p_2
constexpr double third_stage_ahead = 1.0 / 5.0;   ///< of p_2 - p^{n-1/2}, for p_3

Vec3 constant_part(const VectorFunction& f)
{
  return f.constant ? f.value(Vec3::Zero(), 0.0) : Vec3::Zero();
}

}  // namespace

FlowSolver::FlowSolver(const grid::Grid& grid, FlowOptions options, Boundaries boundaries,
                       std::unique_ptr<poisson::PressureSolver> pressure)
    : grid_(grid),
      options_(std::move(options)),
      boundary_(grid, std::move(boundaries), options_.viscosity),
      pressure_(std::move(pressure)),
      halo_(grid.ranks()),
      diffusive_rate_(options_.viscosity * std::max(operators::diffusive_rate(grid), boundary_.diffusive_rate())),
      links_(grid),
      balance_(grid),
      state_{make_field3<double>(grid.owned()), make_field3<double>(grid.owned()), make_field3<double>(grid.owned()),
             Field<double>(grid.owned()), Field<double>(grid.owned())},
      u_before_(make_field3<double>(grid.owned())),
      u_(make_field3<double>(grid.owned())),
      U_(make_field3<double>(grid.owned())),
      p_(grid.owned()),
      p_load_(grid.owned()),
      increment_(make_field3<double>(grid.owned())),
      rate_(make_field3<double>(grid.owned()))
{
  if (grid.kind() == grid::Kind::Curvilinear)
    cross_terms_.emplace(grid);
  if (options_.edges_cover_in_part)
    links_.cover_in_part();
  if (options_.immersed == ImmersedScheme::Curvib) {
    wall_nodes_.emplace(grid);
    links_.hold_within_step();
    given_ = make_field3<double>(grid.owned());
  }
  if (options_.scheme == TimeScheme::NewtonKrylov) {
    for (Field3<double>* field : {&known_, &unpushed_, &recovered_})
      *field = make_field3<double>(grid.owned());
    lines_.emplace(grid, boundary_.holds_velocity());
    momentum_ = std::make_unique<NewtonKrylov>(
        grid, [this](const View3<double>& du) { implicit_increment(du); },
        [this](const View3<double>& r) { lines_->solve(r); });
  }
}

void FlowSolver::start(const VectorFunction& velocity, double t_0)
{
  step_ = {.t_old = t_0, .t_new = t_0, .dt = 1.0, .index = 0};
  const IndexBox& owned = grid_.owned();
  for (int axis = 0; axis < 3; ++axis)
    for_each_cell_in_order(owned.faces(axis), [U = U_[axis].view(), this, axis, &velocity, t_0](int i, int j, int k) {
      const Vec3 v = velocity.value(grid_.face_centre(axis, i, j, k), t_0);
      U(i, j, k) = grid_.area_vector(axis, i, j, k).dot(v);
    });
  for_each_cell_in_order(owned, [u = views(u_), this, &velocity, t_0](int i, int j, int k) {
    const Vec3 v = velocity.value(grid_.centre(i, j, k), t_0);
    for (int d = 0; d < 3; ++d)
      u[d](i, j, k) = v[d];
  });
  boundary_.evaluate_at(t_0);
  boundary_.evaluate_pressure_at(t_0);
  for (auto& du : increment_)
    du.fill(0.0);
  boundary_.set_fluxes(views(std::as_const(u_)), views(std::as_const(increment_)), views(U_));
  pressure_->set_blocked({});
  state_.u = u_;
  speed_ = largest_speed();
  from_rest_ = speed_ == 0.0;
  p_.fill(0.0);
  project_stage(1.0, 0.0);
  p_.fill(0.0);  // the potential that corrected the initial fluxes is no pressure
  operators::recover_velocity(grid_, views(std::as_const(U_)), views(u_));
  state_ = {u_, U_, U_, p_, p_, 0.0, 0};
  trial_is_accepted_ = true;
}

void FlowSolver::begin_step(const TimeStep& step, const immersed::SheetMotion& predicted)
{
  step_ = step;
  sheet_vertices_ = predicted.position.size();
  boundary_.evaluate_at(step.t_old);
  const double inflow = boundary_.largest_speed();
  const double own_speed = std::max(largest_speed(), inflow);
  find_cut_links(predicted, inflow > 0.0 ? inflow : own_speed);

  double sheet_speed = 0.0;
  for (const Vec3& v : predicted.velocity)
    sheet_speed = std::max(sheet_speed, v.norm());
  // The pressure has to take up what the forces of a step set in motion, in a fluid at rest too.
  speed_ = std::max({own_speed, sheet_speed, step.dt * constant_part(options_.acceleration).norm(),
                     step.dt * boundary_.largest_pressure() / grid_.smallest_width() * side_pressure_share});
  from_rest_ = own_speed == 0.0;
  if (!std::exchange(trial_is_accepted_, false)) {
    u_ = state_.u;
    p_ = state_.p;
  }
  repair_pressure();
  for (auto& du : increment_)
    du.fill(0.0);
  if (wall_nodes_) {
    fill_velocity_halo(views(u_));
    wall_nodes_->start_offsets(links_, views(std::as_const(u_)));
  }

  const std::span<const Stage> stages = stages_of(options_.scheme);
  if (options_.scheme == TimeScheme::NewtonKrylov)
    begin_implicit(stages);
  else
    begin_explicit(stages);
}

/// Wray's stages 1 and 2, and the rates of stage 3.
void FlowSolver::begin_explicit(std::span<const Stage> stages)
{
  freeze_pressure_push(stages[0]);
  advance_stage(stages[0], state_.U);
  bind_to_walls(stages[0], SheetVelocity::Predicted);
  predict_with_old_pressure({stages[0].end});
  recover({stages[0].end});

  freeze_pressure_push(stages[1]);
  advance_stage(stages[1], U_);
  bind_to_walls(stages[1], SheetVelocity::Predicted);
  compute_fluxes({stages[1].end});
  if (state_.steps > 1)
    guess_pressure(state_.p_before.view(), second_stage_ahead);
  project_stage(stages[1].end * step_.dt, options_.stage_reduction);
  recover({stages[1].end});

  freeze_pressure_push(stages[2]);
  advance_stage(stages[2], U_);
  if (state_.steps > 0)
    guess_pressure(state_.p.view(), third_stage_ahead);
}

/// Alexander's stage 1, and the increment of stage 2 with the predicted velocity of the sheets.
void FlowSolver::begin_implicit(std::span<const Stage> stages)
{
  newton_ = {};
  lines_->update(stages[0].new_rate * step_.dt, views(std::as_const(state_.U)), options_.viscosity);
  for (int d = 0; d < 3; ++d) {
    known_[d].fill(0.0);
    recovered_[d].fill(0.0);
  }
  solve_stage(stages[0]);
  find_recovered_part();
  solve_stage(stages[0]);
  find_recovered_part();
  compute_fluxes({stages[0].end});
  project_stage(stages[0].end * step_.dt, options_.stage_reduction);
  // gamma dt N_1 is the increment of stage 1 itself: its rate is never evaluated again, which is what damps stiff
  // modes.
  const double gamma = stages[0].new_rate;
  operators::set_multiple(grid_.owned(), (1.0 - gamma) / gamma, views(std::as_const(increment_)), views(known_));
  operators::set_multiple(grid_.owned(), 1.0 / gamma, views(std::as_const(increment_)), views(increment_));
  operators::set_multiple(grid_.owned(), 1.0 / gamma, views(std::as_const(recovered_)), views(recovered_));
  solve_stage(stages[1]);
}

/// Solves du = du_known + gamma dt N(u(du)), from the increment that is there.
void FlowSolver::solve_stage(const Stage& stage)
{
  implicit_stage_ = stage;
  freeze_pressure_push(stage);
  freeze_pressure_part(stage);
  const double tolerance = std::max(momentum_tolerance, momentum_rounding * step_.dt * diffusive_rate_);
  const NewtonReport report = momentum_->solve(views(increment_), tolerance * speed_);
  newton_.iterations += report.iterations;
  newton_.krylov_iterations += report.krylov_iterations;
  newton_.residual = std::max(newton_.residual, report.residual);
  if (!report.converged)
    fail_to_converge(
        "step {}, t = {:.6g}: the implicit momentum equation did not converge: residual {:.2e} at a speed of {:.3g} "
        "after {} Newton and {} Krylov iterations; a smaller time.step, or time.cfl, may help",
        step_.index, step_.t_new, report.residual, speed_, report.iterations, report.krylov_iterations);
  implicit_increment(views(increment_));  // the terms of cut cells, and du, at the solution
}

/// u^n - c dt G p at all centres, of the latest pressure, the gradient recovered from that at faces.
void FlowSolver::freeze_pressure_part(const Stage& stage)
{
  for (auto& U : U_)
    U.fill(0.0);
  pressure_->subtract_gradient(views(U_), p_.view(), stage.end * step_.dt);
  operators::recover_velocity(grid_, views(std::as_const(U_)), views(unpushed_));
  operators::add_multiple(grid_.owned(), 1.0, views(std::as_const(state_.u)), views(unpushed_));
}

/// u(du) = u^n + du - c dt G p + e at centres.
void FlowSolver::set_implicit_velocity()
{
  const auto du = views(std::as_const(increment_));
  operators::set_multiple(grid_.owned(), 1.0, du, views(u_));
  operators::add_multiple(grid_.owned(), 1.0, views(std::as_const(unpushed_)), views(u_));
  operators::add_multiple(grid_.owned(), 1.0, views(std::as_const(recovered_)), views(u_));
  for (std::size_t n = 0; n < links_.cells().size(); ++n) {
    const Index3& c = links_.cells()[n].cell;
    for (int d = 0; d < 3; ++d)
      u_[d].view()(c) = state_.u[d].view()(c) + du[d](c) - pressure_push_[n][d];
  }
  set_body_velocity({implicit_stage_.end});
}

/// e = rec(U*) - (u^n + du - c dt G p): what recovering the velocity from the fluxes changes.  It is a smoothing of du
/// along the axis of each component; taken from an earlier solution, it leaves the scheme second order in time without
/// standing in the way of the solution for du.
void FlowSolver::find_recovered_part()
{
  const StageTime end{implicit_stage_.end};
  predict_with_old_pressure(end);
  recover(end);
  operators::set_multiple(grid_.owned(), 1.0, views(std::as_const(u_)), views(recovered_));
  operators::add_multiple(grid_.owned(), -1.0, views(std::as_const(unpushed_)), views(recovered_));
  operators::add_multiple(grid_.owned(), -1.0, views(std::as_const(increment_)), views(recovered_));
}

/// T(du) = du_known + gamma dt N(u(du), U^n + A <du> - c dt G p).
void FlowSolver::implicit_increment(const View3<double>& du)
{
  operators::set_multiple(grid_.owned(), 1.0, {du[0], du[1], du[2]}, views(increment_));
  predict_with_old_pressure({implicit_stage_.end});
  set_implicit_velocity();
  increment_ = known_;
  advance_stage(implicit_stage_, U_);
  bind_to_walls(implicit_stage_, SheetVelocity::Predicted);
  operators::set_multiple(grid_.owned(), 1.0, views(std::as_const(increment_)), du);
}

poisson::Report FlowSolver::project(std::span<const Vec3> sheet_velocity)
{
  links_.set_velocity(sheet_velocity);
  const StageTime now{1.0, SheetVelocity::Current};
  bind_to_walls(stages_of(options_.scheme).back(), SheetVelocity::Current);
  compute_fluxes(now);
  const poisson::Report report = project_stage(step_.dt, 0.0);
  recover(now);
  update_load_fields();
  return report;
}

void FlowSolver::accept()
{
  links_.accept(views(std::as_const(U_)));
  if (wall_nodes_)
    wall_nodes_->accept(links_);
  std::swap(u_before_, state_.u);
  state_.u = u_;
  std::swap(state_.U_before, state_.U);
  std::swap(state_.U, U_);
  std::swap(state_.p_before, state_.p);
  state_.p = p_;
  state_.dt = step_.dt;
  ++state_.steps;
  trial_is_accepted_ = true;
}

void FlowSolver::restore(FlowState state, const immersed::FluxOffsets& offsets,
                         const immersed::NodeOffsets& node_offsets, double t)
{
  state_ = std::move(state);
  links_.restore(offsets);
  if (wall_nodes_)
    wall_nodes_->restore(node_offsets);
  boundary_.evaluate_at(t);
  u_ = state_.u;
  p_ = state_.p;
  trial_is_accepted_ = true;
}

void FlowSolver::find_cut_links(const immersed::SheetMotion& predicted, double speed)
{
  {
    const auto timer = profile_.time(Phase::Search);
    links_.freeze(predicted, step_.dt, speed,
                  {views(std::as_const(state_.U)), views(std::as_const(state_.U_before)), state_.dt});
    if (cross_terms_)
      cross_terms_->freeze(links_);
    if (wall_nodes_)
      wall_nodes_->freeze(links_);
  }
  const auto timer = profile_.time(Phase::Pressure);
  std::vector<poisson::FaceIndex> blocked;
  blocked.reserve(links_.faces().size());
  for (const immersed::CutFace& face : links_.faces())
    blocked.push_back({face.axis, face.cell, 1.0 - face.cover});
  pressure_->set_blocked(blocked);
  balance_.update(links_, *pressure_);
}

/// du <- du + dt (gamma N(u, U) + zeta N_old), in every cell; the wall terms of cut cells follow in bind_to_walls().
void FlowSolver::advance_stage(const Stage& stage, const Field3<double>& U)
{
  fill_velocity_halo(views(u_));
  const operators::StageWeights weights{step_.dt * stage.new_rate, step_.dt * stage.old_rate};
  // Cut cells are computed first, from the increments and rates that the sweep over all cells overwrites.
  if (!wall_nodes_)
    replace_rates_of_cut_cells(stage, weights);
  else if (cross_terms_)
    cross_terms_->update(links_, views(std::as_const(u_)), {stage.rate_time});
  const Vec3 force = constant_part(options_.acceleration);
  {
    const auto timer = profile_.time(Phase::Momentum);
    operators::advance_momentum(grid_, views(std::as_const(u_)), views(U), options_.viscosity, force, weights,
                                views(rate_), views(increment_));
    boundary_.add_wall_stress(views(std::as_const(u_)), views(U), options_.viscosity, weights.new_rate, views(rate_),
                              views(increment_));
    boundary_.add_entering_rate(views(std::as_const(u_)), views(U), weights.new_rate, views(rate_), views(increment_));
  }
  if (cross_terms_)
    change_cross_terms_beside(weights);
  if (!options_.acceleration.constant)
    add_varying_force(weights, step_.t_old + stage.rate_time * step_.dt);
  if (wall_nodes_) {
    give_to_wall_nodes(stage);
    return;
  }
  for (std::size_t n = 0; n < links_.cells().size(); ++n)
    for (int d = 0; d < 3; ++d)
      rate_[d].view()(links_.cells()[n].cell) = terms_[n].explicit_rate[d];
}

void FlowSolver::replace_rates_of_cut_cells(const Stage& stage, const operators::StageWeights& weights)
{
  const auto timer = profile_.time(Phase::CutCells);
  const std::vector<immersed::CutCell>& cells = links_.cells();
  terms_.resize(cells.size());
  explicit_increment_.resize(cells.size());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < cells.size(); ++n)
    terms_[n] = immersed::momentum_terms(links_, cells[n], views(std::as_const(u_)), options_.viscosity,
                                         {stage.rate_time}, {stage.end});
  if (cross_terms_)
    add_cross_terms({stage.rate_time});
  const double t = step_.t_old + stage.rate_time * step_.dt;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Index3& c = cells[n].cell;
    terms_[n].explicit_rate += options_.acceleration.value(grid_.centre(c[0], c[1], c[2]), t);
    for (int d = 0; d < 3; ++d)
      explicit_increment_[n][d] = increment_[d].view()(c) + weights.new_rate * terms_[n].explicit_rate[d] +
                                  weights.old_rate * rate_[d].view()(c);
  }
}

/// nu/V times the net cross fluxes of cut cells.
void FlowSolver::add_cross_terms(const StageTime& time)
{
  const auto u = views(std::as_const(u_));
  cross_terms_->update(links_, u, time);
  for (std::size_t n = 0; n < links_.cells().size(); ++n) {
    const auto [i, j, k] = links_.cells()[n].cell;
    terms_[n].explicit_rate +=
        options_.viscosity / grid_.volume(i, j, k) * cross_terms_->net_outflow(links_, links_.cells()[n], u);
  }
}

/// In the neighbours of cut cells: what their stencil has taken from across the sheet is replaced.
void FlowSolver::change_cross_terms_beside(const operators::StageWeights& weights)
{
  for (const Index3& c : cross_terms_->neighbours()) {
    const Vec3 change = options_.viscosity / grid_.volume(c[0], c[1], c[2]) * cross_terms_->change_in_neighbour(c);
    for (int d = 0; d < 3; ++d) {
      rate_[d].view()(c) += change[d];
      increment_[d].view()(c) += weights.new_rate * change[d];
    }
  }
}

void FlowSolver::add_varying_force(const operators::StageWeights& weights, double t)
{
  double largest = 0.0;
  for_each_cell_in_order(grid_.owned(), [&, N = views(rate_), du = views(increment_)](int i, int j, int k) {
    const Vec3 f = options_.acceleration.value(grid_.centre(i, j, k), t);
    largest = std::max(largest, f.norm());
    for (int d = 0; d < 3; ++d) {
      N[d](i, j, k) += f[d];
      du[d](i, j, k) += weights.new_rate * f[d];
    }
  });
  speed_ = std::max(speed_, step_.dt * grid_.ranks().max(largest));
}

/// c dt G p of the latest pressure in cut cells; frozen for the stage, so that coupling iterations see an affine map.
void FlowSolver::freeze_pressure_push(const Stage& stage)
{
  const auto timer = profile_.time(Phase::CutCells);
  const std::vector<immersed::CutCell>& cells = links_.cells();
  pressure_push_.resize(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n)
    pressure_push_[n] = stage.end * step_.dt * immersed::pressure_gradient(grid_, links_, cells[n], p_.view());
}

/// u^n + du - c dt G p of the latest pressure in the donors of wall nodes.
void FlowSolver::give_to_wall_nodes(const Stage& stage)
{
  for (const Index3& c : wall_nodes_->donors()) {
    const Vec3 push =
        stage.end * step_.dt * immersed::pressure_gradient(grid_, links_, immersed::uncut_cell(grid_, c), p_.view());
    for (int d = 0; d < 3; ++d)
      given_[d].view()(c) = state_.u[d].view()(c) + increment_[d].view()(c) - push[d];
  }
  fill_velocity_halo(views(given_));
}

/// u* = [u^n + du + delta dt sum v_k u_b - c dt G p]/(1 + delta dt sum v_k) of a cut cell.
Vec3 FlowSolver::momentum_beside_wall(std::size_t n, const Stage& stage, SheetVelocity velocity) const
{
  const double implicit = stage.wall * step_.dt;
  const immersed::CutCell& cut = links_.cells()[n];
  const Vec3 source = velocity == SheetVelocity::Current
                          ? immersed::wall_source(links_, cut, options_.viscosity, {stage.end, velocity})
                          : terms_[n].wall_source;
  const Vec3 u_old = at(views(state_.u), cut.cell);
  return (u_old + explicit_increment_[n] + implicit * source - pressure_push_[n]) /
         (1.0 + implicit * terms_[n].wall_rate);
}

/// u* of cut cells, by their momentum or along the normal of the sheet, and du = u* + c dt G p - u^n.
void FlowSolver::bind_to_walls(const Stage& stage, SheetVelocity velocity)
{
  const auto timer = profile_.time(Phase::CutCells);
  const std::vector<immersed::CutCell>& cells = links_.cells();
  u_star_.resize(cells.size());
  if (wall_nodes_)
    wall_nodes_->reconstruct(links_, {stage.end, velocity}, views(given_));
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Index3& c = cells[n].cell;
    u_star_[n] = wall_nodes_ ? at(views(std::as_const(given_)), c) : momentum_beside_wall(n, stage, velocity);
    for (int d = 0; d < 3; ++d)
      increment_[d].view()(c) = u_star_[n][d] + pressure_push_[n][d] - state_.u[d].view()(c);
  }
}

/// U^n + A <du> on all faces.
void FlowSolver::interpolate_increment()
{
  halo_.exchange(views(increment_));
  operators::interpolate_to_faces(grid_, views(std::as_const(state_.U)), views(std::as_const(increment_)), views(U_));
}

/// The fluxes that are prescribed, on the domain's sides and on cut faces; in all zero for each sealed component.
void FlowSolver::prescribe_fluxes(const StageTime& time)
{
  boundary_.evaluate_at(step_.t_old + time.fraction * step_.dt);
  // The pressure of a stage acts from the beginning of the step to the stage's end: its mean is that of the middle.
  boundary_.evaluate_pressure_at(step_.t_old + 0.5 * time.fraction * step_.dt);
  boundary_.fill_pressure(p_.view());
  const auto u_old = views(std::as_const(state_.u));
  const auto du = views(std::as_const(increment_));
  boundary_.set_fluxes(u_old, du, views(U_));
  if (grid_.kind() == grid::Kind::Curvilinear)
    boundary_.subtract_side_gradient(views(std::as_const(state_.U)), du, views(U_));
  links_.impose_fluxes(time, views(U_));
  balance_.apply(views(U_), step_);
}

/// U* of a stage on all faces.
void FlowSolver::compute_fluxes(const StageTime& time)
{
  const auto timer = profile_.time(Phase::Momentum);
  interpolate_increment();
  prescribe_fluxes(time);
}

/// Stage 1: U^1 = U* - c dt G p^n.  Wray's second weight of stage 1 is zero, so its O(dt^2) error does not matter.
void FlowSolver::predict_with_old_pressure(const StageTime& time)
{
  const auto timer = profile_.time(Phase::Momentum);
  interpolate_increment();
  prescribe_fluxes(time);
  pressure_->subtract_gradient(views(U_), p_.view(), time.fraction * step_.dt);
}

/// p <- p + ahead (p - p_before), not where the sheet swept over the centre: where the next projection starts from,
/// which changes nothing but how long it takes.
void FlowSolver::guess_pressure(const View<const double>& before, double ahead)
{
  const auto timer = profile_.time(Phase::Pressure);
  const auto p = p_.view();
  std::vector<double> kept;
  for (const Index3& c : links_.flipped())
    kept.push_back(p(c));
  operators::extrapolate(grid_.owned(), p, before, ahead, p);
  for (std::size_t n = 0; n < kept.size(); ++n)
    p(links_.flipped()[n]) = kept[n];
  boundary_.fill_pressure(p);
}

poisson::Report FlowSolver::project_stage(double dt, double reduction)
{
  const auto timer = profile_.time(Phase::Pressure);
  if (from_rest_)  // whatever this stage has set in motion; what was there before may be round-off of it
    speed_ = std::max(speed_, largest_flux_velocity());
  const poisson::Report report = pressure_->project(views(U_), p_.view(), dt,
                                                    {.relative = reduction,
                                                     .divergence = options_.divergence,
                                                     .speed = speed_ > 0.0 ? speed_ : 1.0,
                                                     .max_iterations = options_.max_iterations});
  if (!std::isfinite(report.divergence))
    fail_as_no_number();
  if (!report.converged) {
    const Vec3 worst = grid_.centre_of_any(report.worst_cell);
    fail_to_converge(
        "step {}, t = {:.6g}: the pressure did not converge: max |div U| h/|U| = {:.2e} after {} iterations, worst "
        "in cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}); a smaller time.step, or a finer grid where sheets come "
        "close to each other, may help",
        step_.index, step_.t_new, report.divergence, report.iterations, report.worst_cell[0], report.worst_cell[1],
        report.worst_cell[2], worst[0], worst[1], worst[2]);
  }
  boundary_.fill_pressure(p_.view());
  return report;
}

/// Names the first cell with a flux that is no number.
void FlowSolver::fail_as_no_number() const
{
  const Index3& n = grid_.cells();
  const double none = double(n[0]) * n[1] * n[2];
  double first = none;
  for (int axis = 0; axis < 3; ++axis)
    for_each_cell_in_order(grid_.owned(), [&, U = U_[axis].view()](int i, int j, int k) {
      const double number = i + double(n[0]) * (j + double(n[1]) * k);
      if (number < first && !(std::isfinite(U(i, j, k)) && std::isfinite(U(stepped({i, j, k}, axis, 1)))))
        first = number;
    });
  first = std::min(-grid_.ranks().max(-first), none - 1.0);
  const auto number = static_cast<long>(first);
  const Index3 c{static_cast<int>(number % n[0]), static_cast<int>(number / n[0] % n[1]),
                 static_cast<int>(number / n[0] / n[1])};
  const Vec3 x = grid_.centre_of_any(c);
  fail_run(
      "step {}, t = {:.6g}: the flow is no number any more, first in cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}): it "
      "diverged, or a formula of the case (boundary, body force) gave no number; a smaller time.step, or time.cfl, may "
      "help",
      step_.index, step_.t_new, c[0], c[1], c[2], x[0], x[1], x[2]);
}

void FlowSolver::recover(const StageTime& time)
{
  const auto timer = profile_.time(Phase::Momentum);
  operators::recover_velocity(grid_, views(std::as_const(U_)), views(u_));
  immersed::recover_velocity(grid_, links_, views(std::as_const(U_)), time, views(u_));
  set_body_velocity(time);
}

/// Inside closed bodies the velocity is the body's.
void FlowSolver::set_body_velocity(const StageTime& time)
{
  for (const auto& [cell, body] : links_.inside()) {
    const Vec3 u = links_.body_velocity(body, grid_.centre(cell[0], cell[1], cell[2]), time);
    for (int d = 0; d < 3; ++d)
      u_[d].view()(cell) = u[d];
  }
}

/// p^n; in cells that changed sides, the mean over neighbours on the new side.
void FlowSolver::repair_pressure()
{
  const auto timer = profile_.time(Phase::CutCells);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto p = p_.view();
  for (const Index3& c : links_.flipped())
    p(c) = unknown;
  halo_.exchange({p});
  boundary_.fill_pressure(p);  // a mirrored cell is as unknown as the cell itself
  repaired_pressure_.clear();
  for (const Index3& c : links_.flipped()) {
    double sum = 0.0;
    int known = 0;
    for (int link = 0; link < 6; ++link) {
      const int axis = link / 2;
      const Index3 beside = stepped(c, axis, link % 2 == 0 ? -1 : 1);
      if (links_.is_cut(axis, stepped(c, axis, link % 2)) || std::isnan(p(beside)))
        continue;
      sum += p(beside);
      ++known;
    }
    repaired_pressure_.push_back(known > 0 ? sum / known : unknown);
  }
  for (std::size_t n = 0; n < repaired_pressure_.size(); ++n) {
    const Index3& c = links_.flipped()[n];
    p(c) = std::isnan(repaired_pressure_[n]) ? state_.p.view()(c) : repaired_pressure_[n];
  }
  halo_.exchange({p});
  boundary_.fill_pressure(p);
}

double FlowSolver::largest_speed() const
{
  return operators::largest_speed(grid_, views(state_.u));
}

double FlowSolver::largest_flux_velocity() const
{
  return operators::convective_rate(grid_, views(U_)) * grid_.smallest_width();
}

/// The sides first: neighbours get theirs with the exchange.
void FlowSolver::fill_velocity_halo(const View3<double>& u)
{
  boundary_.fill_velocity(u);
  halo_.exchange(u);
  if (grid_.kind() == grid::Kind::Curvilinear)
    boundary_.extrapolate_edges(u);
}

void FlowSolver::fill_halos()
{
  fill_velocity_halo(views(state_.u));
  halo_.exchange({state_.p.view()});
  boundary_.fill_pressure(state_.p.view());
}

double FlowSolver::convective_rate() const
{
  return operators::convective_rate(grid_, views(state_.U));
}

}  // namespace luff::fluid
