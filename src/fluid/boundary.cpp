// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

namespace {

/// As a case file says, on boxes and on curvilinear grids.
const char* side_name(const grid::Grid& grid, int axis, int end)
{
  static constexpr std::array<const char*, 6> box{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  static constexpr std::array<const char*, 6> body_fitted{"xi_min",  "xi_max",   "eta_min",
                                                          "eta_max", "zeta_min", "zeta_max"};
  return (grid.kind() == grid::Kind::Curvilinear ? body_fitted : box)[2 * axis + end];
}

bool takes_velocity(SideKind kind)
{
  return kind == SideKind::Velocity || kind == SideKind::Wall;
}

bool is_open(SideKind kind)
{
  return kind == SideKind::Outflow || kind == SideKind::Pressure;
}

}  // namespace

poisson::SideConditions pressure_conditions(const Boundaries& boundaries)
{
  poisson::SideConditions conditions{};
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      conditions[axis][end] =
          is_open(boundaries[axis][end].kind) ? poisson::SideCondition::Dirichlet : poisson::SideCondition::Neumann;
  return conditions;
}

std::array<bool, 3> periodic_axes(const Boundaries& boundaries)
{
  std::array<bool, 3> periodic{};
  for (int axis = 0; axis < 3; ++axis)
    periodic[axis] = boundaries[axis][0].kind == SideKind::Periodic;
  return periodic;
}

BoundaryConditions::BoundaryConditions(const grid::Grid& grid, Boundaries boundaries, double viscosity)
    : grid_(grid), boundaries_(std::move(boundaries)), halo_(grid.ranks())
{
  if (grid.kind() == grid::Kind::Curvilinear)
    side_gradient_ = make_field3<double>(grid.owned());
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      is_open_ = is_open_ || is_open(boundaries_[axis][end].kind);
      if (boundaries_[axis][end].flow_rate)
        add_inflow(axis, end, viscosity);
      if (grid.ranks().at_boundary(axis, end))
        add_side(axis, end);
    }
}

void BoundaryConditions::add_side(int axis, int end)
{
  IndexBox cells = grid_.owned();
  (end == 0 ? cells.hi[axis] : cells.lo[axis]) = end == 0 ? cells.lo[axis] + 1 : cells.hi[axis] - 1;
  Side side;
  side.axis = axis;
  side.end = end;
  side.cells = cells;
  side.velocity.assign(cells.volume(), Vec3::Zero());
  side.pressure.assign(cells.volume(), 0.0);
  const std::array<int, 2> others{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
  const int row = grid_.cells()[others[0]];
  for_each_side_cell(side, [&](const Index3& c, std::size_t) {
    const auto [i, j, k] = side.face(c);
    const Vec3 S = grid_.area_vector(axis, i, j, k);
    side.faces.push_back(
        {.place = grid_.face_centre(axis, i, j, k), .area = S, .normal = side.outward() * S.normalized()});
    side.section.push_back(c[others[0]] + static_cast<std::size_t>(row) * c[others[1]]);
  });
  if (takes_velocity(boundary(side).kind))
    side.gradient.emplace(grid_, axis, end, cells);
  sides_.push_back(std::move(side));
}

void BoundaryConditions::add_inflow(int axis, int end, double viscosity)
{
  std::array<std::array<bool, 2>, 2> no_slip{};
  const std::array<int, 2> others{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
  for (int a = 0; a < 2; ++a)
    for (int e = 0; e < 2; ++e)
      no_slip[a][e] = boundaries_[others[a]][e].kind == SideKind::Wall;
  const Section section(grid_, axis, end, no_slip);
  try {
    inflow_[axis][end].emplace(section, *boundaries_[axis][end].flow_rate, viscosity);
  } catch (const InputError& error) {
    fail_input("boundary.{}.flow_rate: {}", side_name(grid_, axis, end), error.what());
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
  const auto varies = [](const SideBoundary& b) { return b.flow_rate ? !b.flow_rate->constant : !b.velocity.constant; };
  if (evaluated_ && std::none_of(boundaries_.begin(), boundaries_.end(),
                                 [&](const auto& ends) { return varies(ends[0]) || varies(ends[1]); }))
    return;
  evaluated_ = true;
  double largest = 0.0;
  for (Side& side : sides_) {
    if (!takes_velocity(boundary(side).kind))
      continue;
    evaluate_velocity(side, t);
    for (const Vec3& u : side.velocity)
      largest = std::max(largest, u.norm());
  }
  largest_speed_ = grid_.ranks().max(largest);
  if (!is_open_)
    balance_fluxes();
}

void BoundaryConditions::evaluate_velocity(Side& side, double t) const
{
  if (const std::optional<InflowProfile>& profile = inflow(side)) {
    const std::vector<double> w = profile->velocities(t);
    for (std::size_t n = 0; n < side.faces.size(); ++n)
      side.velocity[n] = -w[side.section[n]] * side.faces[n].normal;
    return;
  }
  for (std::size_t n = 0; n < side.faces.size(); ++n) {
    const Face& face = side.faces[n];
    Vec3& u = side.velocity[n];
    u = boundary(side).velocity.value(face.place, t);
    if (boundary(side).kind == SideKind::Wall)
      u -= u.dot(face.normal) * face.normal;
  }
}

void BoundaryConditions::evaluate_pressure_at(double t)
{
  for (Side& side : sides_)
    if (boundary(side).kind == SideKind::Pressure)
      for (std::size_t n = 0; n < side.faces.size(); ++n)
        side.pressure[n] = boundary(side).pressure.value(side.faces[n].place, t);
}

std::array<std::array<bool, 2>, 3> BoundaryConditions::holds_velocity() const
{
  std::array<std::array<bool, 2>, 3> holds{};
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      holds[a][end] = boundaries_[a][end].kind == SideKind::Velocity || boundaries_[a][end].kind == SideKind::Wall;
  return holds;
}

double BoundaryConditions::largest_pressure() const
{
  double largest = 0.0;
  for (const Side& side : sides_)
    for (const double p : side.pressure)
      largest = std::max(largest, std::abs(p));
  return grid_.ranks().max(largest);
}

/// Whether a correction of the fluxes may be spread over the side: a flow rate is kept to the last digit.
bool BoundaryConditions::enters_freely(const Side& side) const
{
  return boundary(side).kind == SideKind::Velocity && !inflow(side);
}

/// Without an open side the prescribed fluxes must add up to zero; sampling a divergence-free profile at face centres
/// leaves O(h^2), which is spread evenly over the sides with a prescribed velocity.
void BoundaryConditions::balance_fluxes()
{
  double net = 0.0;
  double gross = 0.0;
  double area = 0.0;
  for (const Side& side : sides_)
    if (boundary(side).kind == SideKind::Velocity)
      for (std::size_t n = 0; n < side.faces.size(); ++n) {
        const double U = side.faces[n].area.dot(side.velocity[n]);
        net += side.outward() * U;
        gross += std::abs(U);
        if (enters_freely(side))
          area += side.faces[n].area.norm();
      }
  net = grid_.ranks().sum(net);
  gross = grid_.ranks().sum(gross);
  area = grid_.ranks().sum(area);
  // Beyond a hundredth of the flow it is no sampling error but a case that forgot its outlet; flow rates alone have
  // nothing but round-off.
  const double tolerance = area > 0.0 ? 0.01 : 1e-12;
  if (std::abs(net) > tolerance * gross)
    fail_input(
        "boundary: the prescribed velocities bring a net volume flux of {:.3g} into a domain without an outlet "
        "({:.3g} passes in all): make one side type = \"outflow\" or let inflow and outflow balance",
        -net, gross);
  if (area == 0.0)
    return;
  for (Side& side : sides_)
    if (enters_freely(side))
      for (std::size_t n = 0; n < side.faces.size(); ++n)
        side.velocity[n] -= net / area * side.faces[n].normal;
}

void BoundaryConditions::fill_velocity(const View3<double>& u) const
{
  for (const Side& side : sides_) {
    const SideKind kind = boundary(side).kind;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      const Vec3 here = at(u, c);
      Vec3 beyond = here;
      if (takes_velocity(kind))
        beyond = 2.0 * side.velocity[n] - here;
      else if (!is_open(kind))
        beyond -= 2.0 * here.dot(side.faces[n].normal) * side.faces[n].normal;
      for (int d = 0; d < 3; ++d)
        u[d](side.beyond(c)) = beyond[d];
    });
  }
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

void BoundaryConditions::add_entering_rate(const View3<const double>& u, const View3<const double>& U, double weight,
                                           const View3<double>& rate, const View3<double>& increment) const
{
  for (const Side& side : sides_) {
    if (!is_open(boundary(side).kind) || boundary(side).entering == Entering::Developed)
      continue;
    for_each_side_cell(side, [&](const Index3& c, std::size_t) {
      const double outflow = side.outward() * U[side.axis](side.face(c));
      const double share = 0.5 * std::min(outflow, 0.0) / grid_.volume(c[0], c[1], c[2]);
      for (int d = 0; d < 3; ++d) {
        const double change = share * u[d](c);
        rate[d](c) += change;
        increment[d](c) += weight * change;
      }
    });
  }
}

void BoundaryConditions::add_wall_stress(const View3<const double>& u, const View3<const double>& U, double viscosity,
                                         double weight, const View3<double>& rate, const View3<double>& increment) const
{
  for (const Side& side : sides_) {
    if (!side.gradient)
      continue;
    const SideGradient::Prescribed u_b = side.gradient->prescribed(u);
    for_each_row(side.cells, [&](int from, int to, int j, int k) {
      for (int i = from; i < to; ++i) {
        const Index3 c{i, j, k};
        const Vec3 change = viscosity / grid_.volume(i, j, k) * side.gradient->missing_flux(u, U, u_b, c);
        for (int d = 0; d < 3; ++d) {
          rate[d](c) += change[d];
          increment[d](c) += weight * change[d];
        }
      }
    });
  }
}

double BoundaryConditions::diffusive_rate(int axis, const Index3& c) const
{
  const double within = grid_.visit([&](const auto& m) {
    const auto [i, j, k] = c;
    if constexpr (grid::is_curvilinear<std::remove_cvref_t<decltype(m)>>)
      return m.G[axis](c);
    else
      return grid_.volume(i, j, k) / (grid_.width(axis, c[axis]) * grid_.width(axis, c[axis]));
  });
  int sides = 0;
  double through_sides = 0.0;
  for (const Side& side : sides_)
    if (side.axis == axis && side.gradient && side.cells.contains(c)) {
      ++sides;
      through_sides += side.gradient->conductance(c);
    }
  return sides == 0 ? within : 0.25 * (through_sides + (2 - sides) * within);
}

double BoundaryConditions::diffusive_rate() const
{
  double largest = 0.0;
  for (const Side& side : sides_) {
    if (!side.gradient)
      continue;
    for_each_side_cell(side, [&](const Index3& c, std::size_t) {
      double sum = 0.0;
      for (int axis = 0; axis < 3; ++axis)
        sum += diffusive_rate(axis, c);
      largest = std::max(largest, sum / grid_.volume(c[0], c[1], c[2]));
    });
  }
  return grid_.ranks().max(largest);
}

std::vector<SideStress> BoundaryConditions::stresses(const View3<const double>& u, const View3<const double>& U,
                                                     const View<const double>& p, double viscosity,
                                                     bool walls_only) const
{
  std::vector<SideStress> all;
  for (const Side& side : sides_) {
    if (!side.gradient || (walls_only && boundary(side).kind != SideKind::Wall))
      continue;
    SideStress stress{.axis = side.axis, .end = side.end, .cells = side.cells, .shear = {}, .pressure = {}};
    const SideGradient::Prescribed u_b = side.gradient->prescribed(u);
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      const Mat3 G = side.gradient->at(u, U, u_b, c);
      const Vec3 normal = -side.faces[n].normal;
      const Vec3 viscous = viscosity * (G + G.transpose()) * normal;
      stress.shear.push_back(viscous - viscous.dot(normal) * normal);
      stress.pressure.push_back(side.gradient->extrapolated(p, c));
    });
    all.push_back(std::move(stress));
  }
  return all;
}

void BoundaryConditions::fill_pressure(const View<double>& p) const
{
  for (const Side& side : sides_) {
    const bool open = is_open(boundary(side).kind);
    for_each_side_cell(
        side, [&](const Index3& c, std::size_t n) { p(side.beyond(c)) = open ? 2.0 * side.pressure[n] - p(c) : p(c); });
  }
}

void BoundaryConditions::set_fluxes(const View3<const double>& u_old, const View3<const double>& increment,
                                    const View3<double>& U) const
{
  for (const Side& side : sides_) {
    const SideKind kind = boundary(side).kind;
    for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
      const Vec3& S = side.faces[n].area;
      double flux = 0.0;
      if (kind == SideKind::Velocity)
        flux = S.dot(side.velocity[n]);
      else if (is_open(kind))
        flux = S.dot(at(u_old, c) + at(increment, c));
      U[side.axis](side.face(c)) = flux;
    });
  }
}

void BoundaryConditions::subtract_side_gradient(const View3<const double>& U_old, const View3<const double>& increment,
                                                const View3<double>& U)
{
  const auto leaves_pressure_free = [&](const Side& side) { return !is_open(boundary(side).kind); };
  const View3<double> g = views(side_gradient_);
  for (const Side& side : sides_)
    for_each_side_cell(side, [&](const Index3& c, std::size_t) { g[side.axis](c) = 0.0; });
  for (const Side& side : sides_)
    if (leaves_pressure_free(side))
      for_each_side_cell(side, [&](const Index3& c, std::size_t n) {
        const Index3 face = side.face(c);
        g[side.axis](c) += U_old[side.axis](face) + side.faces[n].area.dot(at(increment, c)) - U[side.axis](face);
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
  // A cell between two sides holds the sum of both: each takes half.
  const double share = grid_.cells()[b] == 1 ? 0.125 : 0.25;
  grid_.visit([&](const auto& m) {
    if constexpr (grid::is_curvilinear<std::remove_cvref_t<decltype(m)>>)
      for (int t = 0; t < 3; ++t)
        for (int end = 0; end < 2 && t != b; ++end) {
          const Index3 to_face = stepped({0, 0, 0}, t, end);
          for_each_row(cells_with_free_face(side, t, end),
                       [=, g = side_gradient_[b].view(), G_bb = m.G[b], U_t = U[t],
                        G_tb = m.G[grid::symmetric(std::min(t, b), std::max(t, b))]](int from, int to, int j, int k) {
                         for (int i = from; i < to; ++i)
                           U_t(i + to_face[0], j + to_face[1], k + to_face[2]) -=
                               share * G_tb(i, j, k) / G_bb(i, j, k) * g(i, j, k);
                       });
        }
  });
}

/// The cells beside a side, also those of neighbours, whose low or high face along t is one of this rank's and lies in
/// no side.
IndexBox BoundaryConditions::cells_with_free_face(const Side& side, int t, int end) const
{
  IndexBox cells = side.cells;
  cells.lo[t] = grid_.owned().lo[t] + (grid_.ranks().at_boundary(t, 0) ? 1 : 0) - end;
  cells.hi[t] = grid_.owned().hi[t] + (grid_.ranks().at_boundary(t, 1) ? 0 : 1) - end;
  return cells;
}

}  // namespace luff::fluid
