// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/flow_energy.hpp"

#include <algorithm>

#include "fluid/gradient_flux.hpp"
#include "immersed/cell_metric.hpp"
#include "immersed/cut_axis.hpp"
#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

namespace {

/// What sums over faces need.
struct Fields {
  const FlowSolver& flow;
  const grid::Grid& grid;
  View3<const double> u;
  View3<const double> U;
};

/// Whether the low face of an owned cell lies on a side of the domain.
bool on_low_side(const grid::Grid& grid, int axis, const Index3& face)
{
  return !grid.ranks().periodic(axis) && face[axis] == 0;
}

/// nu c A |u - u_b|^2/h_k, c the part that is covered, of both cells beside a cut face, those of the fluid.
double cut_dissipation(const Fields& f, const immersed::CutFace& face)
{
  const immersed::CutLinks& links = f.flow.links();
  const double area = face.cover * f.grid.area(face.axis, face.cell[0], face.cell[1], face.cell[2]);
  const double length = immersed::distance_across(f.grid, face.axis, face.cell);
  const immersed::StageTime now{1.0, immersed::SheetVelocity::Current};
  double sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int hit = side == 0 ? face.first : face.last;
    if (links.looks_inside(hit, side))
      continue;
    const double theta = links.crossings()[hit].theta;
    const double distance = length * std::max(side == 0 ? theta : 1.0 - theta, immersed::least_theta(face));
    const Vec3 u = at(f.u, side == 0 ? stepped(face.cell, face.axis, -1) : face.cell);
    sum += area / distance * (u - links.velocity(hit, now)).squaredNorm();
  }
  return f.flow.options().viscosity * sum;
}

/// sum_f F_f . (u_N - u_P) over the low faces of owned cells that no side holds, of each the part that no surface
/// covers.
double open_dissipation(const Fields& f)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    for_each_cell_in_order(f.grid.owned(), [&](int i, int j, int k) {
      const Index3 c{i, j, k};
      const double open = 1.0 - f.flow.links().cover(axis, c);
      if (on_low_side(f.grid, axis, c) || f.flow.links().is_inside(c) || open == 0.0)
        return;
      sum += open * gradient_flux(f.grid, f.u, axis, c).dot(at(f.u, c) - at(f.u, stepped(c, axis, -1)));
    });
  return f.flow.options().viscosity * sum;
}

/// Cut faces of the faces that this rank's cells are above, so that each is counted once.
double dissipation_beside_surfaces(const Fields& f)
{
  double sum = 0.0;
  for (const immersed::CutFace& face : f.flow.links().faces())
    if (f.grid.owned().contains(face.cell))
      sum += cut_dissipation(f, face);
  return sum;
}

/// Power through the sides, and the half of the dissipation that belongs to their faces.
struct SidePower {
  double power = 0.0;
  double dissipation = 0.0;
};

SidePower power_of_side(const Fields& f, int axis, int end)
{
  const View<const double> p = f.flow.state().p.view();
  const View<const double> p_before = f.flow.state().p_before.view();
  const double outwards = end == 0 ? -1.0 : 1.0;
  SidePower sum;
  for_each_cell_in_order(side_faces(f.grid, f.grid.owned(), axis, end), [&](int i, int j, int k) {
    const Index3 face{i, j, k};
    const Index3 below = stepped(face, axis, -1);
    const Index3 inside = end == 0 ? face : below;
    if (f.flow.links().is_inside(inside))
      return;
    const Vec3 u_N = at(f.u, face);
    const Vec3 u_P = at(f.u, below);
    const Vec3 flux = f.flow.options().viscosity * gradient_flux(f.grid, f.u, axis, face);
    const double p_here = 0.5 * (p(face) + p(below)) + 0.5 * (p(inside) - p_before(inside));
    const double carried = f.U[axis](face) * (0.5 * u_P.dot(u_N) + p_here);
    sum.power += outwards * (0.5 * flux.dot(u_P + u_N) - carried);
    sum.dissipation += 0.5 * flux.dot(u_N - u_P);
  });
  return sum;
}

/// Where the velocity is prescribed, tangential friction and pressure of second order instead of the stencil's.
double correction_on_prescribed_sides(const Fields& f)
{
  const View<const double> p = f.flow.state().p.view();
  double sum = 0.0;
  for (const SideStress& side : f.flow.side_stresses(/*walls_only=*/false)) {
    std::size_t n = 0;
    const double outwards = side.end == 0 ? -1.0 : 1.0;
    for_each_cell_in_order(side.cells, [&](int i, int j, int k) {
      const Index3 face = stepped({i, j, k}, side.axis, side.end);
      const Vec3 S = outwards * f.grid.area_vector(side.axis, face[0], face[1], face[2]);
      const Vec3 u_b = 0.5 * (at(f.u, face) + at(f.u, stepped(face, side.axis, -1)));
      const Vec3 of_stencil = outwards * f.flow.options().viscosity * gradient_flux(f.grid, f.u, side.axis, face);
      const Vec3 tangential = of_stencil - of_stencil.dot(S) / S.squaredNorm() * S;
      // The shear on the side is that of a normal into the fluid.
      const Vec3 force_on_fluid = -S.norm() / f.flow.options().density * side.shear[n];
      const double p_side = side.pressure[n++] / f.flow.options().density;
      const double p_of_stencil = 0.5 * (p(face) + p(stepped(face, side.axis, -1)));
      sum += (force_on_fluid - tangential).dot(u_b) - outwards * f.U[side.axis](face) * (p_side - p_of_stencil);
    });
  }
  return sum;
}

}  // namespace

FlowEnergy energy(const FlowSolver& flow, double t)
{
  const Fields f{flow, flow.grid(), views(flow.state().u), views(flow.state().U)};
  FlowEnergy sum;
  for_each_cell_in_order(f.grid.owned(), [&](int i, int j, int k) {
    if (flow.links().is_inside({i, j, k}))
      return;
    const Vec3 u = at(f.u, {i, j, k});
    sum.kinetic += 0.5 * f.grid.volume(i, j, k) * u.squaredNorm();
    sum.body_force += f.grid.volume(i, j, k) * u.dot(flow.options().acceleration.value(f.grid.centre(i, j, k), t));
  });
  sum.dissipation = open_dissipation(f) + dissipation_beside_surfaces(f);
  sum.sides = correction_on_prescribed_sides(f);
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end)
      if (f.grid.ranks().at_boundary(axis, end)) {
        const SidePower side = power_of_side(f, axis, end);
        sum.sides += side.power;
        sum.dissipation += side.dissipation;
      }
  for (double* part : {&sum.kinetic, &sum.dissipation, &sum.sides, &sum.body_force})
    *part = flow.options().density * f.grid.ranks().sum(*part);
  return sum;
}

}  // namespace luff::fluid
