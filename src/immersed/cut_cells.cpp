// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_cells.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "immersed/cell_metric.hpp"
#include "immersed/cut_axis.hpp"
#include "parallel/vector_field.hpp"

namespace luff::immersed {

namespace {

/// A value between two others, at the distances given from them.
template <class Value>
Value between(const std::array<Value, 2>& value, const std::array<double, 2>& distance)
{
  const double span = distance[0] + distance[1];
  return span > 0.0 ? Value((value[0] * distance[1] + value[1] * distance[0]) / span)
                    : Value(0.5 * (value[0] + value[1]));
}

/// Differences d_a per cell of a field beside a sheet whose normal flux sum_b G_ab d_b vanishes along the axes cut on
/// both sides, where d_a is not known.
Vec3 closed_differences(const grid::Curvilinear& metric, const CutLinks& links, const CutCell& cut, const Vec3& known)
{
  Mat3 equations = Mat3::Identity();
  Vec3 right = known;
  for (int a = 0; a < 3; ++a)
    if (cover(links, cut, a, 0) == 1.0 && cover(links, cut, a, 1) == 1.0) {
      right[a] = 0.0;
      for (int b = 0; b < 3; ++b)
        equations(a, b) = metric.G[grid::symmetric(a, b)](cut.cell);
    }
  return equations.partialPivLu().solve(right);
}

/// The gradient whose components across the faces of a cell are `slope`, d_a/h_a: sum_a slope_a S_a/|S_a|.
Vec3 gradient_of_slopes(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, const Vec3& slope)
{
  const grid::Curvilinear* const metric = curvilinear_metric(grid);
  if (metric == nullptr)
    return slope;
  Vec3 width;
  for (int a = 0; a < 3; ++a)
    width[a] = cut.along[a].width;
  const Vec3 difference = closed_differences(*metric, links, cut, slope.cwiseProduct(width));
  Vec3 gradient = Vec3::Zero();
  for (int a = 0; a < 3; ++a)
    gradient += difference[a] / width[a] * cut.along[a].centre_normal;
  return gradient;
}

}  // namespace

CutCellTerms momentum_terms(const CutLinks& links, const CutCell& cut, const View3<const double>& u, double viscosity,
                            const StageTime& now, const StageTime& then)
{
  CutCellTerms terms{Vec3::Zero(), Vec3::Zero(), 0.0};
  const Vec3 u_here = at(u, cut.cell);
  for (int axis = 0; axis < 3; ++axis)
    for (const LinkForm& form : LinkForms(links, cut, axis)) {
      const CutAxis along_now = cut_axis(links, cut, axis, now, form.cut);
      const CutAxis along_then = form.any_cut() ? cut_axis(links, cut, axis, then, form.cut) : along_now;
      const std::array<Vec3, 2> u_beside = velocities_beside(links, cut, axis, along_now, u, now);
      for (int side = 0; side < 2; ++side) {
        if (form.cut[side]) {
          const double v = form.weight * along_then.exchange(side, viscosity);
          terms.wall_rate += v;
          terms.wall_source += v * links.velocity(along_then.hit[side], then);
        } else {
          terms.explicit_rate += form.weight * along_now.exchange(side, viscosity) * (u_beside[side] - u_here);
        }
      }
      terms.explicit_rate -= form.weight * u_here.dot(cut.along[axis].centre_normal) /
                             (along_now.length[0] + along_now.length[1]) * (u_beside[1] - u_beside[0]);
    }
  return terms;
}

Vec3 wall_source(const CutLinks& links, const CutCell& cut, double viscosity, const StageTime& then)
{
  Vec3 source = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (const LinkForm& form : LinkForms(links, cut, axis)) {
      if (!form.any_cut())
        continue;
      const CutAxis along = cut_axis(links, cut, axis, then, form.cut);
      for (int side = 0; side < 2; ++side)
        if (form.cut[side])
          source += form.weight * along.exchange(side, viscosity) * links.velocity(along.hit[side], then);
    }
  return source;
}

Vec3 pressure_gradient(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, const View<const double>& p)
{
  Vec3 slope = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<double, 2>& d = cut.along[axis].distance;
    double known = 0.0;
    for (const LinkForm& form : LinkForms(links, cut, axis)) {
      if (form.cut[0] && form.cut[1])
        continue;
      const double p_here = p(cut.cell);
      const double low = form.cut[0] ? 0.0 : (p_here - p(stepped(cut.cell, axis, -1))) / d[0];
      const double high = form.cut[1] ? 0.0 : (p(stepped(cut.cell, axis, 1)) - p_here) / d[1];
      const bool both = !form.cut[0] && !form.cut[1];
      slope[axis] += form.weight * (both ? (d[1] * low + d[0] * high) / (d[0] + d[1]) : low + high);
      known += form.weight;
    }
    if (known > 0.0)
      slope[axis] /= known;
  }
  return gradient_of_slopes(grid, links, cut, slope);
}

void recover_velocity(const grid::Grid& grid, const CutLinks& links, const View3<const double>& U,
                      const StageTime& time, const View3<double>& u)
{
  // Through a face covered in part the open link sees the velocity of the open part.
  const auto through = [&](const CutCell& cut, int axis, int side) {
    const int f = cut.face[2 * axis + side];
    if (f != open_link)
      return links.open_velocity(links.faces()[f], U, time);
    return U[axis](stepped(cut.cell, axis, side)) / cut.along[axis].area[side];
  };
  for (const CutCell& cut : links.cells()) {
    // The rows of S . u = flux, all divided by the areas of faces.
    Mat3 S = Mat3::Zero();
    Vec3 flux = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis)
      for (const LinkForm& form : LinkForms(links, cut, axis)) {
        const CutAxis along = cut_axis(links, cut, axis, time, form.cut);
        std::array<double, 2> value{};
        std::array<double, 2> distance{};
        const std::array<Vec3, 2>& normal = cut.along[axis].normal;
        for (int side = 0; side < 2; ++side) {
          if (form.cut[side]) {
            value[side] = links.velocity(along.hit[side], time).dot(normal[side]);
            distance[side] = std::max(along.theta[side], 0.0) * along.whole.distance[side];
          } else {
            value[side] = through(cut, axis, side);
            distance[side] = 0.5 * along.whole.width;
          }
        }
        flux[axis] += form.weight * between(value, distance);
        S.row(axis) += form.weight * between(normal, distance).transpose();
      }
    const Vec3 velocity = grid.kind() == grid::Kind::Curvilinear ? Vec3(S.partialPivLu().solve(flux)) : flux;
    for (int d = 0; d < 3; ++d)
      u[d](cut.cell) = velocity[d];
  }
}

}  // namespace luff::immersed
