// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/loads.hpp"

#include "immersed/cell_metric.hpp"
#include "immersed/cut_axis.hpp"
#include "immersed/cut_cells.hpp"
#include "parallel/vector_field.hpp"
#include "surface/mesh.hpp"

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

  [[nodiscard]] const CellAxis& along() const { return cut.along[axis]; }
  [[nodiscard]] const CutFace& face(const CutLinks& links) const { return links.faces()[cut.face[2 * axis + side]]; }
  [[nodiscard]] int hit(const CutLinks& links) const { return side == 1 ? face(links).first : face(links).last; }
  /// Of the face behind the cell, away from the hit, the part that is open, and the cell there.
  [[nodiscard]] double open_behind(const CutLinks& links) const { return 1.0 - cover(links, cut, axis, 1 - side); }
  [[nodiscard]] Index3 behind() const { return stepped(cut.cell, axis, side == 1 ? -1 : 1); }
};

/// nu times the velocity gradient that one form of the momentum stencil of the cell takes its momentum with; see
/// sheet_loads().
Vec3 wall_shear_of(const CutAxis& along, const CutLinks& links, const LoadFields& fields, const HitView& view)
{
  const int side = view.side;
  const Vec3 u_b = links.velocity(view.hit(links), {1.0, SheetVelocity::Current});
  const Vec3 shear = fields.viscosity / along.length[side] * (fields.u_star[view.n] - u_b);
  if (along.cut(1 - side))
    return shear;
  const double areas = along.whole.area_ratio[side] / along.whole.area_ratio[1 - side];
  const Vec3 behind =
      areas * fields.viscosity / along.length[1 - side] * (at(fields.u, view.behind()) - at(fields.u, view.cut.cell));
  return shear + (along.whole.width / along.span - 1.0) * (shear - behind);
}

/// The mean over the forms in which the hit's own link is cut.
Vec3 wall_shear(const CutLinks& links, const LoadFields& fields, const HitView& view)
{
  const int side = view.side;
  const StageTime now{1.0, SheetVelocity::Current};
  Vec3 shear = Vec3::Zero();
  for (const LinkForm& form : LinkForms(links, view.cut, view.axis))
    if (form.cut[side])
      shear += form.weight / view.face(links).cover *
               wall_shear_of(cut_axis(links, view.cut, view.axis, now, form.cut), links, fields, view);
  if (fields.cross == nullptr)
    return shear;
  const Vec3 cross = fields.cross->at_wall(links, view.cut, view.axis, side, fields.u) / view.along().area[side];
  return shear + (side == 1 ? -1.0 : 1.0) * fields.viscosity * cross;
}

/// The part of the viscous traction on a body that comes from its turning: -mu spin x n, n out of the body.  On both
/// sides of a sheet together it is zero.
Vec3 turning_shear(const CutLinks& links, const LoadFields& fields, int triangle, const Vec3& n)
{
  return -fields.density * fields.viscosity * links.spin_at(triangle).cross(n);
}

/// a_W - a_c: what the kinematic pressure rises by per length towards the sheet beyond what it does behind the cell,
/// because the fluid at the cut face is accelerated otherwise than that at the face behind.  At closed bodies, which
/// have fluid on one side of the cut face only, the steps of cells would be accelerated with them: nothing is added;
/// nor at a face that is covered in part, whose flux is not the sheet's alone.
double slope_of_inertia(const CutLinks& links, const LoadFields& fields, const HitView& view)
{
  const int hit = view.hit(links);
  if (fields.acceleration.empty() || links.looks_inside(hit, 0) || links.looks_inside(hit, 1) ||
      view.face(links).cover < 1.0)
    return 0.0;
  const std::array<double, 6>& a = fields.acceleration[view.n];
  const double towards = view.side == 1 ? 1.0 : -1.0;
  const double behind = view.open_behind(links) > 0.0 ? a[2 * view.axis + 1 - view.side] : 0.0;
  return towards * (behind - a[2 * view.axis + view.side]);
}

HitTraction one_sided(const CutLinks& links, const LoadFields& fields, const HitView& view)
{
  const double to_sheet = links.crossings()[view.hit(links)].theta;
  const double distance = (view.side == 1 ? to_sheet : 1.0 - to_sheet) * view.along().distance[view.side];
  const double open = view.open_behind(links);
  const Vec3 out = (view.side == 1 ? -1.0 : 1.0) * view.along().normal[view.side];
  const double p_here = fields.p(view.cut.cell);
  const double slope =  // towards the sheet
      (open > 0.0 ? open * (p_here - fields.p(view.behind())) / view.along().distance[1 - view.side] : 0.0) +
      slope_of_inertia(links, fields, view);
  return {.pressure = fields.density * (p_here + distance * slope),
          .viscous = fields.density * wall_shear(links, fields, view) +
                     turning_shear(links, fields, links.crossings()[view.hit(links)].triangle, out)};
}

/// The side of a hit that looks into the gap between two hits of one link: mean pressure of the fluid beside it,
/// Couette shear.
HitTraction in_gap(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, const CutFace& face,
                   int hit, int other)
{
  const double d = distance_across(grid, face.axis, face.cell);
  const double width = std::max(std::abs(links.crossings()[other].theta - links.crossings()[hit].theta), theta_min) * d;
  const StageTime now{1.0, SheetVelocity::Current};
  const bool low = !links.looks_inside(face.first, 0);
  const bool high = !links.looks_inside(face.last, 1);
  const double p_low = fields.p(stepped(face.cell, face.axis, -1));
  const double p_high = fields.p(face.cell);
  const double p = low == high ? 0.5 * (p_low + p_high) : low ? p_low : p_high;
  return {
      .pressure = fields.density * p,
      .viscous = fields.density * fields.viscosity / width * (links.velocity(other, now) - links.velocity(hit, now))};
}

/// visit(hit, link_side, traction, area): every hit from both of its sides; link_side 0 is P's, 1 is N's.  Each rank
/// visits the sides towards its own cells; gap sides belong to the owner of N.  Sides that look into a body are none of
/// the fluid's.
template <class Visit>
void for_each_hit_side(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, Visit visit)
{
  for (std::size_t n = 0; n < links.cells().size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const CutCell& cut = links.cells()[n];
      for (int side = 0; side < 2; ++side) {
        const int f = cut.face[2 * axis + side];
        if (f == open_link)
          continue;
        const CutFace& face = links.faces()[f];
        const double area = face.cover * cut.along[axis].area[side];
        visit(side == 1 ? face.first : face.last, 1 - side, one_sided(links, fields, {cut, n, axis, side}), area);
      }
    }
  for (const CutFace& face : links.faces()) {
    if (!grid.owned().contains(face.cell))
      continue;
    const double area = grid.area(face.axis, face.cell[0], face.cell[1], face.cell[2]);
    for (int q = face.first; q < face.last; ++q) {
      if (links.looks_inside(q, 1) || links.looks_inside(q + 1, 0))
        continue;
      visit(q, 1, in_gap(grid, links, fields, face, q, q + 1), area);
      visit(q + 1, 0, in_gap(grid, links, fields, face, q + 1, q), area);
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

/// The sheet's area that a hit stands for, over that of its face: hits along one axis d sample |n_d| dS; weighted by
/// |n_d| again, the three directions together count the area once.  On curvilinear grids a link t with face S pierces
/// the area |S.t|/|n.t|, and its weight is (n.t)^2/t^2 over the sum of the three links'.
double area_share(const grid::Grid& grid, const Crossing& hit, const Vec3& normal)
{
  if (grid.kind() != grid::Kind::Curvilinear)
    return std::abs(normal[hit.axis]);
  double sum = 0.0;
  double share = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 link = grid.centre(hit.cell) - grid.centre(stepped(hit.cell, axis, -1));
    const double part = std::abs(normal.dot(link)) / link.norm();
    sum += part * part;
    if (axis == hit.axis)
      share = part * std::abs(face_normal(grid, axis, hit.cell).dot(link)) / link.norm();
  }
  return share / sum;
}

/// Shares what lies around each vertex with the triangles that no hit sampled; again, until no more are reached.
void fill_from_neighbours(std::span<const std::array<int, 3>> triangles, std::size_t vertices,
                          std::vector<TriangleSums>& sums)
{
  const auto add = [](SideSums& to, const SideSums& from) {
    to.area += from.area;
    to.pressure += from.pressure;
    for (int c = 0; c < 3; ++c)
      to.shear[c] += from.shear[c];
  };
  for (bool reached = true; reached;) {
    reached = false;
    std::vector<TriangleSums> around(vertices);
    for (std::size_t e = 0; e < triangles.size(); ++e)
      for (const int v : triangles[e])
        for (int side = 0; side < 2; ++side)
          add(around[v][side], sums[e][side]);
    for (std::size_t e = 0; e < triangles.size(); ++e)
      for (int side = 0; side < 2; ++side) {
        if (sums[e][side].area != 0.0)
          continue;
        for (const int v : triangles[e])
          add(sums[e][side], around[v][side]);
        reached = reached || sums[e][side].area != 0.0;
      }
  }
}

/// The tractions of all triangles from the sums over what this rank has of them.
std::vector<SideTraction> mean_tractions(const grid::Grid& grid, std::span<const std::array<int, 3>> triangles,
                                         std::size_t vertices, std::vector<TriangleSums>& sums)
{
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

/// Pressure and shear at the foot of a wall node; see node_tractions().
HitTraction at_foot(const grid::Grid& grid, const CutLinks& links, const WallNode& node, const CutCell& cut,
                    const LoadFields& fields)
{
  const double p = fields.p(cut.cell);
  const Vec3 u_a = links.velocity_at(node.foot, {1.0, SheetVelocity::Current});
  const Vec3 before = links.velocity_at(node.foot, {0.0, SheetVelocity::Predicted});
  const Vec3 acceleration = (u_a - before) / links.step_length();
  if (node.donors == 0)
    return {.pressure = fields.density * (p + node.distance * acceleration.dot(node.normal))};
  double p_c = 0.0;
  Vec3 u_c = Vec3::Zero();
  for (int k = 0; k < node.donors; ++k) {
    p_c += node.weight[k] * fields.p(node.donor[k]);
    u_c += node.weight[k] * at(fields.u, node.donor[k]);
  }
  const Vec3 curvature = pressure_gradient(grid, links, cut, fields.p) + acceleration;  // times nu
  Vec3 slope = fields.viscosity / node.reach * (u_c - u_a) - 0.5 * node.reach * curvature;
  slope -= slope.dot(node.normal) * node.normal;
  return {.pressure = fields.density * (p - node.distance / (node.reach - node.distance) * (p_c - p)),
          .viscous = fields.density * slope + turning_shear(links, fields, node.foot.triangle, node.normal)};
}

}  // namespace

SheetLoads sheet_loads(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields, std::size_t vertices)
{
  SheetLoads loads{std::vector<Vec3>(vertices, Vec3::Zero()), std::vector<Vec3>(vertices, Vec3::Zero())};
  for_each_hit_side(grid, links, fields, [&](int q, int link_side, const HitTraction& t, double area) {
    const Crossing& hit = links.crossings()[q];
    Vec3 force = area * t.viscous;
    force += (link_side == 0 ? area * t.pressure : -area * t.pressure) * face_normal(grid, hit.axis, hit.cell);
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
    const double weight = area * area_share(grid, hit, links.normal(q));
    SideSums& sum = sums[hit.triangle][side];
    sum.area += weight;
    sum.pressure += weight * t.pressure;
    for (int c = 0; c < 3; ++c)
      sum.shear[c] += area * t.viscous[c];
  });
  return mean_tractions(grid, triangles, vertices, sums);
}

std::vector<SideTraction> node_tractions(const grid::Grid& grid, const CutLinks& links, const WallNodes& nodes,
                                         const LoadFields& fields)
{
  const auto& triangles = links.triangles();
  const auto& x = links.positions();
  std::vector<TriangleSums> sums(triangles.size());
  for (std::size_t n = 0; n < nodes.nodes().size(); ++n) {
    const WallNode& node = nodes.nodes()[n];
    const HitTraction t = at_foot(grid, links, node, links.cells()[n], fields);
    for (const int triangle : node.touched) {
      const auto& [a, b, c] = triangles[triangle];
      const Vec3 to_node = node.foot.place + node.distance * node.normal - (x[a] + x[b] + x[c]) / 3.0;
      const double weight = 1.0 / to_node.norm();
      SideSums& sum = sums[triangle][node.plus ? 1 : 0];
      sum.area += weight;
      sum.pressure += weight * t.pressure;
      for (int d = 0; d < 3; ++d)
        sum.shear[d] += weight * t.viscous[d];
    }
  }
  return mean_tractions(grid, triangles, x.size(), sums);
}

SheetLoads loads_of_tractions(const CutLinks& links, std::span<const SideTraction> tractions)
{
  const auto& x = links.positions();
  SheetLoads loads{std::vector<Vec3>(x.size(), Vec3::Zero()), std::vector<Vec3>(x.size(), Vec3::Zero())};
  for (std::size_t e = 0; e < tractions.size(); ++e) {
    const auto& [a, b, c] = links.triangles()[e];
    const Vec3 area = surface::area_vector(x[a], x[b], x[c]);
    for (int side = 0; side < 2; ++side) {
      const Vec3 force =
          (side == 1 ? -1.0 : 1.0) * tractions[e].pressure[side] * area + area.norm() * tractions[e].shear[side];
      for (const int v : {a, b, c})
        (side == 1 ? loads.plus : loads.minus)[v] += force / 3.0;
    }
  }
  return loads;
}

}  // namespace luff::immersed
