// SPDX-License-Identifier: BSD-3-Clause
// What the flow does to the surfaces in it and to the sides of the grid.
#include <algorithm>
#include <cmath>

#include "fluid/flow_solver.hpp"
#include "operators/vector_algebra.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

using immersed::SheetVelocity;

/// u with its halo, and p at t^{n+1} from the half levels, 3/2 p^{n+1/2} - 1/2 p^{n-1/2}, where the sheet swept over
/// the centre with the repaired p^{n-1/2}; p^{n+1/2} where only that is known.
void FlowSolver::update_load_fields()
{
  const auto timer = profile_.time(Phase::Loads);
  const double w = state_.steps > 1 ? 0.5 : 0.0;
  const auto p_load = p_load_.view();
  operators::extrapolate(grid_.owned(), p_.view(), state_.p.view(), w, p_load);
  for (std::size_t n = 0; n < repaired_pressure_.size(); ++n) {
    const Index3& c = links_.flipped()[n];
    const double before = repaired_pressure_[n];
    p_load(c) = p_.view()(c) + (std::isnan(before) ? 0.0 : w * (p_.view()(c) - before));
  }
  if (!wall_nodes_)
    find_face_accelerations();
  if (cross_terms_) {
    fill_velocity_halo(views(u_));
    cross_terms_->update(links_, views(std::as_const(u_)), {1.0, SheetVelocity::Current});
    halo_.exchange({p_load});
  } else {
    halo_.exchange({p_load, u_[0].view(), u_[1].view(), u_[2].view()});
  }
  boundary_.evaluate_pressure_at(step_.t_new);
  boundary_.fill_pressure(p_load);
}

/// (U^{n+1} - U^n)/(|S| dt) on the six faces of each cut cell.
void FlowSolver::find_face_accelerations()
{
  const std::vector<immersed::CutCell>& cells = links_.cells();
  face_acceleration_.resize(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n)
    for (int link = 0; link < 6; ++link) {
      const int axis = link / 2;
      const Index3 face = stepped(cells[n].cell, axis, link % 2);
      face_acceleration_[n][link] = (U_[axis].view()(face) - state_.U[axis].view()(face)) /
                                    (grid_.area(axis, face[0], face[1], face[2]) * step_.dt);
    }
}

immersed::LoadFields FlowSolver::load_fields() const
{
  return {.p = p_load_.view(),
          .u = views(u_),
          .u_star = std::span<const Vec3>(u_star_.data(), u_star_.size()),
          .acceleration = face_acceleration_,
          .density = options_.density,
          .viscosity = options_.viscosity,
          .cross = cross_terms_ ? &*cross_terms_ : nullptr};
}

immersed::SheetLoads FlowSolver::loads() const
{
  const auto timer = profile_.time(Phase::Loads);
  if (wall_nodes_)
    return immersed::loads_of_tractions(links_, tractions());
  return immersed::sheet_loads(grid_, links_, load_fields(), sheet_vertices_);
}

PressureLoads FlowSolver::pressure_loads() const
{
  const auto timer = profile_.time(Phase::Loads);
  return {.at_end = loads_of_pressure(p_load_.view()), .in_middle = loads_of_pressure(state_.p.view())};
}

immersed::SheetLoads FlowSolver::loads_of_pressure(const View<const double>& p) const
{
  immersed::LoadFields fields = load_fields();
  fields.p = p;
  if (!wall_nodes_) {
    fields.viscosity = 0.0;
    return immersed::sheet_loads(grid_, links_, fields, sheet_vertices_);
  }
  std::vector<immersed::SideTraction> tractions = immersed::node_tractions(grid_, links_, *wall_nodes_, fields);
  for (immersed::SideTraction& traction : tractions)
    traction.shear = {Vec3::Zero(), Vec3::Zero()};
  return immersed::loads_of_tractions(links_, tractions);
}

std::vector<immersed::SideTraction> FlowSolver::tractions() const
{
  const immersed::LoadFields fields = load_fields();
  if (wall_nodes_)
    return immersed::node_tractions(grid_, links_, *wall_nodes_, fields);
  return immersed::side_tractions(grid_, links_, fields, sheet_vertices_);
}

std::vector<SideStress> FlowSolver::side_stresses(bool walls_only) const
{
  std::vector<SideStress> sides =
      boundary_.stresses(views(state_.u), views(state_.U), state_.p.view(), options_.viscosity, walls_only);
  for (SideStress& side : sides) {
    for (Vec3& shear : side.shear)
      shear *= options_.density;
    for (double& p : side.pressure)
      p *= options_.density;
  }
  return sides;
}

IndexBox FlowSolver::cells_around(int first_triangle, int count, int margin) const
{
  Index3 lo = grid_.cells();
  Index3 hi{0, 0, 0};
  for (const immersed::CutFace& face : links_.faces()) {
    const int triangle = links_.crossings()[face.first].triangle;
    if (triangle < first_triangle || triangle >= first_triangle + count)
      continue;
    for (int d = 0; d < 3; ++d) {
      lo[d] = std::min(lo[d], face.cell[d] - (d == face.axis ? 1 : 0));
      hi[d] = std::max(hi[d], face.cell[d] + 1);
    }
  }
  for (int d = 0; d < 3; ++d) {
    lo[d] = std::max(0, -static_cast<int>(grid_.ranks().max(-lo[d])) - margin);
    hi[d] = std::min(grid_.cells()[d], static_cast<int>(grid_.ranks().max(hi[d])) + margin);
  }
  return {lo, hi};
}

FlowOverStep FlowSolver::accepted_step()
{
  const auto timer = profile_.time(Phase::Loads);
  fill_velocity_halo(views(u_before_));
  fill_halos();
  return {.u_old = views(std::as_const(u_before_)),
          .U_old = views(std::as_const(state_.U_before)),
          .u = views(std::as_const(state_.u)),
          .U = views(std::as_const(state_.U)),
          .p = state_.p.view(),
          .dt = step_.dt};
}

Vec3 FlowSolver::force_by_momentum(const FlowOverStep& accepted, const IndexBox& box) const
{
  const auto timer = profile_.time(Phase::Loads);
  Vec3 force = momentum_lost(grid_, box, accepted, options_.viscosity);
  const double t = 0.5 * (step_.t_old + step_.t_new);
  Vec3 body_force = Vec3::Zero();
  for_each_cell_in_order(intersection(box, grid_.owned()), [&](int i, int j, int k) {
    body_force += grid_.volume(i, j, k) * options_.acceleration.value(grid_.centre(i, j, k), t);
  });
  for (int d = 0; d < 3; ++d)
    force[d] += grid_.ranks().sum(body_force[d]);
  return options_.density * force;
}

}  // namespace luff::fluid
