// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/multigrid_solver.hpp"

#include "parallel/denormals.hpp"
#include "poisson/partial_faces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace luff::poisson {

namespace {

double sum_of(const IndexBox& box, const View<const double>& values)
{
  return sum_cells(box, [=] LUFF_KERNEL(int i, int j, int k) { return values(i, j, k); });
}

double sum_of_squares(const IndexBox& box, const View<const double>& values)
{
  return sum_cells(box, [=] LUFF_KERNEL(int i, int j, int k) { return values(i, j, k) * values(i, j, k); });
}

template <class Metric>
LUFF_INLINE_KERNEL double volume_of(const Metric& metric, int i, int j, int k)
{
  if constexpr (grid::is_curvilinear<Metric>)
    return metric.V(i, j, k);
  else
    return metric.volume(i, j, k);
}

/// Sums of V values and of V over the cells of a box.
template <class Metric>
std::array<double, 2> sums_by_volume(const Metric metric, const IndexBox& box, const View<const double>& values)
{
  return {sum_cells(box, [=] LUFF_KERNEL(int i, int j, int k) { return volume_of(metric, i, j, k) * values(i, j, k); }),
          sum_cells(box, [=] LUFF_KERNEL(int i, int j, int k) { return volume_of(metric, i, j, k); })};
}

/// Single precision gains at most about six digits in a round; conjugate gradients stop earlier where it gains fewer.
constexpr double round_tolerance = 5e-7;
/// Cosine above which a multigrid that knows of the cross terms is worth its price (docs/numerics/poisson.md).
constexpr double strong_skew = 0.85;

Index3 longest_last(const Index3& cells)
{
  return cells[1] > cells[2] ? Index3{0, 2, 1} : Index3{0, 1, 2};
}

}  // namespace

MultigridSolver::MultigridSolver(const grid::Grid& grid, const SideConditions& sides)
    : grid_(grid),
      sides_(sides),
      axis_(longest_last(grid.cells())),
      unit_(grid.smallest_width()),
      neighbourhood_(neighbourhood()),
      fluxes_(make_fluxes(sides)),
      multigrid_(make_box(sides), IndexBox{internal(grid.owned().lo), internal(grid.owned().hi)}, neighbourhood_,
                 coefficient_source()),
      halo_(grid.ranks()),
      net_(grid.owned()),
      correction_(grid.owned())
{
  flush_denormals();
  if (curvilinear_ != nullptr)
    make_cross_terms();
  inner_ = std::make_unique<ConjugateGradients>(multigrid_, cross_terms_.get(), grid.ranks().comm());
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

std::unique_ptr<FluxCorrection> MultigridSolver::make_fluxes(const SideConditions& sides)
{
  if (grid_.kind() != grid::Kind::Curvilinear)
    return make_flux_correction(grid_, sides);
  auto fluxes = std::make_unique<CurvilinearCorrection>(grid_, sides);
  curvilinear_ = fluxes.get();
  return fluxes;
}

/// Means of V/S_a over the cells of every index along a direction, S_a the larger of the two areas.
std::vector<double> MultigridSolver::mean_widths(int axis) const
{
  const Index3& n = grid_.cells();
  std::vector<double> h(n[axis], 0.0);
  for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) {
    const Index3 high = stepped({i, j, k}, axis, 1);
    const double area = std::max(grid_.area(axis, i, j, k), grid_.area(axis, high[0], high[1], high[2]));
    h[Index3{i, j, k}[axis]] += grid_.volume(i, j, k) / area;
  });
  MPI_Allreduce(MPI_IN_PLACE, h.data(), n[axis], MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  const double cells = static_cast<double>(n[0]) * n[1] * n[2] / n[axis];
  for (double& width : h)
    width /= cells;
  return h;
}

Box MultigridSolver::make_box(const SideConditions& sides) const
{
  Box box;
  for (int a = 0; a < 3; ++a) {
    const int axis = axis_[a];
    std::vector<double> h;
    if (curvilinear_ != nullptr)
      h = mean_widths(axis);
    for (int i = 0; i < grid_.cells()[axis] && curvilinear_ == nullptr; ++i)
      h.push_back(grid_.width(axis, i));
    for (double& width : h)
      width /= unit_;
    box.lines[a] = make_line(std::move(h), grid_.ranks().periodic(axis), sides[axis], grid_.ranks().splits(axis));
  }
  return box;
}

/// a_f; twice that on Dirichlet sides, where the difference is to p = 0 on the side rather than to its mirror image.
StoredCoefficients::Source MultigridSolver::coefficient_source() const
{
  if (curvilinear_ == nullptr)
    return {};
  return [this, face = curvilinear_->gradient().face()](int a, const Index3& c) {
    const int axis = axis_[a];
    const bool end = c[a] == 0 || c[a] == grid_.cells()[axis];
    const double sides = end && !grid_.ranks().periodic(axis) ? 2.0 : 1.0;
    return sides * face[axis](internal(c)) / unit_;
  };
}

void MultigridSolver::make_cross_terms()
{
  cross_terms_ = std::make_unique<CrossTerms>(multigrid_.finest());
  cross_terms_->load(multigrid_.finest().layout().owned, cross_source());
  cross_terms_->close();
  if (curvilinear_->gradient().largest_cosine() > strong_skew) {
    multigrid_.smooth_cross_terms(*cross_terms_);
    multigrid_.set_blocked({});
  }
}

/// Cross terms in the order of the multigrid's axes: exchanging y and z exchanges the pairs (x, y) and (x, z).
CrossTerms::Source MultigridSolver::cross_source() const
{
  return [this, cross = curvilinear_->gradient().cross()](int pair, const Index3& c) {
    const bool exchanged = axis_[1] == 2 && pair < 2;
    return cross[exchanged ? 1 - pair : pair](internal(c)) / unit_;
  };
}

/// Coefficients that the blocked faces changed.
void MultigridSolver::update_operator()
{
  CurvilinearOperator::Changes changes = curvilinear_->changes();
  for (FaceIndex& face : changes.faces)
    face = internal(face);
  for (Index3& cell : changes.cells)
    cell = internal(cell);
  multigrid_.update_coefficients(changes.faces, coefficient_source());
  cross_terms_->load(changes.cells, cross_source());
  cross_terms_->close();
  std::vector<FaceIndex> partial = curvilinear_->partial_faces();
  for (FaceIndex& face : partial)
    face = internal(face);
  cross_terms_->set_partial_faces(partial);
}

void MultigridSolver::set_blocked(std::span<const FaceIndex> faces)
{
  std::vector<FaceIndex> sorted(faces.begin(), faces.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (grid_.ranks().max(sorted == blocked_ ? 0.0 : 1.0) == 0.0)
    return;
  blocked_ = std::move(sorted);
  fluxes_->set_blocked(blocked_);
  if (curvilinear_ != nullptr)
    update_operator();
  std::vector<FaceIndex> all = gather_faces(grid_.ranks().comm(), blocked_);
  for (FaceIndex& face : all)
    face = internal(face);
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
  std::array<double, 2> sums{};
  if (!by_volume)
    sums = {sum_of(box, values), static_cast<double>(box.volume())};
  else
    grid_.visit([&](const auto& metric) { sums = sums_by_volume(metric, box, values); });
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

int MultigridSolver::component_of(const Index3& cell) const
{
  if (component_.empty())
    return 0;
  return component_[multigrid_.finest().layout().owned.position(internal(cell))];
}

/// f = scale (values - shift) on one row.
void MultigridSolver::load_row(int j, int k, const double* values, double shift, double scale)
{
  Level& level = multigrid_.finest();
  const Index3 c = internal(Index3{0, j, k});
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
  const Index3 c = internal(Index3{0, j, k});
  const float* __restrict even = inner_->solution().data() + layout.start(c[1], c[2], (j + k) & 1);
  const float* __restrict odd = inner_->solution().data() + layout.start(c[1], c[2], (j + k + 1) & 1);
  float* __restrict to = correction_.view().row(j, k);
  const int n = grid_.cells()[0];
#pragma omp simd
  for (int t = 0; t < n / 2; ++t) {
    to[2 * t] = even[t];
    to[2 * t + 1] = odd[t];
  }
  if (n % 2 == 1)
    to[n - 1] = even[n / 2];
  const auto beyond = [&](int side, float same, float other_end) {
    return grid_.ranks().periodic(0) ? other_end : sides_[0][side] == SideCondition::Dirichlet ? -same : 0.0f;
  };
  to[-1] = beyond(0, to[0], to[n - 1]);
  to[n] = beyond(1, to[n - 1], to[0]);
}

/// A row of the correction beyond a Dirichlet side mirrors the one inside.
void MultigridSolver::mirror_row(int axis, int j, int k)
{
  const Index3 cell{0, j, k};
  const int side = cell[axis] < 0 ? 0 : 1;
  const bool beyond = cell[axis] < 0 || cell[axis] == grid_.cells()[axis];
  if (!beyond || grid_.ranks().periodic(axis) || sides_[axis][side] != SideCondition::Dirichlet)
    return;
  const Index3 inside = stepped(cell, axis, side == 0 ? 1 : -1);
  const float* from = correction_.view().row(inside[1], inside[2]);
  float* to = correction_.view().row(j, k);
  for (int i = -1; i <= grid_.cells()[0]; ++i)
    to[i] = -from[i];
}

/// The correction on plane t along the outer axis, halo rows included, and its part in the pressure.
void MultigridSolver::unload_plane(int t, const View<double>& p, double to_pressure)
{
  const IndexBox& owned = grid_.owned();
  const int outer = fluxes_->outer_axis();
  const int inner = 3 - outer;
  const int first = t == owned.lo[outer] ? t - 1 : t;
  const int last = t == owned.hi[outer] - 1 ? t + 1 : t;
  const auto for_rows = [&](int b, int plane, auto work) { outer == 2 ? work(b, plane) : work(plane, b); };
  for (int plane = first; plane <= last; ++plane)
    for (int b = owned.lo[inner] - 1; b <= owned.hi[inner]; ++b)
      for_rows(b, plane, [&](int j, int k) { unload_row(j, k); });
  for (int plane = first; plane <= last; ++plane)
    for (const int b : {owned.lo[inner] - 1, owned.hi[inner]})
      for_rows(b, plane, [&](int j, int k) { mirror_row(inner, j, k); });
  for (const int plane : {first, last})
    for (int b = owned.lo[inner] - 1; b <= owned.hi[inner]; ++b)
      for_rows(b, plane, [&](int j, int k) { mirror_row(outer, j, k); });
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
    norm = std::sqrt(grid_.ranks().sum(sum_of_squares(grid_.owned(), net)));
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
  fluxes_->subtract(U, p, dt);
}

Report MultigridSolver::project(const View3<double>& U, const View<double>& p, double dt, const Target& target)
{
  const auto ignore = [](int, int, const double*) {};
  const auto to_net = [&](int j, int k, const double* outflow) {
    std::transform(outflow, outflow + grid_.cells()[0], net_.view().row(j, k), std::negate<>());
  };
  const double initial_norm = target.relative > 0.0 ? fluxes_->measure(U, ignore).norm : 0.0;
  halo_.exchange({p});
  const SidePressure given(grid_, sides_, p);
  Outflow outflow = fluxes_->correct<double>(
      U, p, dt, [](int) {}, to_net);
  double norm = std::isfinite(outflow.norm) ? load_right_hand_side(outflow) : outflow.norm;
  Report report;
  while (!meets(outflow, initial_norm, target) && report.iterations < target.max_iterations && std::isfinite(norm)) {
    // Below round-off of the fluxes conjugate gradients would only stir noise.  But on stretched grids the round-off of
    // the large cells can dominate the norm while a small one beside a sheet still holds something to correct: the last
    // digit is always worth trying, and what it does not improve is taken back.
    const double round_off = 0.5 * std::numeric_limits<double>::epsilon() * outflow.flux_norm;
    const double tolerance = std::max(std::min(0.1, round_off / norm), inner_tolerance(outflow, initial_norm, target));
    const auto inner = inner_->solve(tolerance, target.max_iterations - report.iterations);
    report.iterations += inner.iterations;
    if (!inner.finite)
      break;
    const double factor = 1.0 / (scale_ * unit_);
    const auto add = [&](double sign, const FluxCorrection::RowSink& sink) {
      return fluxes_->correct<float>(
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
  given.restore(p);
  halo_.exchange({p});
  report.divergence = relative_divergence(outflow, target);
  report.worst_cell = outflow.worst_cell;
  report.converged = meets(outflow, initial_norm, target);
  return report;
}

}  // namespace luff::poisson
