// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_axis.hpp"

#include <algorithm>

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

CutAxis cut_axis(const CutLinks& links, const CutCell& cut, int axis, const StageTime& time,
                 const std::array<bool, 2>& as_cut)
{
  CutAxis result{cut.along[axis]};
  for (int side = 0; side < 2; ++side) {
    result.length[side] = result.whole.distance[side];
    if (!as_cut[side])
      continue;
    const CutFace& face = links.faces()[cut.face[2 * axis + side]];
    result.hit[side] = side == 1 ? face.first : face.last;
    const double theta = links.theta(result.hit[side], time);
    result.theta[side] = side == 1 ? theta : 1.0 - theta;
    result.length[side] *= std::max(result.theta[side], least_theta(face));
  }
  result.span = result.any_cut() ? 0.5 * (result.length[0] + result.length[1]) : result.whole.width;
  return result;
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
