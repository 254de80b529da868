// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/multigrid_solver.hpp"

#include "parallel/denormals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace luff::poisson {

namespace {

/// Single precision gains at most about six digits in a round; conjugate gradients stop earlier where it gains fewer.
constexpr double round_tolerance = 5e-7;

Index3 longest_last(const Index3& cells)
{
  return cells[1] > cells[2] ? Index3{0, 2, 1} : Index3{0, 1, 2};
}

std::vector<FaceIndex> gather_faces(MPI_Comm comm, const std::vector<FaceIndex>& own)
{
  static_assert(sizeof(FaceIndex) == 4 * sizeof(int));
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  const int count = static_cast<int>(4 * own.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 1; r < ranks; ++r)
    starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<FaceIndex> all((starts.back() + counts.back()) / 4);
  MPI_Allgatherv(own.data(), count, MPI_INT, all.data(), counts.data(), starts.data(), MPI_INT, comm);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

MultigridSolver::MultigridSolver(const grid::Grid& grid, const SideConditions& sides)
    : grid_(grid),
      axis_(longest_last(grid.cells())),
      unit_(grid.smallest_width()),
      neighbourhood_(neighbourhood()),
      multigrid_(make_box(sides), IndexBox{internal(grid.owned().lo), internal(grid.owned().hi)}, neighbourhood_),
      inner_(multigrid_, grid.ranks().comm()),
      fluxes_(grid, sides),
      halo_(grid.ranks()),
      net_(grid.owned()),
      correction_(grid.owned())
{
  flush_denormals();
  label_components();
}

MultigridSolver::~MultigridSolver() = default;

Neighbourhood MultigridSolver::neighbourhood() const
{
  Neighbourhood result;
  result.comm = grid_.ranks().comm();
  for (int a = 0; a < 3; ++a) {
    result.ranks[a] = grid_.ranks().neighbours(axis_[a]);
    result.split[a] = grid_.ranks().blocks(axis_[a]) > 1;
  }
  return result;
}

Box MultigridSolver::make_box(const SideConditions& sides) const
{
  Box box;
  for (int a = 0; a < 3; ++a) {
    const int axis = axis_[a];
    std::vector<double> h;
    for (int i = 0; i < grid_.cells()[axis]; ++i)
      h.push_back(grid_.width(axis, i) / unit_);
    box.lines[a] = make_line(std::move(h), grid_.ranks().periodic(axis), sides[axis], grid_.ranks().splits(axis));
  }
  return box;
}

void MultigridSolver::set_blocked(std::span<const FaceIndex> faces)
{
  std::vector<FaceIndex> sorted(faces.begin(), faces.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (grid_.ranks().max(sorted == blocked_ ? 0.0 : 1.0) == 0.0)
    return;
  blocked_ = std::move(sorted);
  fluxes_.set_blocked(blocked_);
  std::vector<FaceIndex> all = gather_faces(grid_.ranks().comm(), blocked_);
  for (FaceIndex& face : all) {
    face.cell = internal(face.cell);
    face.axis = face.axis == 0 ? 0 : axis_[face.axis];
  }
  multigrid_.set_blocked(all);
  label_components();
}

void MultigridSolver::label_components()
{
  multigrid_.label_components(component_, floating_);
}

/// Subtracts from each floating component its mean, weighted by volume or not.
void MultigridSolver::remove_means(const View<double>& values, bool by_volume) const
{
  if (std::none_of(floating_.begin(), floating_.end(), [](char f) { return f != 0; }))
    return;
  const std::vector<double> mean = component_.empty() ? mean_of_all(values, by_volume) : means(values, by_volume);
  for_each_row(grid_.owned(), [&](int begin, int end, int j, int k) {
    double* __restrict row = values.row(j, k);
    if (component_.empty()) {
#pragma omp simd
      for (int i = begin; i < end; ++i)
        row[i] -= mean[0];
    } else {
      for (int i = begin; i < end; ++i)
        row[i] -= mean[component_of({i, j, k})];
    }
  });
}

std::vector<double> MultigridSolver::mean_of_all(const View<const double>& values, bool by_volume) const
{
  const IndexBox& box = grid_.owned();
  std::vector<double> width(box.extent(0), 1.0);
  for (int i = 0; by_volume && i < box.extent(0); ++i)
    width[i] = grid_.width(0, i);
  const double row_width = std::accumulate(width.begin(), width.end(), 0.0);
  std::vector<double> partial(static_cast<std::size_t>(box.extent(1)) * box.extent(2));
  const auto area = [&](int j, int k) { return by_volume ? grid_.width(1, j) * grid_.width(2, k) : 1.0; };
  for_each_row(box, [&](int begin, int end, int j, int k) {
    const double* __restrict row = values.row(j, k);
    const double* __restrict w = width.data();
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int i = begin; i < end; ++i)
      sum += w[i] * row[i];
    partial[static_cast<std::size_t>(k - box.lo[2]) * box.extent(1) + (j - box.lo[1])] = sum * area(j, k);
  });
  std::array<double, 2> sums{std::accumulate(partial.begin(), partial.end(), 0.0), 0.0};
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      sums[1] += row_width * area(j, k);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  return {sums[0] / sums[1]};
}

/// Means over the floating components; 0 for the others.
std::vector<double> MultigridSolver::means(const View<const double>& values, bool by_volume) const
{
  const IndexBox& box = grid_.owned();
  std::vector<double> sums(2 * floating_.size(), 0.0);
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i) {
        const std::size_t c = component_of({i, j, k});
        const double weight = by_volume ? grid_.volume(i, j, k) : 1.0;
        sums[2 * c] += weight * values(i, j, k);
        sums[2 * c + 1] += weight;
      }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  std::vector<double> result(floating_.size(), 0.0);
  for (std::size_t c = 0; c < result.size(); ++c)
    if (floating_[c] != 0 && sums[2 * c + 1] > 0.0)
      result[c] = sums[2 * c] / sums[2 * c + 1];
  return result;
}

std::size_t MultigridSolver::component_of(const Index3& cell) const
{
  const IndexBox& box = multigrid_.finest().layout().owned;
  const Index3 c = internal(cell);
  return component_[(c[0] - box.lo[0]) +
                    static_cast<std::size_t>(box.extent(0)) *
                        ((c[1] - box.lo[1]) + static_cast<std::size_t>(box.extent(1)) * (c[2] - box.lo[2]))];
}

/// f = scale (values - shift) on one row.
void MultigridSolver::load_row(int j, int k, const double* values, double shift, double scale)
{
  Level& level = multigrid_.finest();
  const Index3 c = internal({0, j, k});
  for (int q = 0; q < 2; ++q) {
    float* __restrict f = level.f.data() + level.layout().start(c[1], c[2], (q + j + k) & 1);
    const double* __restrict row = values;
    const int m = level.layout().count(q);
#pragma omp simd
    for (int n = 0; n < m; ++n)
      f[n] = static_cast<float>(scale * (row[2 * n + q] - shift));
  }
}

void MultigridSolver::unload_row(int j, int k)
{
  const Layout& layout = multigrid_.finest().layout();
  const Index3 c = internal({0, j, k});
  const float* __restrict even = inner_.solution().data() + layout.start(c[1], c[2], (j + k) & 1);
  const float* __restrict odd = inner_.solution().data() + layout.start(c[1], c[2], (j + k + 1) & 1);
  float* __restrict to = correction_.view().row(j, k);
  const int n = grid_.cells()[0];
#pragma omp simd
  for (int t = 0; t < n / 2; ++t) {
    to[2 * t] = even[t];
    to[2 * t + 1] = odd[t];
  }
  if (n % 2 == 1)
    to[n - 1] = even[n / 2];
}

/// The correction on plane t along the outer axis, halo rows included, and its part in the pressure.
void MultigridSolver::unload_plane(int t, const View<double>& p, double to_pressure)
{
  const IndexBox& owned = grid_.owned();
  const int outer = fluxes_.outer_axis();
  const int inner = 3 - outer;
  const auto unload = [&](int b, int plane) { outer == 2 ? unload_row(b, plane) : unload_row(plane, b); };
  for (int b = owned.lo[inner] - 1; b <= owned.hi[inner]; ++b) {
    unload(b, t);
    if (t == owned.lo[outer])
      unload(b, t - 1);
    if (t == owned.hi[outer] - 1)
      unload(b, t + 1);
  }
  for (int b = owned.lo[inner]; b < owned.hi[inner]; ++b) {
    const int j = outer == 2 ? b : t;
    const int k = outer == 2 ? t : b;
    const float* __restrict e = correction_.view().row(j, k);
    double* __restrict pressure = p.row(j, k);
    const int n = grid_.cells()[0];
#pragma omp simd
    for (int i = 0; i < n; ++i)
      pressure[i] += to_pressure * static_cast<double>(e[i]);
  }
}

/// Loads the right-hand side of the next round, minus its means over floating components, scaled to norm one; returns
/// its norm before that.  The usual single component needs no labels and one pass.
double MultigridSolver::load_right_hand_side(const Outflow& outflow)
{
  const View<double> net = net_.view();
  const auto cells = static_cast<double>(grid_.cells()[0]) * grid_.cells()[1] * grid_.cells()[2];
  const bool one = component_.empty();
  const double mean = one && floating_[0] != 0 ? -outflow.sum / cells : 0.0;
  const double removed = cells * mean * mean;
  double norm = std::sqrt(std::max(0.0, outflow.norm * outflow.norm - removed));
  double shift = mean;
  if (!one || removed > 1e-6 * outflow.norm * outflow.norm) {
    remove_means(net, /*by_volume=*/false);
    norm = std::sqrt(
        grid_.ranks().sum(sum_cells(grid_.owned(), [=](int i, int j, int k) { return net(i, j, k) * net(i, j, k); })));
    shift = 0.0;
  }
  scale_ = norm > 0.0 ? 1.0 / norm : 0.0;
  for_each_row(grid_.owned(), [&](int, int, int j, int k) { load_row(j, k, net.row(j, k), shift, scale_); });
  return norm;
}

/// No more digits than are missing, nor than single precision gives.
double MultigridSolver::inner_tolerance(const Outflow& outflow, double initial_norm, const Target& target) const
{
  double missing = 0.0;
  if (target.relative > 0.0)
    missing = std::max(missing, target.relative * initial_norm / outflow.norm);
  if (target.divergence > 0.0)
    missing = std::max(missing, target.divergence * target.speed / outflow.divergence);
  return std::clamp(0.5 * missing, round_tolerance, 0.3);
}

void MultigridSolver::subtract_gradient(const View3<double>& U, const View<double>& p, double dt)
{
  halo_.exchange({p});
  fluxes_.subtract<double>(U, p, dt);
}

Report MultigridSolver::project(const View3<double>& U, const View<double>& p, double dt, const Target& target)
{
  const auto ignore = [](int, int, const double*) {};
  const auto to_net = [&](int j, int k, const double* outflow) {
    std::transform(outflow, outflow + grid_.cells()[0], net_.view().row(j, k), std::negate<>());
  };
  const double initial_norm = target.relative > 0.0 ? fluxes_.measure(U, ignore).norm : 0.0;
  halo_.exchange({p});
  Outflow outflow = fluxes_.correct<double>(
      U, p, dt, [](int) {}, to_net);
  double norm = std::isfinite(outflow.norm) ? load_right_hand_side(outflow) : outflow.norm;
  Report report;
  while (!meets(outflow, initial_norm, target) && report.iterations < target.max_iterations && std::isfinite(norm)) {
    // Below round-off of the fluxes conjugate gradients would only stir noise.  But on stretched grids the round-off of
    // the large cells can dominate the norm while a small one beside a sheet still holds something to correct: the last
    // digit is always worth trying, and what it does not improve is taken back.
    const double round_off = 0.5 * std::numeric_limits<double>::epsilon() * outflow.flux_norm;
    const double tolerance = std::max(std::min(0.1, round_off / norm), inner_tolerance(outflow, initial_norm, target));
    const auto inner = inner_.solve(tolerance, target.max_iterations - report.iterations);
    report.iterations += inner.iterations;
    if (!inner.finite)
      break;
    const double factor = 1.0 / (scale_ * unit_);
    const auto add = [&](double sign, const FluxCorrection::RowSink& sink) {
      return fluxes_.correct<float>(
          U, std::as_const(correction_).view(), sign * factor, [&](int t) { unload_plane(t, p, sign * factor / dt); },
          sink);
    };
    const Outflow corrected = add(1.0, to_net);
    const double corrected_norm = load_right_hand_side(corrected);
    ++report.refinements;
    if (!(corrected_norm < 0.9 * norm || corrected.divergence < 0.9 * outflow.divergence)) {
      outflow = add(-1.0, ignore);
      break;
    }
    outflow = corrected;
    norm = corrected_norm;
  }
  remove_means(p, /*by_volume=*/true);
  halo_.exchange({p});
  report.divergence = relative_divergence(outflow, target);
  report.worst_cell = outflow.worst_cell;
  report.converged = meets(outflow, initial_norm, target);
  return report;
}

}  // namespace luff::poisson
