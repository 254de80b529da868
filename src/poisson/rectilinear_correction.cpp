// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/rectilinear_correction.hpp"

#include <algorithm>
#include <cmath>

namespace luff::poisson {

RectilinearCorrection::RectilinearCorrection(const grid::Grid& grid, const SideConditions& sides)
    : FluxCorrection(grid, sides)
{
  for (int i = 0; i <= grid.cells()[0]; ++i)
    inverse_distance_x_.push_back(inverse_distance(0, i));
  for (int i = 0; i < grid.cells()[0]; ++i)
    width_x_.push_back(grid.width(0, i));
  set_blocked({});
}

void RectilinearCorrection::set_blocked(std::span<const FaceIndex> faces)
{
  FluxCorrection::set_blocked(faces);
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

/// 1/d of a face, beyond Dirichlet sides to the mirrored centre; 0 where no gradient acts.
double RectilinearCorrection::inverse_distance(int axis, int face) const
{
  const int n = grid_.cells()[axis];
  const bool periodic = grid_.ranks().periodic(axis);
  if ((face > 0 && face < n) || (periodic && n > 1))
    return 1.0 / grid_.distance(axis, face);
  if (periodic)
    return 0.0;
  const int side = face == 0 ? 0 : 1;
  return sides_[axis][side] == SideCondition::Dirichlet ? 1.0 / grid_.width(axis, side == 0 ? 0 : n - 1) : 0.0;
}

double RectilinearCorrection::largest_divergence(const double* net, int j, int k) const
{
  const double* __restrict outflow = net;
  const double* __restrict width = width_x_.data();
  const double narrow = std::min(grid_.width(1, j), grid_.width(2, k));
  const double wide = std::max(grid_.width(1, j), grid_.width(2, k));
  const int n = grid_.cells()[0];
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (int i = 0; i < n; ++i) {
    // h / V = 1 / (the product of the two wider widths); the common factor 1 / wide follows below.
    const double wider = width[i] > narrow ? width[i] : narrow;
    const double scaled = std::abs(outflow[i]) / wider;
    largest = largest > scaled ? largest : scaled;
  }
  return largest / wide;
}

double RectilinearCorrection::width_over_volume(const Index3& c) const
{
  const double h = std::min({grid_.width(0, c[0]), grid_.width(1, c[1]), grid_.width(2, c[2])});
  return h / grid_.volume(c[0], c[1], c[2]);
}

template <class T>
void RectilinearCorrection::correct_along_row(const View<double>& U, const View<const T>& p, double factor, int j,
                                              int k) const
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
  const double below = periodic ? value[n - 1] : value[-1];
  const double above = periodic ? value[0] : value[n];
  flux[0] -= c * inverse_d[0] * (value[0] - below);
  flux[n] -= c * inverse_d[n] * (above - value[n - 1]);
}

/// Low faces of row (j, k).  Ranks that share a face run the same loop over the same values of p, and end with the same
/// bits.
template <class T>
void RectilinearCorrection::correct_across_rows(int axis, const View<double>& U, const View<const T>& p, double factor,
                                                int j, int k) const
{
  const int face = axis == 1 ? j : k;
  const double c = factor * inverse_distance(axis, face) * (axis == 1 ? grid_.width(2, k) : grid_.width(1, j));
  if (c == 0.0)
    return;
  const T* __restrict high = p.row(j, k);
  const T* __restrict low = axis == 1 ? p.row(j - 1, k) : p.row(j, k - 1);
  const double* __restrict width = width_x_.data();
  double* __restrict flux = U.row(j, k);
  const int cells = grid_.cells()[0];
#pragma omp simd
  for (int i = 0; i < cells; ++i)
    flux[i] -= c * width[i] * (static_cast<double>(high[i]) - static_cast<double>(low[i]));
}

template <class T>
void RectilinearCorrection::correct_plane_of(const View3<double>& U, const View<const T>& p, double factor, int t)
{
  const int plane = t - grid_.owned().lo[outer_];
  for (int n = first_blocked_[plane]; n < first_blocked_[plane + 1]; ++n)
    kept_[n] = U[blocked_[n].axis](blocked_[n].cell);
  for_faces(
      t, [&](int j, int k) { correct_along_row(U[0], p, factor, j, k); },
      [&](int axis, int j, int k) { correct_across_rows(axis, U[axis], p, factor, j, k); });
  for (int n = first_blocked_[plane]; n < first_blocked_[plane + 1]; ++n) {
    const FaceIndex& f = blocked_[n];
    double& flux = U[f.axis](f.cell);
    flux = f.open > 0.0 ? kept_[n] + f.open * (flux - kept_[n]) : kept_[n];
  }
}

void RectilinearCorrection::correct_plane(const View3<double>& U, const View<const double>& p, double factor, int t)
{
  correct_plane_of(U, p, factor, t);
}

void RectilinearCorrection::correct_plane(const View3<double>& U, const View<const float>& p, double factor, int t)
{
  correct_plane_of(U, p, factor, t);
}

}  // namespace luff::poisson
