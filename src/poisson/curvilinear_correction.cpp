// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/curvilinear_correction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luff::poisson {

namespace {

CurvilinearOperator make_operator(const grid::Grid& grid, const SideConditions& sides)
{
  return grid.visit([&](const auto& metric) -> CurvilinearOperator {
    if constexpr (grid::is_curvilinear<std::decay_t<decltype(metric)>>)
      return {grid.ranks(), metric.G, sides};
    else
      throw std::logic_error("a curvilinear operator on a grid that is none");
  });
}

/// The cells beside those of row (j, k) along an axis.
template <class T>
const T* row_beside(const View<const T>& values, int axis, int side, int j, int k)
{
  const int step = side == 0 ? -1 : 1;
  return values.row(j, k) + step * values.stride(axis);
}

}  // namespace

CurvilinearCorrection::CurvilinearCorrection(const grid::Grid& grid, const SideConditions& sides)
    : FluxCorrection(grid, sides),
      operator_(make_operator(grid, sides)),
      w_(make_field3<double>(grid.owned())),
      width_over_volume_(grid.owned())
{
  // The smallest of V / S_a over V.
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    double area = 0.0;
    for (int a = 0; a < 3; ++a) {
      const Index3 high = stepped({i, j, k}, a, 1);
      const Vec3 sum = grid.area_vector(a, i, j, k) + grid.area_vector(a, high[0], high[1], high[2]);
      area = std::max(area, 0.5 * sum.norm());
    }
    width_over_volume_(i, j, k) = 1.0 / area;
  });
}

void CurvilinearCorrection::set_blocked(std::span<const FaceIndex> faces)
{
  FluxCorrection::set_blocked(faces);
  changes_ = operator_.set_blocked(faces);
  const Decomposition& ranks = grid_.ranks();
  partial_faces_ = gather_partial_faces(ranks.comm(), faces);
  beside_partial_ = {
      partial_faces_, grid_.owned(), grid_.cells(), {ranks.periodic(0), ranks.periodic(1), ranks.periodic(2)}, outer_};
}

double CurvilinearCorrection::largest_divergence(const double* net, int j, int k) const
{
  const double* __restrict outflow = net;
  const double* __restrict scale = width_over_volume_.view().row(j, k);
  const int n = grid_.cells()[0];
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (int i = 0; i < n; ++i) {
    const double scaled = std::abs(outflow[i]) * scale[i];
    largest = largest > scaled ? largest : scaled;
  }
  return largest;
}

/// w_a = sum_{b != a} g_ab <d_b> in the cells of a row; in the halo too where they exist there.
template <class T>
void CurvilinearCorrection::cross_row(int axis, const View<const T>& p, int j, int k)
{
  const int b = axis == 0 ? 1 : 0;
  const int c = axis == 2 ? 1 : 2;
  const View3<const double> face = operator_.face();
  const View3<const double> cross = operator_.cross();
  const double* __restrict g_b = cross[pair_without(c)].row(j, k);
  const double* __restrict g_c = cross[pair_without(b)].row(j, k);
  const double* __restrict open_b_low = face[b].row(j, k);
  const double* __restrict open_b_high = row_beside(face[b], b, 1, j, k);
  const double* __restrict open_c_low = face[c].row(j, k);
  const double* __restrict open_c_high = row_beside(face[c], c, 1, j, k);
  const T* __restrict own = p.row(j, k);
  const T* __restrict b_low = row_beside(p, b, 0, j, k);
  const T* __restrict b_high = row_beside(p, b, 1, j, k);
  const T* __restrict c_low = row_beside(p, c, 0, j, k);
  const T* __restrict c_high = row_beside(p, c, 1, j, k);
  double* __restrict out = w_[axis].view().row(j, k);
  const int n = grid_.cells()[0];
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double centre = own[i];
    const double d_b =
        (open_b_low[i] > 0.0 ? centre - b_low[i] : 0.0) + (open_b_high[i] > 0.0 ? b_high[i] - centre : 0.0);
    const double d_c =
        (open_c_low[i] > 0.0 ? centre - c_low[i] : 0.0) + (open_c_high[i] > 0.0 ? c_high[i] - centre : 0.0);
    out[i] = 0.5 * (g_b[i] * d_b + g_c[i] * d_c);
  }
}

/// Takes the closed parts of faces out of w in the cells of a plane.
template <class T>
void CurvilinearCorrection::weigh_cross_terms(const View<const T>& p, int t)
{
  for (const PartialFaces::Beside& face : beside_partial_.on_plane(t)) {
    const int b = face.axis;
    const Index3 beyond = stepped(face.cell, b, face.side == 0 ? -1 : 1);
    const double d =
        (face.side == 0 ? -1.0 : 1.0) * (static_cast<double>(p(beyond)) - static_cast<double>(p(face.cell)));
    for (const int a : {(b + 1) % 3, (b + 2) % 3})
      if (beside_partial_.has_cross_term(a, face.cell))
        w_[a].view()(face.cell) -= 0.5 * face.closed * operator_.cross()[pair_without(3 - a - b)](face.cell) * d;
  }
}

/// w_1 beyond both ends of a row.
void CurvilinearCorrection::close_row(int j, int k)
{
  double* w = w_[0].view().row(j, k);
  const int n = grid_.cells()[0];
  const bool periodic = grid_.ranks().periodic(0);
  w[-1] = periodic ? w[n - 1] : w[0];
  w[n] = periodic ? w[0] : w[n - 1];
}

/// w on plane t along the outer axis, and beyond the edges of the block.
template <class T>
void CurvilinearCorrection::cross_plane(const View<const T>& p, int t)
{
  const IndexBox& owned = grid_.owned();
  const int inner = 3 - outer_;
  const auto row = [&](int axis, int b, int plane) {
    outer_ == 2 ? cross_row(axis, p, b, plane) : cross_row(axis, p, plane, b);
  };
  for_rows(t, [&](int j, int k) {
    for (int a = 0; a < 3; ++a)
      cross_row(a, p, j, k);
  });
  for (int side = 0; side < 2; ++side) {
    if (continues(inner, side))
      row(inner, side == 0 ? owned.lo[inner] - 1 : owned.hi[inner], t);
    const bool at_edge = t == (side == 0 ? owned.lo[outer_] : owned.hi[outer_] - 1);
    if (!at_edge || !continues(outer_, side))
      continue;
    const int beyond = side == 0 ? t - 1 : t + 1;
    for (int b = owned.lo[inner]; b < owned.hi[inner]; ++b)
      row(outer_, b, beyond);
    weigh_cross_terms(p, beyond);
  }
  weigh_cross_terms(p, t);
  for_rows(t, [&](int j, int k) { close_row(j, k); });
}

void CurvilinearCorrection::prepare_plane(const View<const double>& p, int t)
{
  cross_plane(p, t);
}

void CurvilinearCorrection::prepare_plane(const View<const float>& p, int t)
{
  cross_plane(p, t);
}

namespace {

/// U <- U - factor F on n faces of a row, F = a d + (w_low + w_high)/2.
template <class T>
void correct_faces(double* __restrict flux, const double* __restrict a, const T* __restrict low,
                   const T* __restrict high, const double* __restrict w_low, const double* __restrict w_high,
                   double factor, int n)
{
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const double d = static_cast<double>(high[i]) - static_cast<double>(low[i]);
    const double F = a[i] * d + 0.5 * (w_low[i] + w_high[i]);
    flux[i] -= a[i] > 0.0 ? factor * F : 0.0;
  }
}

}  // namespace

template <class T>
void CurvilinearCorrection::correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j,
                                              int k) const
{
  const T* value = p.row(j, k);
  const double* w = w_[0].view().row(j, k);
  correct_faces(U.row(j, k), operator_.face()[0].row(j, k), value - 1, value, w - 1, w, factor, grid_.cells()[0] + 1);
}

/// Low faces of row (j, k).  Ranks that share a face run the same loop over the same values, and end with the same
/// bits.
template <class T>
void CurvilinearCorrection::correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor,
                                                int j, int k) const
{
  const int face = axis == 1 ? j : k;
  const bool low_side = grid_.ranks().at_boundary(axis, 0) && face == 0;
  const bool high_side = grid_.ranks().at_boundary(axis, 1) && face == grid_.cells()[axis];
  const View<const double> w = w_[axis].view();
  const double* own = w.row(j, k);
  const double* below = row_beside(w, axis, 0, j, k);
  correct_faces(U.row(j, k), operator_.face()[axis].row(j, k), row_beside(p, axis, 0, j, k), p.row(j, k),
                low_side ? own : below, high_side ? below : own, factor, grid_.cells()[0]);
}

/// Takes the closed parts of faces out of the cross fluxes of a plane.
void CurvilinearCorrection::weigh_cross_fluxes(const View3<double>& U, double factor, int t) const
{
  const auto weigh = [&](const PartialFaces::Beside& beside) {
    const Index3 face = stepped(beside.cell, beside.axis, beside.side);
    const View<const double> w = w_[beside.axis].view();
    U[beside.axis](face) += factor * beside.closed * 0.5 * (w(stepped(face, beside.axis, -1)) + w(face));
  };
  const bool last = t + 1 == grid_.owned().hi[outer_];
  for (const PartialFaces::Beside& beside : beside_partial_.on_plane(t)) {
    if (!beside_partial_.owns(beside.cell))
      continue;
    const bool at_end = beside.cell[beside.axis] + 1 == grid_.owned().hi[beside.axis];
    const bool in_plane = beside.axis != outer_ || last;
    if (beside.side == 0 || (at_end && in_plane))
      weigh(beside);
  }
}

template <class T>
void CurvilinearCorrection::correct_plane_of(const View3<double>& U, const View<const T>& p, double factor, int t)
{
  for_faces(
      t, [&](int j, int k) { correct_along_row(U[0], p, factor, j, k); },
      [&](int axis, int j, int k) { correct_across_rows(axis, U[axis], p, factor, j, k); });
  weigh_cross_fluxes(U, factor, t);
}

void CurvilinearCorrection::correct_plane(const View3<double>& U, const View<const double>& p, double factor, int t)
{
  correct_plane_of(U, p, factor, t);
}

void CurvilinearCorrection::correct_plane(const View3<double>& U, const View<const float>& p, double factor, int t)
{
  correct_plane_of(U, p, factor, t);
}

}  // namespace luff::poisson
