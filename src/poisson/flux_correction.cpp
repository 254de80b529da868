// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/flux_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poisson/curvilinear_correction.hpp"
#include "poisson/rectilinear_correction.hpp"
#include "poisson/stages.hpp"

namespace luff::poisson {

FluxCorrection::FluxCorrection(const grid::Grid& grid, const SideConditions& sides)
    : grid_(grid), sides_(sides), outer_(grid.cells()[1] > grid.cells()[2] ? 1 : 2)
{
}

void FluxCorrection::set_blocked(std::span<const FaceIndex> faces)
{
  std::vector<Index3> cells = isolated_cells(grid_, sides_, faces);
  std::sort(cells.begin(), cells.end(), [&](const Index3& a, const Index3& b) {
    return std::pair(number_of_row(a[1], a[2]), a[0]) < std::pair(number_of_row(b[1], b[2]), b[0]);
  });
  isolated_.clear();
  first_isolated_.clear();
  if (cells.empty())
    return;
  first_isolated_.assign(static_cast<std::size_t>(grid_.owned().extent(1)) * grid_.owned().extent(2) + 1, 0);
  for (const Index3& c : cells) {
    isolated_.push_back(c[0]);
    ++first_isolated_[number_of_row(c[1], c[2]) + 1];
  }
  for (std::size_t row = 1; row < first_isolated_.size(); ++row)
    first_isolated_[row] += first_isolated_[row - 1];
}

std::size_t FluxCorrection::number_of_row(int j, int k) const
{
  const IndexBox& box = grid_.owned();
  return static_cast<std::size_t>(k - box.lo[2]) * box.extent(1) + (j - box.lo[1]);
}

void FluxCorrection::forget_isolated(int j, int k, double* net) const
{
  if (first_isolated_.empty())
    return;
  const std::size_t row = number_of_row(j, k);
  for (int n = first_isolated_[row]; n < first_isolated_[row + 1]; ++n)
    net[isolated_[n]] = 0.0;
}

FluxCorrection::Partial FluxCorrection::measure_row(const View3<double>& U, int j, int k, double* net) const
{
  const double* __restrict x = U[0].row(j, k);
  const double* __restrict y = U[1].row(j, k);
  const double* __restrict y_high = U[1].row(j + 1, k);
  const double* __restrict z = U[2].row(j, k);
  const double* __restrict z_high = U[2].row(j, k + 1);
  double* __restrict out = net;
  const int n = grid_.cells()[0];
  double flux_norm = 0.0;
#pragma omp simd reduction(+ : flux_norm)
  for (int i = 0; i < n; ++i) {
    out[i] = (x[i + 1] - x[i]) + (y_high[i] - y[i]) + (z_high[i] - z[i]);
    flux_norm += x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
  }
  forget_isolated(j, k, net);
  double sum = 0.0;
  double norm = 0.0;
#pragma omp simd reduction(+ : sum, norm)
  for (int i = 0; i < n; ++i) {
    sum += out[i];
    norm += out[i] * out[i];
  }
  // A NaN or infinity anywhere in the row shows in the norm, but not in a maximum.
  const double poison = 0.0 * norm;
  return {sum, norm, flux_norm, largest_divergence(net, j, k) + poison};
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
    const double scaled = std::abs(net[i]) * width_over_volume({i, j, k});
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
Outflow FluxCorrection::correct(const View3<double>& U, const View<const T>& p, double factor, const PlaneWork& prepare,
                                const RowSink& sink)
{
  const IndexBox& box = grid_.owned();
  std::vector<Partial> partial(static_cast<std::size_t>(box.extent(1)) * box.extent(2));
  const int prepared = prepares_planes() ? 2 : 1;
  run_stages(box.lo[outer_], box.hi[outer_], prepared + 2, threads_for(box), [&](int stage, int t) {
    if (stage == 0)
      prepare(t);
    else if (stage < prepared)
      prepare_plane(p, t);
    else if (stage == prepared)
      correct_plane(U, p, factor, t);
    else
      measure_plane(U, t, sink, partial);
  });
  return collect(U, partial);
}

void FluxCorrection::subtract(const View3<double>& U, const View<const double>& p, double factor)
{
  const IndexBox& box = grid_.owned();
  run_stages(box.lo[outer_], box.hi[outer_], prepares_planes() ? 2 : 1, threads_for(box), [&](int stage, int t) {
    if (stage == 0 && prepares_planes())
      prepare_plane(p, t);
    else
      correct_plane(U, p, factor, t);
  });
}

template Outflow FluxCorrection::correct(const View3<double>&, const View<const double>&, double, const PlaneWork&,
                                         const RowSink&);
template Outflow FluxCorrection::correct(const View3<double>&, const View<const float>&, double, const PlaneWork&,
                                         const RowSink&);

std::unique_ptr<FluxCorrection> make_flux_correction(const grid::Grid& grid, const SideConditions& sides)
{
  if (grid.kind() == grid::Kind::Curvilinear)
    return std::make_unique<CurvilinearCorrection>(grid, sides);
  return std::make_unique<RectilinearCorrection>(grid, sides);
}

std::vector<Index3> isolated_cells(const grid::Grid& grid, const SideConditions& sides,
                                   std::span<const FaceIndex> blocked)
{
  const Decomposition& ranks = grid.ranks();
  std::vector<Index3> cells;  // once for every blocked face
  for (const FaceIndex& f : blocked) {
    if (f.open > 0.0)
      continue;
    for (const int step : {0, -1}) {
      Index3 c = stepped(f.cell, f.axis, step);
      const int n = grid.cells()[f.axis];
      if (ranks.periodic(f.axis) && ranks.blocks(f.axis) == 1) {
        if (f.cell[f.axis] == n)
          continue;  // listed as face 0 too
        c[f.axis] = (c[f.axis] + n) % n;
      }
      if (grid.owned().contains(c))
        cells.push_back(c);
    }
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Index3> isolated;
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last = std::upper_bound(first, cells.end(), *first);
    auto closed = last - first;
    for (int a = 0; a < 3; ++a)
      for (int side = 0; side < 2; ++side) {
        const bool at_end = (*first)[a] == (side == 0 ? 0 : grid.cells()[a] - 1);
        closed += ranks.periodic(a) ? (grid.cells()[a] == 1 ? 1 : 0)
                                    : (at_end && sides[a][side] == SideCondition::Neumann ? 1 : 0);
      }
    if (closed >= 6)
      isolated.push_back(*first);
    first = last;
  }
  return isolated;
}

namespace {

/// visit(inside, beyond) for the cells on Dirichlet sides of this rank, edges of the halo included.
template <class Visit>
void for_dirichlet_sides(const grid::Grid& grid, const SideConditions& sides, Visit visit)
{
  const IndexBox& owned = grid.owned();
  for (int a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side) {
      if (sides[a][side] != SideCondition::Dirichlet || !grid.ranks().at_boundary(a, side))
        continue;
      IndexBox box = owned.grown(1);
      box.lo[a] = side == 0 ? owned.lo[a] : owned.hi[a] - 1;
      box.hi[a] = box.lo[a] + 1;
      for_each_cell_in_order(box, [&](int i, int j, int k) {
        const Index3 inside{i, j, k};
        visit(inside, stepped(inside, a, side == 0 ? -1 : 1));
      });
    }
}

}  // namespace

template <class T>
void mirror_beyond_sides(const grid::Grid& grid, const SideConditions& sides, const View<T>& p)
{
  for_dirichlet_sides(grid, sides, [&](const Index3& inside, const Index3& beyond) { p(beyond) = -p(inside); });
}

template void mirror_beyond_sides(const grid::Grid&, const SideConditions&, const View<double>&);
template void mirror_beyond_sides(const grid::Grid&, const SideConditions&, const View<float>&);

SidePressure::SidePressure(const grid::Grid& grid, const SideConditions& sides, const View<const double>& p)
{
  for_dirichlet_sides(grid, sides, [&](const Index3& inside, const Index3& beyond) {
    if (grid.owned().contains(inside))
      values_.push_back({inside, beyond, 0.5 * (p(inside) + p(beyond))});
  });
}

void SidePressure::restore(const View<double>& p) const
{
  for (const Value& v : values_)
    p(v.beyond) = 2.0 * v.value - p(v.inside);
}

}  // namespace luff::poisson
