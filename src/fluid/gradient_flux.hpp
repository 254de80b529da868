// SPDX-License-Identifier: BSD-3-Clause
// The gradient of the velocity through a face, as the momentum equation has it.
#pragma once

#include "core/vec3.hpp"
#include "immersed/cell_metric.hpp"
#include "parallel/vector_field.hpp"

namespace luff::fluid {

/// (grad u . S) through the low face of a cell: a_f (u_N - u_P), on curvilinear grids with the cross terms
/// (w(P) + w(N))/2, w_a = sum_{b != a} G_ab <d_b>.
[[nodiscard]] inline Vec3 gradient_flux(const grid::Grid& grid, const View3<const double>& u, int axis,
                                        const Index3& face)
{
  const Index3 below = stepped(face, axis, -1);
  const double conductance = grid.area(axis, face[0], face[1], face[2]) / immersed::distance_across(grid, axis, face);
  Vec3 flux = conductance * (at(u, face) - at(u, below));
  if (const grid::Curvilinear* m = immersed::curvilinear_metric(grid))
    for (const Index3& c : {face, below})
      for (const int b : {(axis + 1) % 3, (axis + 2) % 3})
        flux += 0.25 * m->G[grid::symmetric(axis, b)](c) * (at(u, stepped(c, b, 1)) - at(u, stepped(c, b, -1)));
  return flux;
}

}  // namespace luff::fluid
