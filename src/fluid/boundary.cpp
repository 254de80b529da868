// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace luff::fluid {

namespace {

bool takes_velocity(SideKind kind)
{
  return kind == SideKind::Velocity || kind == SideKind::Wall;
}

}  // namespace

poisson::SideConditions pressure_conditions(const Boundaries& boundaries)
{
  poisson::SideConditions conditions{};
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      conditions[axis][end] = boundaries[axis][end].kind == SideKind::Outflow ? poisson::SideCondition::Dirichlet
                                                                              : poisson::SideCondition::Neumann;
  return conditions;
}

std::array<bool, 3> periodic_axes(const Boundaries& boundaries)
{
  std::array<bool, 3> periodic{};
  for (int axis = 0; axis < 3; ++axis)
    periodic[axis] = boundaries[axis][0].kind == SideKind::Periodic;
  return periodic;
}

BoundaryConditions::BoundaryConditions(const grid::Grid& grid, Boundaries boundaries)
    : grid_(grid), boundaries_(std::move(boundaries))
{
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      has_outflow_ = has_outflow_ || boundaries_[axis][end].kind == SideKind::Outflow;
      if (!grid.ranks().at_boundary(axis, end))
        continue;
      IndexBox cells = grid.owned();
      (end == 0 ? cells.hi[axis] : cells.lo[axis]) = end == 0 ? cells.lo[axis] + 1 : cells.hi[axis] - 1;
      sides_.push_back({.axis = axis, .end = end, .cells = cells, .velocity = {}});
      sides_.back().velocity.assign(cells.volume(), Vec3::Zero());
    }
}

/// visit(cell, n): the n-th owned cell beside a side.
template <class Visit>
void BoundaryConditions::for_each_side_cell(const Side& side, Visit visit) const
{
  std::size_t n = 0;
  for (int k = side.cells.lo[2]; k < side.cells.hi[2]; ++k)
    for (int j = side.cells.lo[1]; j < side.cells.hi[1]; ++j)
      for (int i = side.cells.lo[0]; i < side.cells.hi[0]; ++i)
        visit(Index3{i, j, k}, n++);
}

void BoundaryConditions::evaluate_at(double t)
{
  const auto varies = [](const auto& ends) {
    return std::any_of(ends.begin(), ends.end(), [](const SideBoundary& b) { return !b.velocity.constant; });
  };
  if (evaluated_ && std::none_of(boundaries_.begin(), boundaries_.end(), varies))
    return;
  evaluated_ = true;
  double largest = 0.0;
  for (Side& side : sides_) {
    if (!takes_velocity(boundary(side).kind))
      continue;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      Vec3 x = grid_.centre(c[0], c[1], c[2]);
      x[side.axis] = side.end == 0 ? grid_.face(side.axis, 0) : grid_.face(side.axis, grid_.cells()[side.axis]);
      side.velocity[n] = boundary(side).velocity.value(x, t);
      if (boundary(side).kind == SideKind::Wall)
        side.velocity[n][side.axis] = 0.0;
      largest = std::max(largest, side.velocity[n].norm());
    });
  }
  largest_speed_ = grid_.ranks().max(largest);
  if (!has_outflow_)
    balance_fluxes();
}

/// Without an outflow side the prescribed fluxes must add up to zero; sampling a divergence-free profile at face
/// centres leaves O(h^2), which is spread evenly over the velocity sides.
void BoundaryConditions::balance_fluxes()
{
  double net = 0.0;
  double gross = 0.0;
  double area = 0.0;
  for (const Side& side : sides_)
    if (prescribes_flow(side))
      for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
        const double A = grid_.area(side.axis, c[0], c[1], c[2]);
        net += A * side.outward() * side.velocity[n][side.axis];
        gross += A * std::abs(side.velocity[n][side.axis]);
        area += A;
      });
  net = grid_.ranks().sum(net);
  gross = grid_.ranks().sum(gross);
  area = grid_.ranks().sum(area);
  // Beyond a hundredth of the flow it is no sampling error but a case that forgot its outlet.
  if (std::abs(net) > 0.01 * gross)
    fail_input(
        "boundary: the prescribed velocities bring a net volume flux of {:.3g} into a domain without an outlet "
        "({:.3g} passes in all): make one side type = \"outflow\" or let inflow and outflow balance",
        -net, gross);
  if (area == 0.0)
    return;
  for (Side& side : sides_)
    if (prescribes_flow(side))
      for (Vec3& u : side.velocity)
        u[side.axis] -= side.outward() * net / area;
}

void BoundaryConditions::fill_velocity(const View3<double>& u, const View3<const double>& U) const
{
  for (const Side& side : sides_) {
    const SideKind kind = boundary(side).kind;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      const Index3 beyond = stepped(c, side.axis, side.end == 0 ? -1 : 1);
      const Index3 face = stepped(c, side.axis, side.end);
      const bool backflow = kind == SideKind::Outflow && side.outward() * U[side.axis](face) < 0.0;
      for (int d = 0; d < 3; ++d) {
        if (takes_velocity(kind))
          u[d](beyond) = 2.0 * side.velocity[n][d] - u[d](c);
        else if (kind == SideKind::Outflow)
          u[d](beyond) = backflow ? 0.0 : u[d](c);
        else
          u[d](beyond) = d == side.axis ? -u[d](c) : u[d](c);
      }
    });
  }
}

void BoundaryConditions::fill_pressure(const View<double>& p) const
{
  for (const Side& side : sides_) {
    const double sign = boundary(side).kind == SideKind::Outflow ? -1.0 : 1.0;
    for_each_side_cell(
        side, [&](const Index3& c, std::size_t) { p(stepped(c, side.axis, side.end == 0 ? -1 : 1)) = sign * p(c); });
  }
}

void BoundaryConditions::set_fluxes(const View3<const double>& u_old, const View3<const double>& increment,
                                    const View3<double>& U) const
{
  for (const Side& side : sides_) {
    const SideKind kind = boundary(side).kind;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      double u_n = 0.0;
      if (kind == SideKind::Velocity)
        u_n = side.velocity[n][side.axis];
      else if (kind == SideKind::Outflow)
        u_n = u_old[side.axis](c) + increment[side.axis](c);
      U[side.axis](stepped(c, side.axis, side.end)) = grid_.area(side.axis, c[0], c[1], c[2]) * u_n;
    });
  }
}

void BoundaryConditions::subtract_outflow_gradient(const View<const double>& p, double k, const View3<double>& U) const
{
  for (const Side& side : sides_) {
    if (boundary(side).kind != SideKind::Outflow)
      continue;
    for_each_side_cell(side, [&](const Index3& c, std::size_t) {
      const double slope = -p(c) / (0.5 * grid_.width(side.axis, c[side.axis]));  // outwards, to p = 0 on the face
      U[side.axis](stepped(c, side.axis, side.end)) -=
          k * side.outward() * grid_.area(side.axis, c[0], c[1], c[2]) * slope;
    });
  }
}

}  // namespace luff::fluid
