// SPDX-License-Identifier: BSD-3-Clause
// The geometry kernels see.  Uniform and rectilinear grids share one interface; a uniform one reads nothing from memory.
#pragma once

#include "parallel/for_each.hpp"

namespace luff::grid {

/// Interface of a metric (axis a = 0, 1, 2; index i along that axis, global, valid on the halo too):
///
///   width<a>(i)              h_i     width of cell i                                  [L]
///   distance<a>(i)           d_i     between the centres of cells i-1 and i           [L]
///   inverse_width<a>(i)      1/h_i                                                    [1/L]
///   inverse_distance<a>(i)   1/d_i                                                    [1/L]
///   area<a>(i, j, k)         A       of a face normal to axis a of cell (i, j, k)     [L^2]
///   volume(i, j, k)          V       of cell (i, j, k)                                [L^3]
///
/// Beyond a wall the halo cell mirrors its neighbour, so that the wall lies midway between the two centres.
struct Uniform {
  double h[3];
  double inverse_h[3];

  template <int a>
  LUFF_KERNEL double width(int) const
  {
    return h[a];
  }
  template <int a>
  LUFF_KERNEL double distance(int) const
  {
    return h[a];
  }
  template <int a>
  LUFF_KERNEL double inverse_width(int) const
  {
    return inverse_h[a];
  }
  template <int a>
  LUFF_KERNEL double inverse_distance(int) const
  {
    return inverse_h[a];
  }
  template <int a>
  LUFF_KERNEL double area(int, int, int) const
  {
    return h[(a + 1) % 3] * h[(a + 2) % 3];
  }
  LUFF_KERNEL double volume(int, int, int) const { return h[0] * h[1] * h[2]; }
};

struct Rectilinear {
  const double* h[3];
  const double* d[3];
  const double* inverse_h[3];
  const double* inverse_d[3];

  template <int a>
  LUFF_KERNEL double width(int i) const
  {
    return h[a][i];
  }
  template <int a>
  LUFF_KERNEL double distance(int i) const
  {
    return d[a][i];
  }
  template <int a>
  LUFF_KERNEL double inverse_width(int i) const
  {
    return inverse_h[a][i];
  }
  template <int a>
  LUFF_KERNEL double inverse_distance(int i) const
  {
    return inverse_d[a][i];
  }
  template <int a>
  LUFF_KERNEL double area(int i, int j, int k) const
  {
    if constexpr (a == 0)
      return h[1][j] * h[2][k];
    else if constexpr (a == 1)
      return h[0][i] * h[2][k];
    else
      return h[0][i] * h[1][j];
  }
  LUFF_KERNEL double volume(int i, int j, int k) const { return h[0][i] * h[1][j] * h[2][k]; }
};

}  // namespace luff::grid
