// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/flux_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poisson/stages.hpp"

namespace luff::poisson {

FluxCorrection::FluxCorrection(const grid::Grid& grid, const SideConditions& sides)
    : grid_(grid),
      sides_(sides),
      outer_(grid.cells()[1] > grid.cells()[2] ? 1 : 2),
      zeros_(grid.cells()[0], 0.0),
      float_zeros_(grid.cells()[0], 0.0f)
{
  for (int i = 0; i <= grid.cells()[0]; ++i)
    inverse_distance_x_.push_back(inverse_distance(0, i));
  for (int i = 0; i < grid.cells()[0]; ++i)
    width_x_.push_back(grid.width(0, i));
  set_blocked({});
}

void FluxCorrection::set_blocked(std::span<const FaceIndex> faces)
{
  const IndexBox& owned = grid_.owned();
  const auto plane = [&](const FaceIndex& f) {
    return std::min(f.cell[outer_], owned.hi[outer_] - 1) - owned.lo[outer_];
  };
  blocked_.assign(faces.begin(), faces.end());
  std::sort(blocked_.begin(), blocked_.end(),
            [&](const FaceIndex& a, const FaceIndex& b) { return plane(a) < plane(b); });
  first_blocked_.assign(owned.extent(outer_) + 1, 0);
  for (const FaceIndex& f : blocked_)
    ++first_blocked_[plane(f) + 1];
  for (std::size_t t = 1; t < first_blocked_.size(); ++t)
    first_blocked_[t] += first_blocked_[t - 1];
  kept_.resize(blocked_.size());
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

template <class Row>
void FluxCorrection::for_rows(int t, Row row) const
{
  const int inner = 3 - outer_;
  for (int b = grid_.owned().lo[inner]; b < grid_.owned().hi[inner]; ++b)
    outer_ == 2 ? row(b, t) : row(t, b);
}

std::size_t FluxCorrection::number_of_row(int j, int k) const
{
  const IndexBox& box = grid_.owned();
  return static_cast<std::size_t>(k - box.lo[2]) * box.extent(1) + (j - box.lo[1]);
}

FluxCorrection::Partial FluxCorrection::measure_row(const View3<double>& U, int j, int k, double* net) const
{
  const double* __restrict x = U[0].row(j, k);
  const double* __restrict y = U[1].row(j, k);
  const double* __restrict y_high = U[1].row(j + 1, k);
  const double* __restrict z = U[2].row(j, k);
  const double* __restrict z_high = U[2].row(j, k + 1);
  const double* __restrict width = width_x_.data();
  double* __restrict out = net;
  const int n = grid_.cells()[0];
  const double hy = grid_.width(1, j);
  const double hz = grid_.width(2, k);
  const double narrow = std::min(hy, hz);
  const double wide = std::max(hy, hz);
  double sum = 0.0;
  double norm = 0.0;
  double flux_norm = 0.0;
  double largest = 0.0;
#pragma omp simd reduction(+ : sum, norm, flux_norm) reduction(max : largest)
  for (int i = 0; i < n; ++i) {
    const double outflow = (x[i + 1] - x[i]) + (y_high[i] - y[i]) + (z_high[i] - z[i]);
    // h / V = 1 / (the product of the two wider widths); the common factor 1 / wide follows below.
    const double wider = width[i] > narrow ? width[i] : narrow;
    const double scaled = std::abs(outflow) / wider;
    out[i] = outflow;
    sum += outflow;
    norm += outflow * outflow;
    flux_norm += x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    largest = largest > scaled ? largest : scaled;
  }
  // A NaN or infinity anywhere in the row shows in the norm, but not in a maximum.
  const double poison = 0.0 * norm;
  return {sum, norm, flux_norm, largest / wide + poison};
}

void FluxCorrection::measure_plane(const View3<double>& U, int t, const RowSink& sink,
                                   std::vector<Partial>& partial) const
{
  std::vector<double> net(grid_.cells()[0]);
  for_rows(t, [&](int j, int k) {
    partial[number_of_row(j, k)] = measure_row(U, j, k, net.data());
    sink(j, k, net.data());
  });
}

Index3 FluxCorrection::worst_cell_of_row(const View3<double>& U, std::size_t row) const
{
  const IndexBox& box = grid_.owned();
  const int j = box.lo[1] + static_cast<int>(row) % box.extent(1);
  const int k = box.lo[2] + static_cast<int>(row) / box.extent(1);
  std::vector<double> net(grid_.cells()[0]);
  (void)measure_row(U, j, k, net.data());
  int worst = 0;
  double largest = -1.0;
  for (int i = 0; i < grid_.cells()[0]; ++i) {
    const double h = std::min({grid_.width(0, i), grid_.width(1, j), grid_.width(2, k)});
    const double scaled = std::abs(net[i]) * h / grid_.volume(i, j, k);
    if (!std::isfinite(scaled))
      return {i, j, k};
    if (scaled > largest) {
      largest = scaled;
      worst = i;
    }
  }
  return {worst, j, k};
}

/// Sums in the order of rows: the same on any number of threads.
Outflow FluxCorrection::collect(const View3<double>& U, const std::vector<Partial>& partial) const
{
  std::array<double, 3> sums{0.0, 0.0, 0.0};
  struct {
    double value;
    int rank;
  } largest{-1.0, grid_.ranks().rank()};
  std::size_t worst = 0;
  for (std::size_t row = 0; row < partial.size(); ++row) {
    sums[0] += partial[row].sum;
    sums[1] += partial[row].norm;
    sums[2] += partial[row].flux_norm;
    const double d =
        std::isfinite(partial[row].divergence) ? partial[row].divergence : std::numeric_limits<double>::infinity();
    if (d > largest.value) {
      worst = row;
      largest.value = d;
    }
  }
  Outflow result;
  result.worst_cell = worst_cell_of_row(U, worst);
  const MPI_Comm comm = grid_.ranks().comm();
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
  MPI_Bcast(result.worst_cell.data(), 3, MPI_INT, largest.rank, comm);
  result.sum = sums[0];
  result.norm = std::sqrt(sums[1]);
  result.flux_norm = std::sqrt(sums[2]);
  result.divergence = std::isinf(largest.value) ? std::numeric_limits<double>::quiet_NaN() : largest.value;
  return result;
}

Outflow FluxCorrection::measure(const View3<double>& U, const RowSink& sink) const
{
  const IndexBox& box = grid_.owned();
  std::vector<Partial> partial(static_cast<std::size_t>(box.extent(1)) * box.extent(2));
  run_stages(box.lo[outer_], box.hi[outer_], 1, threads_for(box),
             [&](int, int t) { measure_plane(U, t, sink, partial); });
  return collect(U, partial);
}

template <class T>
void FluxCorrection::correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j, int k) const
{
  const int n = grid_.cells()[0];
  const bool periodic = grid_.ranks().periodic(0);
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
}

/// Low faces of row (j, k).  Ranks that share a face run the same loop over the same values of p, and end with the same
/// bits.
template <class T>
void FluxCorrection::correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor, int j,
                                         int k) const
{
  const int n = grid_.cells()[axis];
  const int face = axis == 1 ? j : k;
  const bool periodic = grid_.ranks().periodic(axis);
  const double c = factor * inverse_distance(axis, face) * (axis == 1 ? grid_.width(2, k) : grid_.width(1, j));
  if (c == 0.0)
    return;
  const T* const zero = zero_row<T>();
  const T* __restrict high = face == n && !periodic ? zero : p.row(j, k);
  const T* __restrict low = face == 0 && !periodic ? zero : axis == 1 ? p.row(j - 1, k) : p.row(j, k - 1);
  const double* __restrict width = width_x_.data();
  double* __restrict flux = U.row(j, k);
  const int cells = grid_.cells()[0];
#pragma omp simd
  for (int i = 0; i < cells; ++i)
    flux[i] -= c * width[i] * (static_cast<double>(high[i]) - static_cast<double>(low[i]));
}

template <class T>
void FluxCorrection::correct_plane(const View3<double>& U, const View<const T>& p, double factor, int t)
{
  const IndexBox& box = grid_.owned();
  const int plane = t - box.lo[outer_];
  for (int n = first_blocked_[plane]; n < first_blocked_[plane + 1]; ++n)
    kept_[n] = U[blocked_[n].axis](blocked_[n].cell);
  for_rows(t, [&](int j, int k) {
    correct_along_row(U[0], p, factor, j, k);
    correct_across_rows(1, U[1], p, factor, j, k);
    correct_across_rows(2, U[2], p, factor, j, k);
  });
  const int inner = 3 - outer_;
  Index3 last{};
  last[outer_] = t;
  last[inner] = box.hi[inner];
  correct_across_rows(inner, U[inner], p, factor, last[1], last[2]);
  if (t + 1 == box.hi[outer_])
    for_rows(t, [&](int j, int k) {
      correct_across_rows(outer_, U[outer_], p, factor, outer_ == 1 ? j + 1 : j, outer_ == 2 ? k + 1 : k);
    });
  for (int n = first_blocked_[plane]; n < first_blocked_[plane + 1]; ++n)
    U[blocked_[n].axis](blocked_[n].cell) = kept_[n];
}

template <class T>
Outflow FluxCorrection::correct(const View3<double>& U, const View<const T>& p, double factor, const PlaneWork& prepare,
                                const RowSink& sink)
{
  const IndexBox& box = grid_.owned();
  std::vector<Partial> partial(static_cast<std::size_t>(box.extent(1)) * box.extent(2));
  run_stages(box.lo[outer_], box.hi[outer_], 3, threads_for(box), [&](int stage, int t) {
    if (stage == 0)
      prepare(t);
    else if (stage == 1)
      correct_plane(U, p, factor, t);
    else
      measure_plane(U, t, sink, partial);
  });
  return collect(U, partial);
}

template <class T>
void FluxCorrection::subtract(const View3<double>& U, const View<const T>& p, double factor)
{
  const IndexBox& box = grid_.owned();
  run_stages(box.lo[outer_], box.hi[outer_], 1, threads_for(box),
             [&](int, int t) { correct_plane(U, p, factor, t); });
}

template void FluxCorrection::subtract(const View3<double>&, const View<const double>&, double);
template Outflow FluxCorrection::correct(const View3<double>&, const View<const double>&, double, const PlaneWork&,
                                         const RowSink&);
template Outflow FluxCorrection::correct(const View3<double>&, const View<const float>&, double, const PlaneWork&,
                                         const RowSink&);

}  // namespace luff::poisson
