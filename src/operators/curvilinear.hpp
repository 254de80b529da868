// SPDX-License-Identifier: BSD-3-Clause
// Kernels of one curvilinear cell.  Index directions a, b = 0, 1, 2; the value of a face belongs to the low face of a
// cell.
#pragma once

#include "grid/metrics.hpp"

namespace luff::operators {

/// Unit step along axis a.
template <int a>
struct Step {
  static constexpr int i = a == 0, j = a == 1, k = a == 2;
};

/// Flux conductances of one cell from the metric tensor: net outflow of the gradient flux
///
///   F_f = a_f d_f + (w_a(L) + w_a(R))/2,   1/a_f = (1/G_aa(L) + 1/G_aa(R))/2,   w_a = sum_{b != a} G_ab <d_b>,
///
/// d_f the difference across the face and <d_b> = (u(+b) - u(-b))/2.  Because the cross terms of a face are the mean of
/// those of its two cells, their net outflow is sum_a [w_a(+a) - w_a(-a)]/2: twelve neighbours across edges.
struct GradientStencil {
  double low[3];            ///< a_f of the low faces
  double high[3];           ///< of the high ones
  double cross_low[3][3];   ///< G_ab/4 of the neighbour below along a
  double cross_high[3][3];  ///< of the one above

  template <int a>
  LUFF_INLINE_KERNEL void load(const grid::Curvilinear& m, int i, int j, int k)
  {
    using S = Step<a>;
    const View<const double>& G = m.G[a];
    low[a] = grid::in_series(G(i - S::i, j - S::j, k - S::k), G(i, j, k));
    high[a] = grid::in_series(G(i, j, k), G(i + S::i, j + S::j, k + S::k));
    load_cross<a, (a + 1) % 3>(m, i, j, k);
    load_cross<a, (a + 2) % 3>(m, i, j, k);
  }
  template <int a, int b>
  LUFF_INLINE_KERNEL void load_cross(const grid::Curvilinear& m, int i, int j, int k)
  {
    using S = Step<a>;
    const View<const double>& G = m.G[a < b ? grid::symmetric(a, b) : grid::symmetric(b, a)];
    cross_low[a][b] = 0.25 * G(i - S::i, j - S::j, k - S::k);
    cross_high[a][b] = 0.25 * G(i + S::i, j + S::j, k + S::k);
  }

  /// sum_f F_f outwards.
  LUFF_INLINE_KERNEL double net_outflow(const View<const double>& u, int i, int j, int k) const
  {
    return along<0>(u, i, j, k) + along<1>(u, i, j, k) + along<2>(u, i, j, k);
  }

 private:
  template <int a>
  LUFF_INLINE_KERNEL double along(const View<const double>& u, int i, int j, int k) const
  {
    using S = Step<a>;
    return high[a] * (u(i + S::i, j + S::j, k + S::k) - u(i, j, k)) -
           low[a] * (u(i, j, k) - u(i - S::i, j - S::j, k - S::k)) + across<a, (a + 1) % 3>(u, i, j, k) +
           across<a, (a + 2) % 3>(u, i, j, k);
  }
  /// [w_ab(+a) - w_ab(-a)]/2
  template <int a, int b>
  LUFF_INLINE_KERNEL double across(const View<const double>& u, int i, int j, int k) const
  {
    using S = Step<a>;
    using T = Step<b>;
    return cross_high[a][b] * (u(i + S::i + T::i, j + S::j + T::j, k + S::k + T::k) -
                               u(i + S::i - T::i, j + S::j - T::j, k + S::k - T::k)) -
           cross_low[a][b] * (u(i - S::i + T::i, j - S::j + T::j, k - S::k + T::k) -
                              u(i - S::i - T::i, j - S::j - T::j, k - S::k - T::k));
  }
};

/// Twice the area vector S_a at a centre, the sum of those of the two opposite faces.
struct AreaVector {
  double x, y, z;
};
template <int a>
LUFF_INLINE_KERNEL AreaVector centre_area(const grid::Curvilinear& m, int i, int j, int k)
{
  using S = Step<a>;
  const auto sum = [&](const View<const double>& s) { return s(i, j, k) + s(i + S::i, j + S::j, k + S::k); };
  return {sum(m.S[a][0]), sum(m.S[a][1]), sum(m.S[a][2])};
}
LUFF_INLINE_KERNEL AreaVector cross(const AreaVector& a, const AreaVector& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace luff::operators
