// SPDX-License-Identifier: BSD-3-Clause
#include "operators/line_factors.hpp"

#include <utility>

#include "operators/curvilinear.hpp"

namespace luff::operators {

namespace {

/// The views of one direction.
template <class T>
struct Lines {
  View<T> low;
  View<T> pivot;
  View<T> high;
};

/// The box's cells number l along an axis.
IndexBox plane(IndexBox box, int axis, int l)
{
  box.lo[axis] = l;
  box.hi[axis] = l + 1;
  return box;
}

/// kernel(i, j, k) for all cells, in the order of increasing or decreasing index along axis a.
template <int a, class Kernel>
void sweep(const IndexBox& box, bool upwards, Kernel kernel)
{
  const int lo = box.lo[a];
  const int hi = box.hi[a];
  if constexpr (a == 0) {  // a line is a row of memory: one line after the other
    for_each_cell(plane(box, a, lo), [=] LUFF_KERNEL(int, int j, int k) {
      for (int n = 0; n < hi - lo; ++n)
        kernel(upwards ? lo + n : hi - 1 - n, j, k);
    });
  } else {  // all lines side by side
    for (int n = 0; n < hi - lo; ++n)
      for_each_cell(plane(box, a, upwards ? lo + n : hi - 1 - n), kernel);
  }
}

/// 1/V and nu g of the low and high face normal to a.
template <int a, class Metric>
LUFF_INLINE_KERNEL void line_coefficients(const Metric& m, int i, int j, int k, double& inverse_volume, double& low,
                                          double& high)
{
  using S = Step<a>;
  if constexpr (grid::is_curvilinear<Metric>) {
    const View<const double>& G = m.G[a];
    inverse_volume = 1.0 / m.V(i, j, k);
    low = grid::in_series(G(i - S::i, j - S::j, k - S::k), G(i, j, k));
    high = grid::in_series(G(i, j, k), G(i + S::i, j + S::j, k + S::k));
  } else {
    const int l = a == 0 ? i : a == 1 ? j : k;
    const double area = m.template area<a>(i, j, k);
    inverse_volume = 1.0 / m.volume(i, j, k);
    low = area * m.template inverse_distance<a>(l);
    high = area * m.template inverse_distance<a>(l + 1);
  }
}

/// nu times the gradient at a side that holds the velocity, a quadratic through it and two cells: from conductances g
/// of the side, whose halo mirrors the cell, and of the inner face, with q = g_inner/(2 g),
///
///   g [ 2 (1 + q) v_P - 2 q^2/(1 + q) v_N ].
struct SideWeights {
  double here;
  double inner;
};
LUFF_INLINE_KERNEL SideWeights weights_at_side(double g, double g_inner)
{
  const double q = 0.5 * g_inner / g;
  return {2.0 * g * (1.0 + q), 2.0 * g * q * q / (1.0 + q)};
}

template <int a, class Metric>
void factorise(const Metric m, const IndexBox& box, double tau, double viscosity, View<const double> U,
               const std::array<bool, 2>& holds, const Lines<double>& lines)
{
  const int first = box.lo[a];
  const int last = box.hi[a] - 1;
  const bool holds_low = holds[0] && first < last;
  const bool holds_high = holds[1] && first < last;
  sweep<a>(box, true, [=] LUFF_KERNEL(int i, int j, int k) {
    using S = Step<a>;
    double inverse_volume = 0.0;
    double g_low = 0.0;
    double g_high = 0.0;
    line_coefficients<a>(m, i, j, k, inverse_volume, g_low, g_high);
    const int l = a == 0 ? i : a == 1 ? j : k;
    const bool starts = l == first;
    const bool ends = l == last;
    const SideWeights at_low = weights_at_side(g_low, g_high);
    const SideWeights at_high = weights_at_side(g_high, g_low);
    // Gradients of v_P and of the two neighbours; lines that end without a side have none there.
    const double here =
        (starts ? (holds_low ? at_low.here : 0.0) : g_low) + (ends ? (holds_high ? at_high.here : 0.0) : g_high);
    const double below = starts ? 0.0 : g_low + (ends && holds_high ? at_high.inner : 0.0);
    const double above = ends ? 0.0 : g_high + (starts && holds_low ? at_low.inner : 0.0);
    const double weight = tau * inverse_volume;
    const double U_low = U(i, j, k);
    const double U_high = U(i + S::i, j + S::j, k + S::k);
    const double low = -weight * (viscosity * below + 0.5 * U_low);
    const double high = -weight * (viscosity * above - 0.5 * U_high);
    const double diagonal = 1.0 + weight * (viscosity * here + 0.5 * (U_high - U_low));
    const double before = starts ? 0.0 : lines.high(i - S::i, j - S::j, k - S::k);
    const double pivot = 1.0 / (diagonal - low * before);
    lines.low(i, j, k) = starts ? 0.0 : low;
    lines.pivot(i, j, k) = pivot;
    lines.high(i, j, k) = ends ? 0.0 : high * pivot;
  });
}

template <int a>
void solve_lines(const IndexBox& box, const Lines<const double>& lines, View<double> x)
{
  using S = Step<a>;
  sweep<a>(box, true, [=] LUFF_KERNEL(int i, int j, int k) {
    // Before the first cell of a line low is zero and x is the halo, whatever it holds.
    const double low = lines.low(i, j, k);
    const double before = low == 0.0 ? 0.0 : x(i - S::i, j - S::j, k - S::k);
    x(i, j, k) = (x(i, j, k) - low * before) * lines.pivot(i, j, k);
  });
  IndexBox inner = box;
  --inner.hi[a];
  sweep<a>(inner, false, [=] LUFF_KERNEL(int i, int j, int k) {
    x(i, j, k) -= lines.high(i, j, k) * x(i + S::i, j + S::j, k + S::k);
  });
}

}  // namespace

LineFactors::LineFactors(const grid::Grid& grid, const std::array<std::array<bool, 2>, 3>& holds)
    : grid_(grid),
      holds_(holds),
      low_(make_field3<double>(grid.owned())),
      pivot_(make_field3<double>(grid.owned())),
      high_(make_field3<double>(grid.owned()))
{
  for (int a = 0; a < 3; ++a) {
    holds_[a][0] = holds[a][0] && grid.owned().lo[a] == 0;
    holds_[a][1] = holds[a][1] && grid.owned().hi[a] == grid.cells()[a];
  }
}

void LineFactors::update(double tau, const View3<const double>& U, double viscosity)
{
  grid_.visit([&](const auto m) {
    const auto direction = [&]<int a>(std::integral_constant<int, a>) {
      factorise<a>(m, grid_.owned(), tau, viscosity, U[a], holds_[a],
                   {low_[a].view(), pivot_[a].view(), high_[a].view()});
    };
    direction(std::integral_constant<int, 0>{});
    direction(std::integral_constant<int, 1>{});
    direction(std::integral_constant<int, 2>{});
  });
}

void LineFactors::solve(const View3<double>& v) const
{
  const auto lines = [&](int a) -> Lines<const double> { return {low_[a].view(), pivot_[a].view(), high_[a].view()}; };
  for (const View<double>& component : v) {
    solve_lines<0>(grid_.owned(), lines(0), component);
    solve_lines<1>(grid_.owned(), lines(1), component);
    solve_lines<2>(grid_.owned(), lines(2), component);
  }
}

}  // namespace luff::operators
