// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/conjugate_gradients.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "poisson/stages.hpp"

namespace luff::poisson {

namespace {

/// A round must gain this much whatever round-off is estimated to be.
constexpr double largest_floor = 1e-3;
/// Iterations without any gain after which round-off is all that is left.
constexpr int patience = 8;

/// row(start, count) for the rows of both colours of plane k.
template <class Row>
void for_rows(const Layout& layout, int k, Row row)
{
  for (int j = layout.owned.lo[1]; j < layout.owned.hi[1]; ++j)
    for (int colour = 0; colour < 2; ++colour)
      row(layout.start(j, k, colour), layout.count(Layout::parity(j, k, colour)));
}

}  // namespace

ConjugateGradients::ConjugateGradients(Multigrid& multigrid, CrossTerms* cross_terms, MPI_Comm comm)
    : multigrid_(multigrid),
      cross_terms_(cross_terms),
      comm_(comm),
      e_(multigrid.finest().layout().size),
      p_(multigrid.finest().layout().size),
      q_(multigrid.finest().layout().size)
{
  const double own = multigrid.finest().box().typical_diagonal();
  MPI_Allreduce(&own, &diagonal_, 1, MPI_DOUBLE, MPI_MAX, comm);
}

/// Sums plane by plane, then in the order of planes: the same on any number of threads.
template <class Plane>
double ConjugateGradients::sum_planes(Plane plane) const
{
  const IndexBox& owned = multigrid_.finest().layout().owned;
  std::vector<double> partial(owned.extent(2));
  run_stages(owned.lo[2], owned.hi[2], 1, threads_for(owned), [&](int, int k) { partial[k - owned.lo[2]] = plane(k); });
  double sum = std::accumulate(partial.begin(), partial.end(), 0.0);
  sum_over_ranks({&sum, 1});
  return sum;
}

void ConjugateGradients::sum_over_ranks(std::span<double> sums) const
{
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

double ConjugateGradients::norm_of_residual() const
{
  const Level& level = multigrid_.finest();
  return std::sqrt(sum_planes([&](int k) {
    double sum = 0.0;
    for_rows(level.layout(), k, [&](std::ptrdiff_t start, int m) {
      const float* __restrict r = level.f.data() + start;
      float part = 0.0f;
#pragma omp simd reduction(+ : part)
      for (int n = 0; n < m; ++n)
        part += r[n] * r[n];
      sum += part;
    });
    return sum;
  }));
}

/// z <- M r by a multigrid cycle; returns r.z, summed while z is in cache.
double ConjugateGradients::precondition()
{
  const Level& level = multigrid_.finest();
  const IndexBox& owned = level.layout().owned;
  std::vector<double> partial(owned.extent(2));
  multigrid_.cycle([&](int k) {
    double sum = 0.0;
    for_rows(level.layout(), k, [&](std::ptrdiff_t start, int m) {
      const float* __restrict r = level.f.data() + start;
      const float* __restrict z = level.u.data() + start;
      float part = 0.0f;
#pragma omp simd reduction(+ : part)
      for (int n = 0; n < m; ++n)
        part += r[n] * z[n];
      sum += part;
    });
    partial[k - owned.lo[2]] = sum;
  });
  double sum = std::accumulate(partial.begin(), partial.end(), 0.0);
  sum_over_ranks({&sum, 1});
  return sum;
}

/// p <- z + beta p, q <- A p; returns p.q.  With beta = 0 the old p is not read.
double ConjugateGradients::advance_direction(float beta)
{
  Level& level = multigrid_.finest();
  const IndexBox& owned = level.layout().owned;
  std::vector<double> partial(owned.extent(2));
  const auto direction = [&](int k) {
    for_rows(level.layout(), k, [&](std::ptrdiff_t start, int m) {
      const float* __restrict z = level.u.data() + start;
      float* __restrict p = p_.data() + start;
#pragma omp simd
      for (int n = 0; n < m; ++n)
        p[n] = beta == 0.0f ? z[n] : z[n] + beta * p[n];
    });
    level.exchange().close_plane(p_.data(), k, Colours::Both);
  };
  const auto prepare = [&](int k) {
    if (cross_terms_ != nullptr)
      cross_terms_->prepare_plane(k, p_.data());
  };
  const auto image = [&](int k) {
    double& sum = partial[k - owned.lo[2]];
    sum = level.apply_plane(k, p_.data(), q_.data());
    if (cross_terms_ != nullptr)
      sum += cross_terms_->apply_plane(k, p_.data(), q_.data());
  };
  const int threads = threads_for(owned);
  const int prepared = cross_terms_ != nullptr ? 2 : 1;
  const auto stage = [&](int s, int k) { s == 0 ? direction(k) : s < prepared ? prepare(k) : image(k); };
  const RowExchange& halo = level.exchange();
  if (cross_terms_ == nullptr && halo.of_planes()) {  // z came with its halo, so p gets its own without asking
    for (const int k : {owned.lo[2] - 1, owned.hi[2]})
      direction(k);
    run_stages(owned.lo[2], owned.hi[2], 2, threads, stage);
  } else if (halo.within_planes()) {
    cross_terms_->keep_all_planes(threads > 1);
    run_stages(owned.lo[2], owned.hi[2], prepared + 1, threads, stage);
  } else {
    if (cross_terms_ != nullptr)
      cross_terms_->keep_all_planes(true);
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { direction(k); });
    fill_halo(p_);
    run_stages(owned.lo[2], owned.hi[2], prepared, threads, [&](int s, int k) { stage(s + 1, k); });
  }
  double sum = std::accumulate(partial.begin(), partial.end(), 0.0);
  sum_over_ranks({&sum, 1});
  return sum;
}

void ConjugateGradients::fill_halo(Values& values)
{
  RowExchange& exchange = multigrid_.finest().exchange();
  if (cross_terms_ != nullptr)
    exchange.exchange_with_edges(values.data());
  else
    exchange.exchange(values.data(), Colours::Both);
}

/// e <- e + alpha p, r <- r - alpha q; one loop for each, as GCC 12 leaves one with two sums scalar.  The first time
/// the old e is not read.
ConjugateGradients::Norms ConjugateGradients::step(float alpha, bool first)
{
  Level& level = multigrid_.finest();
  const IndexBox& owned = level.layout().owned;
  std::vector<std::array<double, 2>> partial(owned.extent(2));
  run_stages(owned.lo[2], owned.hi[2], 1, threads_for(owned), [&](int, int k) {
    std::array<double, 2>& sums = partial[k - owned.lo[2]];
    sums = {0.0, 0.0};
    for_rows(level.layout(), k, [&](std::ptrdiff_t start, int m) {
      const float* __restrict p = p_.data() + start;
      const float* __restrict q = q_.data() + start;
      float* __restrict e = e_.data() + start;
      float* __restrict r = level.f.data() + start;
      float rr = 0.0f;
      float ee = 0.0f;
#pragma omp simd reduction(+ : ee)
      for (int n = 0; n < m; ++n) {
        const float value = first ? alpha * p[n] : e[n] + alpha * p[n];
        e[n] = value;
        ee += value * value;
      }
#pragma omp simd reduction(+ : rr)
      for (int n = 0; n < m; ++n) {
        const float value = r[n] - alpha * q[n];
        r[n] = value;
        rr += value * value;
      }
      sums[0] += rr;
      sums[1] += ee;
    });
  });
  std::array<double, 2> sums{0.0, 0.0};
  for (const auto& [rr, ee] : partial) {
    sums[0] += rr;
    sums[1] += ee;
  }
  sum_over_ranks(sums);
  return {std::sqrt(sums[0]), std::sqrt(sums[1])};
}

ConjugateGradients::Result ConjugateGradients::solve(double tolerance, int max_iterations)
{
  Level& level = multigrid_.finest();
  const double initial = norm_of_residual();
  Result result;
  double rz_before = 1.0;
  double floor = 0.0;
  double best = 1.0;
  int without_gain = 0;
  while (result.iterations < max_iterations && result.reduction > std::max(tolerance, floor) &&
         without_gain < patience) {
    const double rz = precondition();
    ++result.iterations;
    const bool first = result.iterations == 1;
    const double pq = advance_direction(first ? 0.0f : static_cast<float>(rz / rz_before));
    const double alpha = rz / pq;
    if (!std::isfinite(alpha)) {
      result.finite = false;
      return result;
    }
    rz_before = rz;
    const Norms norms = step(static_cast<float>(alpha), first);
    result.reduction = norms.residual / initial;
    without_gain = result.reduction < best ? 0 : without_gain + 1;
    best = std::min(best, result.reduction);
    constexpr double half_digit = 0.5 * std::numeric_limits<float>::epsilon();
    floor = std::min(largest_floor, half_digit * diagonal_ * norms.solution / initial);
  }
  const IndexBox& owned = level.layout().owned;
  for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
    level.exchange().close_plane(e_.data(), k, Colours::Both);
  fill_halo(e_);
  return result;
}

}  // namespace luff::poisson
