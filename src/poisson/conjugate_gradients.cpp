// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/conjugate_gradients.hpp"

#include <cmath>

#include "poisson/stages.hpp"

namespace luff::poisson {

namespace {

/// row(start, count) for the rows of both colours of plane k.
template <class Row>
void for_rows(const Layout& layout, int k, Row row)
{
  for (int j = layout.owned.lo[1]; j < layout.owned.hi[1]; ++j)
    for (int colour = 0; colour < 2; ++colour)
      row(layout.start(j, k, colour), layout.count(Layout::parity(j, k, colour)));
}

}  // namespace

ConjugateGradients::ConjugateGradients(Multigrid& multigrid, MPI_Comm comm)
    : multigrid_(multigrid),
      comm_(comm),
      e_(multigrid.finest().layout().size),
      p_(multigrid.finest().layout().size),
      q_(multigrid.finest().layout().size)
{
}

/// Sums plane by plane, then in the order of planes: the same on any number of threads.
template <class Plane>
double ConjugateGradients::sum_planes(Plane plane) const
{
  const IndexBox& owned = multigrid_.finest().layout().owned;
  std::vector<double> partial(owned.extent(2));
  run_stages(owned.lo[2], owned.hi[2], 1, threads_for(owned), [&](int, int k) { partial[k - owned.lo[2]] = plane(k); });
  double sum = 0.0;
  for (const double s : partial)
    sum += s;
  return total(sum);
}

double ConjugateGradients::total(double value) const
{
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return value;
}

double ConjugateGradients::residual_dot_direction()
{
  const Level& level = multigrid_.finest();
  return sum_planes([&](int k) {
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
    return sum;
  });
}

/// p <- z + beta p, q <- A p; returns p.q.
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
        p[n] = z[n] + beta * p[n];
    });
    level.exchange().close_plane(p_.data(), k, Colours::Both);
  };
  const auto image = [&](int k) { partial[k - owned.lo[2]] = level.apply_plane(k, p_.data(), q_.data()); };
  const int threads = threads_for(owned);
  if (level.exchange().within_planes()) {
    run_stages(owned.lo[2], owned.hi[2], 2, threads, [&](int s, int k) { s == 0 ? direction(k) : image(k); });
  } else {
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { direction(k); });
    level.exchange().exchange(p_.data(), Colours::Both);
    run_stages(owned.lo[2], owned.hi[2], 1, threads, [&](int, int k) { image(k); });
  }
  double sum = 0.0;
  for (const double s : partial)
    sum += s;
  return total(sum);
}

/// e <- e + alpha p, r <- r - alpha q; returns r.r.
double ConjugateGradients::step(float alpha, bool first)
{
  Level& level = multigrid_.finest();
  return sum_planes([&](int k) {
    double sum = 0.0;
    for_rows(level.layout(), k, [&](std::ptrdiff_t start, int m) {
      const float* __restrict p = p_.data() + start;
      const float* __restrict q = q_.data() + start;
      float* __restrict e = e_.data() + start;
      float* __restrict r = level.f.data() + start;
      const float keep = first ? 0.0f : 1.0f;
      float part = 0.0f;
#pragma omp simd reduction(+ : part)
      for (int n = 0; n < m; ++n) {
        e[n] = keep * e[n] + alpha * p[n];
        r[n] -= alpha * q[n];
        part += r[n] * r[n];
      }
      sum += part;
    });
    return sum;
  });
}

ConjugateGradients::Result ConjugateGradients::solve(double tolerance, int max_iterations)
{
  Level& level = multigrid_.finest();
  const double initial = sum_planes([&](int k) {
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
  });
  Result result;
  double rz_before = 1.0;
  e_.resize(e_.size());
  while (result.iterations < max_iterations && result.reduction > tolerance) {
    multigrid_.cycle();
    ++result.iterations;
    const bool first = result.iterations == 1;
    const double rz = residual_dot_direction();
    if (first)
      p_.resize(p_.size());
    const double pq = advance_direction(first ? 0.0f : static_cast<float>(rz / rz_before));
    const double alpha = rz / pq;
    if (!std::isfinite(alpha)) {
      result.finite = false;
      return result;
    }
    rz_before = rz;
    result.reduction = std::sqrt(step(static_cast<float>(alpha), first) / initial);
  }
  const IndexBox& owned = level.layout().owned;
  for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
    level.exchange().close_plane(e_.data(), k, Colours::Both);
  level.exchange().exchange(e_.data(), Colours::Both);
  return result;
}

}  // namespace luff::poisson
