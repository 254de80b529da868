// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/momentum_balance.hpp"

#include "fluid/gradient_flux.hpp"
#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

namespace {

/// Momentum through the low face of a cell along its axis, without pressure.
Vec3 transport(const grid::Grid& grid, const View3<const double>& u, const View3<const double>& U, double viscosity,
               int axis, const Index3& face)
{
  const Vec3 mean = 0.5 * (at(u, face) + at(u, stepped(face, axis, -1)));
  return U[axis](face) * mean - viscosity * gradient_flux(grid, u, axis, face);
}

/// Pressure at the low face of a cell, linear between the centres.
double face_pressure(const grid::Grid& grid, const View<const double>& p, int axis, const Index3& face)
{
  const Index3 below = stepped(face, axis, -1);
  const bool curvilinear = grid.kind() == grid::Kind::Curvilinear;
  const double above = curvilinear ? 0.5 : 0.5 * grid.width(axis, below[axis]) / grid.distance(axis, face[axis]);
  return above * p(face) + (1.0 - above) * p(below);
}

Vec3 outflow(const grid::Grid& grid, const IndexBox& box, const FlowOverStep& flow, double viscosity)
{
  Vec3 sum = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.ranks().periodic(axis) && box.extent(axis) == grid.cells()[axis])
      continue;
    for (int end = 0; end < 2; ++end)
      for_each_cell_in_order(side_faces(grid, box, axis, end), [&](int i, int j, int k) {
        const Index3 face{i, j, k};
        const Vec3 through = 0.5 * (transport(grid, flow.u_old, flow.U_old, viscosity, axis, face) +
                                    transport(grid, flow.u, flow.U, viscosity, axis, face)) +
                             face_pressure(grid, flow.p, axis, face) * grid.area_vector(axis, i, j, k);
        sum += (end == 0 ? -1.0 : 1.0) * through;
      });
  }
  return sum;
}

}  // namespace

IndexBox side_faces(const grid::Grid& grid, const IndexBox& box, int axis, int end)
{
  IndexBox inside = box;
  if (end == 0)
    inside.hi[axis] = inside.lo[axis] + 1;
  else
    inside.lo[axis] = inside.hi[axis] - 1;
  IndexBox faces = intersection(inside, grid.owned());
  faces.lo[axis] += end;
  faces.hi[axis] += end;
  return faces;
}

Vec3 momentum_lost(const grid::Grid& grid, const IndexBox& box, const FlowOverStep& flow, double viscosity)
{
  Vec3 gained = Vec3::Zero();
  for_each_cell_in_order(intersection(box, grid.owned()), [&](int i, int j, int k) {
    gained += grid.volume(i, j, k) * (at(flow.u, {i, j, k}) - at(flow.u_old, {i, j, k}));
  });
  const Vec3 lost = -gained / flow.dt - outflow(grid, box, flow, viscosity);
  return {grid.ranks().sum(lost[0]), grid.ranks().sum(lost[1]), grid.ranks().sum(lost[2])};
}

}  // namespace luff::fluid
