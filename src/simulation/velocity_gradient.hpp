// SPDX-License-Identifier: BSD-3-Clause
// What is made of the differences between neighbouring cells.
#pragma once

#include <Eigen/LU>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "parallel/vector_field.hpp"

namespace luff::simulation {

/// (grad u)_ij = du_i/dx_j at the centre of a cell, from the differences between its neighbours along the three index
/// directions a:  grad u . (x(+a) - x(-a)) = u(+a) - u(-a).  Exact where u is linear, on grids of any kind.
[[nodiscard]] inline Mat3 velocity_gradient(const grid::Grid& grid, const View3<const double>& u, const Index3& c)
{
  Mat3 du;
  Mat3 dx;
  for (int a = 0; a < 3; ++a) {
    const Index3 high = stepped(c, a, 1);
    const Index3 low = stepped(c, a, -1);
    du.col(a) = at(u, high) - at(u, low);
    dx.col(a) = grid.centre(high) - grid.centre(low);
  }
  return du * dx.inverse();
}

[[nodiscard]] inline Vec3 vorticity(const Mat3& g)
{
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

/// Q = -1/2 tr(G G): positive where rotation wins over strain [hunt_1988_eddies].
[[nodiscard]] inline double q_criterion(const Mat3& g)
{
  return -0.5 * (g * g).trace();
}

}  // namespace luff::simulation
