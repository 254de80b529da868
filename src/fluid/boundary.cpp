// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

namespace {

bool takes_velocity(SideKind kind)
{
  return kind == SideKind::Velocity || kind == SideKind::Wall;
}

/// The part of u along a face of area vector S.
Vec3 tangential(const Vec3& u, const Vec3& S)
{
  return u - S * (S.dot(u) / S.squaredNorm());
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
    : grid_(grid), boundaries_(std::move(boundaries)), halo_(grid.ranks())
{
  if (grid.kind() == grid::Kind::Curvilinear)
    side_gradient_ = make_field3<double>(grid.owned());
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

Vec3 BoundaryConditions::area_vector(const Side& side, const Index3& c) const
{
  const auto [i, j, k] = side.face(c);
  return grid_.area_vector(side.axis, i, j, k);
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
      const auto [i, j, k] = side.face(c);
      side.velocity[n] = boundary(side).velocity.value(grid_.face_centre(side.axis, i, j, k), t);
      if (boundary(side).kind == SideKind::Wall)
        side.velocity[n] = tangential(side.velocity[n], area_vector(side, c));
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
        const Vec3 S = area_vector(side, c);
        const double flux = S.dot(side.velocity[n]);
        net += side.outward() * flux;
        gross += std::abs(flux);
        area += S.norm();
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
      for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
        side.velocity[n] -= side.outward() * net / area * area_vector(side, c).normalized();
      });
}

Vec3 BoundaryConditions::velocity_beyond(const Side& side, const Index3& c, const Vec3& inside, const Vec3& prescribed,
                                         bool backflow) const
{
  switch (boundary(side).kind) {
    case SideKind::Velocity:
    case SideKind::Wall:
      return 2.0 * prescribed - inside;
    case SideKind::Outflow:
      return backflow ? Vec3(Vec3::Zero()) : inside;
    default:
      return 2.0 * tangential(inside, area_vector(side, c)) - inside;
  }
}

void BoundaryConditions::fill_velocity(const View3<double>& u, const View3<const double>& U) const
{
  for (const Side& side : sides_)
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      const bool backflow = side.outward() * U[side.axis](side.face(c)) < 0.0;
      const Vec3 value = velocity_beyond(side, c, at(u, c), side.velocity[n], backflow);
      for (int d = 0; d < 3; ++d)
        u[d](side.beyond(c)) = value[d];
    });
}

void BoundaryConditions::extrapolate_edges(const View3<double>& u) const
{
  for (const Side& side : sides_)
    for (const Side& other : sides_) {
      if (other.axis <= side.axis)
        continue;
      for_each_cell_in_order(intersection(side.cells, other.cells), [&](int i, int j, int k) {
        const Index3 c{i, j, k};
        for (const View<double>& v : u)
          v(other.beyond(side.beyond(c))) = v(side.beyond(c)) + v(other.beyond(c)) - v(c);
      });
    }
}

void BoundaryConditions::fill_pressure(const View<double>& p) const
{
  for (const Side& side : sides_) {
    const double sign = boundary(side).kind == SideKind::Outflow ? -1.0 : 1.0;
    for_each_side_cell(side, [&](const Index3& c, std::size_t) { p(side.beyond(c)) = sign * p(c); });
  }
}

void BoundaryConditions::set_fluxes(const View3<const double>& u_old, const View3<const double>& increment,
                                    const View3<double>& U) const
{
  for (const Side& side : sides_) {
    const SideKind kind = boundary(side).kind;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      Vec3 u = Vec3::Zero();
      if (kind == SideKind::Velocity)
        u = side.velocity[n];
      else if (kind == SideKind::Outflow)
        u = at(u_old, c) + at(increment, c);
      U[side.axis](side.face(c)) = area_vector(side, c).dot(u);
    });
  }
}

void BoundaryConditions::subtract_side_gradient(const View3<const double>& U_old, const View3<const double>& increment,
                                                const View3<double>& U)
{
  const auto leaves_pressure_free = [&](const Side& side) { return boundary(side).kind != SideKind::Outflow; };
  const View3<double> g = views(side_gradient_);
  for (const Side& side : sides_)
    for_each_side_cell(side, [&](const Index3& c, std::size_t) { g[side.axis](c) = 0.0; });
  for (const Side& side : sides_)
    if (leaves_pressure_free(side))
      for_each_side_cell(side, [&](const Index3& c, std::size_t) {
        const Index3 face = side.face(c);
        g[side.axis](c) += U_old[side.axis](face) + area_vector(side, c).dot(at(increment, c)) - U[side.axis](face);
      });
  halo_.exchange(g);
  for (const Side& side : sides_)
    if (leaves_pressure_free(side))
      subtract_side_gradient(side, U);
}

/// The cells beside a side, those of neighbours too: the face between two cells takes a part from each.
void BoundaryConditions::subtract_side_gradient(const Side& side, const View3<double>& U) const
{
  const int b = side.axis;
  const Index3& n = grid_.cells();
  IndexBox cells = side.cells;
  for (int t = 0; t < 3; ++t)
    if (t != b) {
      cells.lo[t] -= grid_.ranks().at_boundary(t, 0) ? 0 : 1;
      cells.hi[t] += grid_.ranks().at_boundary(t, 1) ? 0 : 1;
    }
  // A cell between two sides holds the sum of both: each takes half.
  const double share = n[b] == 1 ? 0.125 : 0.25;
  grid_.visit([&](const auto& m) {
    if constexpr (grid::is_curvilinear<std::remove_cvref_t<decltype(m)>>)
      for_each_cell_in_order(cells, [&, g = side_gradient_[b].view()](int i, int j, int k) {
        const Index3 c{i, j, k};
        for (int t = 0; t < 3; ++t) {
          if (t == b)
            continue;
          const double part = share * m.G[grid::symmetric(std::min(t, b), std::max(t, b))](c) / m.G[b](c) * g(c);
          for (int end = 0; end < 2; ++end)
            if (const Index3 face = stepped(c, t, end); !prescribed(t, face))
              U[t](face) -= part;
        }
      });
  });
}

/// Whether a face is none of this rank's cells, or lies on a side.
bool BoundaryConditions::prescribed(int axis, const Index3& face) const
{
  return !grid_.owned().faces(axis).contains(face) ||
         (!grid_.ranks().periodic(axis) && (face[axis] == 0 || face[axis] == grid_.cells()[axis]));
}

}  // namespace luff::fluid
