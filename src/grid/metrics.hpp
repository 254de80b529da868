// SPDX-License-Identifier: BSD-3-Clause
// The geometry kernels see.  Uniform and rectilinear grids share one interface; a uniform one reads nothing from
// memory; a curvilinear one has area vectors and a metric tensor.
#pragma once

#include <type_traits>

#include "parallel/field.hpp"
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

/// Place of G_ab in the six components of a symmetric tensor, stored as 11, 22, 33, 12, 13, 23.
LUFF_KERNEL constexpr int symmetric(int a, int b)
{
  return a == b ? a : a + b + 2;
}

/// Conductance between the centres of two cells, one half of each after the other: 1/a = (1/G(L) + 1/G(R))/2.  Where
/// cells only stretch it is A/d, as on straight grids; the arithmetic mean lets too much through where widths jump.
LUFF_KERNEL constexpr double in_series(double G_L, double G_R)
{
  return 2.0 * G_L * G_R / (G_L + G_R);
}

/// Body-fitted cells, index directions a = 0, 1, 2.  All views are valid on owned cells and one layer of halo; beyond a
/// side of the domain the halo repeats the tensor and the volume of the cell inside.
struct Curvilinear {
  /// S[a][c]: Cartesian component c of the area vector of the LOW face normal to direction a, towards increasing index
  /// [L^2].  Exact for the bilinear face, so that the six of a cell add up to zero to round-off.
  View<const double> S[3][3];
  /// G_ab = S_a . S_b/V at centres [L], in the order of symmetric(): a gradient along directions b becomes a flux
  /// through a face of direction a.
  View<const double> G[6];
  View<const double> V;  ///< exact cell volume [L^3]
  /// Cartesian coordinates of nodes, the low corner of cell (i, j, k) [L]; one layer of nodes around those of the
  /// owned cells.
  View<const double> node[3];
};

template <class Metric>
inline constexpr bool is_curvilinear = std::is_same_v<Metric, Curvilinear>;

}  // namespace luff::grid
