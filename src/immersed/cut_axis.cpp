// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_axis.hpp"

#include <algorithm>

#include "immersed/cell_metric.hpp"
#include "parallel/vector_field.hpp"

namespace luff::immersed {

LinkForms::LinkForms(const CutLinks& links, const CutCell& cut, int axis)
{
  const std::array<double, 2> covered{cover(links, cut, axis, 0), cover(links, cut, axis, 1)};
  for (const bool low : {false, true})
    for (const bool high : {false, true}) {
      const double weight = (low ? covered[0] : 1.0 - covered[0]) * (high ? covered[1] : 1.0 - covered[1]);
      if (weight > 0.0)
        forms_[count_++] = {{low, high}, weight};
    }
}

namespace {

/// d of both links, h of the cell and the ratios of areas.
CutAxis open_axis(const grid::Grid& grid, const Index3& cell, int axis)
{
  CutAxis result;
  const grid::Curvilinear* const m = curvilinear_metric(grid);
  if (m == nullptr) {
    result.distance = {grid.distance(axis, cell[axis]), grid.distance(axis, cell[axis] + 1)};
    result.width = grid.width(axis, cell[axis]);
    return result;
  }
  const double at_centre = centre_area_vector(grid, axis, cell).norm();
  for (int side = 0; side < 2; ++side) {
    const Index3 face = stepped(cell, axis, side);
    const double area = grid.area(axis, face[0], face[1], face[2]);
    result.distance[side] = area / grid::in_series(m->G[axis](stepped(face, axis, -1)), m->G[axis](face));
    result.area_ratio[side] = at_centre / area;
  }
  result.width = m->V(cell) / at_centre;
  return result;
}

}  // namespace

CutAxis cut_axis(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, int axis, const StageTime& time,
                 const std::array<bool, 2>& as_cut)
{
  CutAxis result = open_axis(grid, cut.cell, axis);
  for (int side = 0; side < 2; ++side) {
    result.length[side] = result.distance[side];
    if (!as_cut[side])
      continue;
    const CutFace& face = links.faces()[cut.face[2 * axis + side]];
    result.hit[side] = side == 1 ? face.first : face.last;
    const double theta = links.theta(result.hit[side], time);
    result.theta[side] = side == 1 ? theta : 1.0 - theta;
    result.length[side] *= std::max(result.theta[side], least_theta(face));
  }
  result.span = result.any_cut() ? 0.5 * (result.length[0] + result.length[1]) : result.width;
  return result;
}

CutAxis cut_axis(const grid::Grid& grid, const CutLinks& links, const CutCell& cut, int axis, const StageTime& time)
{
  return cut_axis(grid, links, cut, axis, time, {cut.face[2 * axis] != open_link, cut.face[2 * axis + 1] != open_link});
}

std::array<Vec3, 2> velocities_beside(const CutLinks& links, const CutCell& cut, int axis, const CutAxis& along,
                                      const View3<const double>& u, const StageTime& time)
{
  std::array<Vec3, 2> beside;
  for (int side = 0; side < 2; ++side)
    beside[side] =
        along.cut(side) ? links.velocity(along.hit[side], time) : at(u, stepped(cut.cell, axis, side == 0 ? -1 : 1));
  return beside;
}

}  // namespace luff::immersed
