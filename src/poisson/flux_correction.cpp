// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/flux_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luff::poisson {

FluxCorrection::FluxCorrection(const grid::Grid& grid, const SideConditions& sides) : grid_(grid), sides_(sides)
{
  for (int i = 0; i <= grid.cells()[0]; ++i)
    inverse_distance_x_.push_back(inverse_distance(0, i));
}

/// 1/d of a face: between centres, or between centre and face where p = 0 on it; 0 where no gradient acts.
double FluxCorrection::inverse_distance(int axis, int face) const
{
  const int n = grid_.cells()[axis];
  const bool periodic = grid_.ranks().periodic(axis);
  if ((face > 0 && face < n) || (periodic && n > 1))
    return 1.0 / grid_.distance(axis, face);
  if (periodic)
    return 0.0;
  const int side = face == 0 ? 0 : 1;
  return sides_[axis][side] == SideCondition::Dirichlet ? 2.0 / grid_.width(axis, side == 0 ? 0 : n - 1) : 0.0;
}

Outflow FluxCorrection::measure(const View3<double>& U, const View<double>& net) const
{
  const IndexBox& box = grid_.owned();
  const int nj = box.extent(1);
  struct Partial {
    double norm = 0.0, flux_norm = 0.0, divergence = 0.0, poison = 0.0;
  };
  std::vector<Partial> partial(static_cast<std::size_t>(nj) * box.extent(2));
  for_each_row(box, [&](int begin, int end, int j, int k) {
    const double* __restrict x = U[0].row(j, k);
    const double* __restrict y = U[1].row(j, k);
    const double* __restrict y_high = U[1].row(j + 1, k);
    const double* __restrict z = U[2].row(j, k);
    const double* __restrict z_high = U[2].row(j, k + 1);
    double* __restrict out = net.row(j, k);
    const double hy = grid_.width(1, j);
    const double hz = grid_.width(2, k);
    const double narrow = std::min(hy, hz);
    double norm = 0.0;
    double flux_norm = 0.0;
    double largest = 0.0;
    double poison = 0.0;
#pragma omp simd reduction(+ : norm, flux_norm, poison) reduction(max : largest)
    for (int i = begin; i < end; ++i) {
      const double outflow = (x[i + 1] - x[i]) + (y_high[i] - y[i]) + (z_high[i] - z[i]);
      const double hx = grid_.width(0, i);
      const double scaled = std::abs(outflow) * (hx < narrow ? hx : narrow) / (hx * hy * hz);
      out[i] = -outflow;
      norm += outflow * outflow;
      flux_norm += x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
      largest = largest > scaled ? largest : scaled;
      poison += 0.0 * outflow;
    }
    partial[static_cast<std::size_t>(k - box.lo[2]) * nj + (j - box.lo[1])] = {norm, flux_norm, largest, poison};
  });
  double sums[2] = {0.0, 0.0};
  Outflow result;
  std::size_t worst = 0;
  for (std::size_t row = 0; row < partial.size(); ++row) {
    sums[0] += partial[row].norm;
    sums[1] += partial[row].flux_norm;
    const double d = partial[row].divergence + partial[row].poison;
    if (!(d <= result.divergence)) {
      worst = row;
      result.divergence = d;
      if (std::isnan(d))
        break;
    }
  }
  const int j = box.lo[1] + static_cast<int>(worst) % nj;
  const int k = box.lo[2] + static_cast<int>(worst) / nj;
  const auto scaled = [&](int i) {
    const double h = std::min({grid_.width(0, i), grid_.width(1, j), grid_.width(2, k)});
    return std::abs(net(i, j, k)) * h / grid_.volume(i, j, k);
  };
  int i_worst = box.lo[0];
  for (int i = box.lo[0]; i < box.hi[0]; ++i)
    if (std::isnan(scaled(i)) || scaled(i) > scaled(i_worst)) {
      i_worst = i;
      if (std::isnan(scaled(i)))
        break;
    }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  result.norm = std::sqrt(sums[0]);
  result.flux_norm = std::sqrt(sums[1]);
  struct {
    double value;
    int rank;
  } largest{std::isnan(result.divergence) ? std::numeric_limits<double>::infinity() : result.divergence,
            grid_.ranks().rank()};
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, grid_.ranks().comm());
  result.worst_cell = {i_worst, j, k};
  MPI_Bcast(result.worst_cell.data(), 3, MPI_INT, largest.rank, grid_.ranks().comm());
  result.divergence = std::isinf(largest.value) ? std::numeric_limits<double>::quiet_NaN() : largest.value;
  return result;
}

template <class T>
void FluxCorrection::correct_along_rows(const View<double>& U, const View<const T>& p, double factor) const
{
  const int n = grid_.cells()[0];
  const bool periodic = grid_.ranks().periodic(0);
  for_each_row(grid_.owned(), [&](int, int, int j, int k) {
    double* __restrict flux = U.row(j, k);
    const T* __restrict value = p.row(j, k);
    const double* __restrict inverse_d = inverse_distance_x_.data();
    const double c = factor * grid_.width(1, j) * grid_.width(2, k);
#pragma omp simd
    for (int i = 1; i < n; ++i)
      flux[i] -= c * inverse_d[i] * (static_cast<double>(value[i]) - static_cast<double>(value[i - 1]));
    const double below = periodic ? value[n - 1] : T{0};
    const double above = periodic ? value[0] : T{0};
    flux[0] -= c * inverse_d[0] * (value[0] - below);
    flux[n] -= c * inverse_d[n] * (above - value[n - 1]);
  });
}

/// Ranks that share a face run the same loop over the same values of p, and end with the same bits.
template <class T>
void FluxCorrection::correct_axis(int axis, const View<double>& U, const View<const T>& p, double factor) const
{
  const IndexBox& owned = grid_.owned();
  const int n = grid_.cells()[axis];
  const std::vector<T> beyond(owned.extent(0), T{0});
  for_each_row(owned.faces(axis), [&](int begin, int end, int j, int k) {
    const int face = axis == 1 ? j : k;
    const double c = factor * inverse_distance(axis, face) * (axis == 1 ? grid_.width(2, k) : grid_.width(1, j));
    const bool periodic = grid_.ranks().periodic(axis);
    const T* __restrict high = face == n && !periodic ? beyond.data() : p.row(j, k);
    const T* __restrict low = face == 0 && !periodic ? beyond.data() : axis == 1 ? p.row(j - 1, k) : p.row(j, k - 1);
    double* __restrict flux = U.row(j, k);
#pragma omp simd
    for (int i = begin; i < end; ++i)
      flux[i] -= c * grid_.width(0, i) * (static_cast<double>(high[i]) - static_cast<double>(low[i]));
  });
}

template <class T>
void FluxCorrection::correct(const View3<double>& U, const View<const T>& p, double factor)
{
  kept_.resize(blocked_.size());
  for (std::size_t n = 0; n < blocked_.size(); ++n)
    kept_[n] = U[blocked_[n].axis](blocked_[n].cell);
  correct_along_rows(U[0], p, factor);
  correct_axis(1, U[1], p, factor);
  correct_axis(2, U[2], p, factor);
  for (std::size_t n = 0; n < blocked_.size(); ++n)
    U[blocked_[n].axis](blocked_[n].cell) = kept_[n];
}

template void FluxCorrection::correct(const View3<double>&, const View<const double>&, double);
template void FluxCorrection::correct(const View3<double>&, const View<const float>&, double);

}  // namespace luff::poisson
