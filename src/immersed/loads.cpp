// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/loads.hpp"

#include "parallel/vector_field.hpp"

#include <algorithm>
#include <cmath>

namespace luff::immersed {

namespace {

/// Pressure and viscous force per area that the fluid on one side of a hit exerts on the sheet.
struct HitTraction {
  double pressure = 0.0;
  Vec3 viscous = Vec3::Zero();
};

/// A hit as seen from the centre of one of the owned cells next to it.
struct HitView {
  const CutCell& cut;
  std::size_t n;  ///< number of the cell among links.cells()
  int axis;
  int side;  ///< of the link as seen from the cell: 1 when the hit lies on its high link

  [[nodiscard]] const CutFace& face(const CutLinks& links) const { return links.faces()[cut.face[2 * axis + side]]; }
  [[nodiscard]] int hit(const CutLinks& links) const { return side == 1 ? face(links).first : face(links).last; }
  /// The link behind the cell, away from the hit, and the cell there.
  [[nodiscard]] bool open_behind() const { return cut.face[2 * axis + 1 - side] == open_link; }
  [[nodiscard]] Index3 behind() const { return stepped(cut.cell, axis, side == 1 ? -1 : 1); }
};

/// nu times the velocity gradient that the momentum stencil of the cell takes its momentum with; see sheet_loads().
Vec3 wall_shear(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, const HitView& view,
                double to_sheet, double to_behind)
{
  const Vec3 u_b = links.velocity(view.hit(links), {1.0, SheetVelocity::Current});
  const Vec3 at_wall = fields.viscosity / to_sheet * (fields.u_star[view.n] - u_b);
  if (!view.open_behind())
    return at_wall;
  const Vec3 behind = fields.viscosity / to_behind * (at(fields.u, view.behind()) - at(fields.u, view.cut.cell));
  const double excess = grid.width(view.axis, view.cut.cell[view.axis]) / (0.5 * (to_sheet + to_behind)) - 1.0;
  return at_wall + excess * (at_wall - behind);
}

HitTraction one_sided(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, const HitView& view)
{
  const CutFace& face = view.face(links);
  const double d = grid.distance(view.axis, face.cell[view.axis]);
  const double d_behind = grid.distance(view.axis, view.cut.cell[view.axis] + 1 - view.side);
  const double theta = view.side == 1 ? links.crossings()[face.first].theta : 1.0 - links.crossings()[face.last].theta;
  const double p_here = fields.p(view.cut.cell);
  const double slope = view.open_behind() ? (p_here - fields.p(view.behind())) / d_behind : 0.0;  // towards the sheet
  return {.pressure = fields.density * (p_here + theta * d * slope),
          .viscous = fields.density * wall_shear(grid, links, fields, view, std::max(theta, theta_min) * d, d_behind)};
}

/// The side of a hit that looks into the gap between two hits of one link: mean pressure, Couette shear.
HitTraction in_gap(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, const CutFace& face,
                   int hit, int other)
{
  const double d = grid.distance(face.axis, face.cell[face.axis]);
  const double width = std::max(std::abs(links.crossings()[other].theta - links.crossings()[hit].theta), theta_min) * d;
  const StageTime now{1.0, SheetVelocity::Current};
  return {
      .pressure = 0.5 * fields.density * (fields.p(face.cell) + fields.p(stepped(face.cell, face.axis, -1))),
      .viscous = fields.density * fields.viscosity / width * (links.velocity(other, now) - links.velocity(hit, now))};
}

/// visit(hit, link_side, traction, area): every hit from both of its sides; link_side 0 is P's, 1 is N's.  Each rank
/// visits the sides towards its own cells; gap sides belong to the owner of N.
template <class Visit>
void for_each_hit_side(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, Visit visit)
{
  for (std::size_t n = 0; n < links.cells().size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const CutCell& cut = links.cells()[n];
      const double area = grid.area(axis, cut.cell[0], cut.cell[1], cut.cell[2]);
      for (int side = 0; side < 2; ++side) {
        const int f = cut.face[2 * axis + side];
        if (f == open_link)
          continue;
        const CutFace& face = links.faces()[f];
        visit(side == 1 ? face.first : face.last, 1 - side, one_sided(grid, links, fields, {cut, n, axis, side}), area);
        if (side == 1)
          continue;
        for (int q = face.first; q < face.last; ++q) {
          visit(q, 1, in_gap(grid, links, fields, face, q, q + 1), area);
          visit(q + 1, 0, in_gap(grid, links, fields, face, q + 1, q), area);
        }
      }
    }
}

/// Whether a side of the link (0: P's, 1: N's) is the sheet's + side.
bool on_plus_side(const Crossing& hit, int link_side)
{
  return (link_side == 1) == (hit.side > 0);
}

/// Summed once and sent to all, so that every rank holds the same bits.
void sum_over_ranks(const grid::Grid& grid, double* values, std::size_t count)
{
  const int n = static_cast<int>(count);
  const bool root = grid.ranks().rank() == 0;
  MPI_Reduce(root ? MPI_IN_PLACE : values, values, n, MPI_DOUBLE, MPI_SUM, 0, grid.ranks().comm());
  MPI_Bcast(values, n, MPI_DOUBLE, 0, grid.ranks().comm());
}

/// Area-weighted sums over the hits of one side of a triangle.
struct SideSums {
  double area = 0.0;
  double pressure = 0.0;
  double shear[3] = {0.0, 0.0, 0.0};
};
using TriangleSums = std::array<SideSums, 2>;

/// Shares what lies around each vertex with the triangles that no hit sampled.
void fill_from_neighbours(std::span<const std::array<int, 3>> triangles, std::size_t vertices,
                          std::vector<TriangleSums>& sums)
{
  std::vector<TriangleSums> around(vertices);
  const auto add = [](SideSums& to, const SideSums& from) {
    to.area += from.area;
    to.pressure += from.pressure;
    for (int c = 0; c < 3; ++c)
      to.shear[c] += from.shear[c];
  };
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (const int v : triangles[e])
      for (int side = 0; side < 2; ++side)
        add(around[v][side], sums[e][side]);
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (int side = 0; side < 2; ++side)
      if (sums[e][side].area == 0.0)
        for (const int v : triangles[e])
          add(sums[e][side], around[v][side]);
}

}  // namespace

SheetLoads sheet_loads(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, std::size_t vertices)
{
  SheetLoads loads{std::vector<Vec3>(vertices, Vec3::Zero()), std::vector<Vec3>(vertices, Vec3::Zero())};
  for_each_hit_side(grid, links, fields, [&](int q, int link_side, const HitTraction& t, double area) {
    const Crossing& hit = links.crossings()[q];
    Vec3 force = area * t.viscous;
    force[hit.axis] += link_side == 0 ? area * t.pressure : -area * t.pressure;
    std::vector<Vec3>& side = on_plus_side(hit, link_side) ? loads.plus : loads.minus;
    const auto& corner = links.triangle(hit);
    for (int n = 0; n < 3; ++n)
      side[corner[n]] += hit.weights[n] * force;
  });
  sum_over_ranks(grid, loads.minus.data()->data(), 3 * vertices);
  sum_over_ranks(grid, loads.plus.data()->data(), 3 * vertices);
  return loads;
}

std::vector<SideTraction> side_tractions(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields,
                                         std::size_t vertices)
{
  const auto& triangles = links.triangles();
  std::vector<TriangleSums> sums(triangles.size());
  for_each_hit_side(grid, links, fields, [&](int q, int link_side, const HitTraction& t, double area) {
    const Crossing& hit = links.crossings()[q];
    const int side = on_plus_side(hit, link_side) ? 1 : 0;
    // A_d samples |n_d| dS; weighted by |n_d| again, the three directions together count the area once.
    const double weight = area * std::abs(links.normal(q)[hit.axis]);
    SideSums& sum = sums[hit.triangle][side];
    sum.area += weight;
    sum.pressure += weight * t.pressure;
    for (int c = 0; c < 3; ++c)
      sum.shear[c] += area * t.viscous[c];
  });
  sum_over_ranks(grid, &sums[0][0].area, sums.size() * sizeof(TriangleSums) / sizeof(double));
  fill_from_neighbours(triangles, vertices, sums);
  std::vector<SideTraction> tractions(triangles.size());
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (int side = 0; side < 2; ++side)
      if (const SideSums& sum = sums[e][side]; sum.area > 0.0) {
        tractions[e].pressure[side] = sum.pressure / sum.area;
        tractions[e].shear[side] = Vec3(sum.shear[0], sum.shear[1], sum.shear[2]) / sum.area;
      }
  return tractions;
}

}  // namespace luff::immersed
