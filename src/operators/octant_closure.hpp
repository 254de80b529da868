// SPDX-License-Identifier: BSD-3-Clause
// The gradient of a pressure beside faces that no flow crosses, on a curvilinear grid.
#pragma once

#include <array>

#include "grid/metrics.hpp"

namespace luff::operators {

/// The energy of a cell is the mean over its eight octants of 1/2 D^T G D, D the differences of p across the three
/// faces that meet in an octant.  A difference across a closed face takes the value that makes the energy least,
///
///   d_b = -(G_ab d_a + G_bc d_c)/G_bb,
///
/// which is the condition that no flow crosses it; it never couples two sides of a sheet.  Eliminated from the energy,
/// closed differences leave the following coefficients, where t_b is half the number of closed b-faces of the cell.

/// Coefficient of d_a^2 in a cell, t_b and t_c those of the other two directions:
/// the means over its octants of G_aa less what one closed direction or both take away.
LUFF_KERNEL inline double closed_normal(double aa, double ab, double ac, double bb, double bc, double cc, double t_b,
                                        double t_c)
{
  const double b_closed = aa - ab * ab / bb;
  const double c_closed = aa - ac * ac / cc;
  const double both = aa - (ab * ab * cc - 2.0 * ab * ac * bc + ac * ac * bb) / (bb * cc - bc * bc);
  return (1.0 - t_b) * (1.0 - t_c) * aa + t_b * (1.0 - t_c) * b_closed + (1.0 - t_b) * t_c * c_closed +
         t_b * t_c * both;
}

/// Coefficient of <d_a><d_b> in a cell, <d> being half the sum of the differences across the two faces, 0 where closed.
LUFF_KERNEL inline double closed_cross(double ab, double ac, double bc, double cc, double t_c)
{
  return ab - t_c * ac * bc / cc;
}

/// Which faces of a cell are closed: bit 2 a + (0 low, 1 high) of direction a.
using ClosedFaces = unsigned char;
LUFF_KERNEL inline bool is_closed(ClosedFaces closed, int a, int side)
{
  return (closed >> (2 * a + side) & 1) != 0;
}
/// t_a
LUFF_KERNEL inline double closed_half(ClosedFaces closed, int a)
{
  return 0.5 * ((closed >> (2 * a) & 1) + (closed >> (2 * a + 1) & 1));
}

/// The three differences of one octant of a cell, given those across its open faces; G as in grid::Curvilinear.
LUFF_KERNEL inline void close_octant(const double (&G)[6], const bool (&closed)[3], double (&d)[3])
{
  const auto g = [&](int a, int b) { return G[a < b ? grid::symmetric(a, b) : grid::symmetric(b, a)]; };
  const int count = int(closed[0]) + int(closed[1]) + int(closed[2]);
  if (count == 0)
    return;
  if (count == 3) {
    d[0] = d[1] = d[2] = 0.0;
    return;
  }
  // One of the three is as the other two are not: the only closed one, or the only open one.
  const int b = closed[0] == closed[1] ? 2 : closed[0] == closed[2] ? 1 : 0;
  const int a = (b + 1) % 3;
  const int c = (b + 2) % 3;
  if (count == 1) {
    d[b] = -(g(a, b) * d[a] + g(b, c) * d[c]) / g(b, b);
    return;
  }
  const double determinant = g(a, a) * g(c, c) - g(a, c) * g(a, c);
  d[a] = -(g(a, b) * g(c, c) - g(b, c) * g(a, c)) / determinant * d[b];
  d[c] = -(g(b, c) * g(a, a) - g(a, b) * g(a, c)) / determinant * d[b];
}

/// Differences of p along the three index directions at the centre of a cell: the mean over its octants.
/// difference[a][s] is that across the low (s = 0) and high face of direction a; closed ones are not read.
/// The gradient is their sum times S_a/V, with the area vectors at the centre.
LUFF_KERNEL inline std::array<double, 3> closed_differences(const double (&G)[6], ClosedFaces closed,
                                                            const double (&difference)[3][2])
{
  std::array<double, 3> mean{0.0, 0.0, 0.0};
  for (int octant = 0; octant < 8; ++octant) {
    double d[3];
    bool shut[3];
    for (int a = 0; a < 3; ++a) {
      const int side = octant >> a & 1;
      shut[a] = is_closed(closed, a, side);
      d[a] = shut[a] ? 0.0 : difference[a][side];
    }
    close_octant(G, shut, d);
    for (int a = 0; a < 3; ++a)
      mean[a] += 0.125 * d[a];
  }
  return mean;
}

}  // namespace luff::operators
