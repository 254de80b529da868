// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/transfer.hpp"

#include <algorithm>

namespace luff::poisson {

/// Rows of a thread, with room for one value before and after: index 0 of a row is `pad` values into its array.
struct Transfer::Scratch {
  static constexpr int pad = 16;
  Scratch(int fine_cells, int coarse_cells)
  {
    const int half = (fine_cells + 1) / 2 + 2 * pad;
    for (auto* rows : {&all, &own})
      for (auto& row : *rows)
        row.assign(half, 0.0f);
    for (auto* row : {&natural, &to_left, &to_right})
      row->assign(fine_cells + 2 * pad, 0.0f);
    for (auto* row : {&coarse, &blend})
      row->assign(coarse_cells + 2 + 2 * pad, 0.0f);
  }
  std::array<std::vector<float>, 2> all, own;  // weighted and plain sums of residual rows, per parity of i
  std::vector<float> natural, to_left, to_right;
  std::vector<float> coarse, blend;
};

Transfer::Transfer(Level& fine, Level& coarse, std::array<Merge, 3> merges)
    : fine_(fine), coarse_(coarse), merges_(std::move(merges))
{
  const IndexBox& owned = fine.layout().owned;
  for (int a = 0; a < 3; ++a) {
    home_.lo[a] = merges_[a].parent[owned.lo[a]];
    home_.hi[a] = merges_[a].parent[owned.hi[a] - 1] + 1;
  }
  make_tables();
  set_cuts(Cuts{}, Cuts{});
}

void Transfer::make_tables()
{
  const Merge& x = merges_[0];
  const int n = fine_.box().lines[0].n;
  const int N = coarse_.box().lines[0].n;
  regular_ = true;
  for (int q = 0; q < 2; ++q)
    weight_[q].assign((n + 1) / 2 + 2 * Scratch::pad, 0.0f);
  weight_left_.assign(n, 0.0f);
  weight_right_.assign(n, 0.0f);
  for (int i = 0; i < n; ++i) {
    const auto w = static_cast<float>(x.weight[i]);
    regular_ = regular_ && x.parent[i] == i / 2;
    weight_[i & 1][Scratch::pad + (i >> 1)] = w;
    parent_[i & 1].push_back(x.parent[i]);
    other_[i & 1].push_back(x.parent[i] + x.towards[i]);
    (x.towards[i] < 0 ? weight_left_ : weight_right_)[i] = w;
  }
  for (int I = 0; I < N; ++I) {
    first_.push_back(x.first[I]);
    last_.push_back(x.first[I + 1] - 1);
  }
}

bool Transfer::reads(const Cuts& fine_cuts, Unknown x) const
{
  if (!is_cell(x) || fine_.residual_colours() == Colours::Both)
    return true;
  const Index3 c = fine_.box().cell(x);
  (void)fine_cuts;
  return ((c[0] + c[1] + c[2]) & 1) == 0;
}

void Transfer::set_cuts(const Cuts& fine_cuts, const Cuts& coarse_cuts)
{
  restriction_.clear();
  prolongation_.clear();
  const IndexBox& owned = fine_.layout().owned;
  const int planes = owned.extent(2);
  std::vector<std::pair<int, Weight>> by_plane;
  for (const Interpolation& p : fine_cuts.interpolation) {
    if (!reads(fine_cuts, p.fine))
      continue;
    const Index3 C = is_cell(p.coarse) ? coarse_.box().cell(p.coarse) : coarse_cuts.extras[extra_number(p.coarse)].cell;
    if (home_.contains(C))
      restriction_.push_back({static_cast<std::int32_t>(fine_.place(fine_cuts, p.fine)),
                              static_cast<std::int32_t>(coarse_.place(coarse_cuts, p.coarse)),
                              static_cast<float>(p.weight)});
    const bool extra = !is_cell(p.fine);
    if (extra || fine_.owns(fine_cuts, p.fine))
      by_plane.push_back(
          {extra ? planes : fine_.box().cell(p.fine)[2] - owned.lo[2],
           {static_cast<std::int32_t>(fine_.place(fine_cuts, p.fine)),
            static_cast<std::int32_t>(coarse_.place(coarse_cuts, p.coarse)), static_cast<float>(p.weight)}});
  }
  std::stable_sort(by_plane.begin(), by_plane.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  first_of_plane_.assign(planes + 2, 0);
  for (const auto& [plane, weight] : by_plane) {
    prolongation_.push_back(weight);
    ++first_of_plane_[plane + 1];
  }
  for (int p = 0; p <= planes; ++p)
    first_of_plane_[p + 1] += first_of_plane_[p];
}

/// Adds a row of residuals; `own` when it belongs to the coarse row itself.
void Transfer::add_row(int j, int k, float weight, bool own, Scratch& s) const
{
  const Layout& layout = fine_.layout();
  for (int colour = 0; colour < 2; ++colour) {
    if (!includes(fine_.residual_colours(), colour))
      continue;
    const int q = Layout::parity(j, k, colour);
    const int m = layout.count(q);
    const float* __restrict r = fine_.r.data() + layout.start(j, k, colour);
    float* __restrict all = s.all[q].data() + Scratch::pad;
    float* __restrict plain = s.own[q].data() + Scratch::pad;
    if (own) {
#pragma omp simd
      for (int n = 0; n < m; ++n) {
        all[n] += weight * r[n];
        plain[n] += r[n];
      }
    } else {
#pragma omp simd
      for (int n = 0; n < m; ++n)
        all[n] += weight * r[n];
    }
  }
}

void Transfer::gather_rows(int J, int K, Scratch& s) const
{
  for (auto* rows : {&s.all, &s.own})
    for (auto& row : *rows)
      std::fill(row.begin(), row.end(), 0.0f);
  const Merge& y = merges_[1];
  const Merge& z = merges_[2];
  const Line& line_y = fine_.box().lines[1];
  const Line& line_z = fine_.box().lines[2];
  for (int k = z.first[K]; k < z.first[K + 1]; ++k)
    for (int j = y.first[J]; j < y.first[J + 1]; ++j)
      add_row(j, k, static_cast<float>(1.0 - y.weight[j] - z.weight[k]), true, s);
  // The nearest rows of neighbouring coarse rows interpolate from this one too.
  for (int side = 0; side < 2; ++side) {
    const int towards = side == 0 ? 1 : -1;
    const int j = side == 0 ? y.first[J] - 1 : y.first[J + 1];
    const int j_global = line_y.neighbour(j + towards, side);
    if (j_global >= 0 && y.towards[j_global] == towards && y.weight[j_global] > 0.0)
      for (int k = z.first[K]; k < z.first[K + 1]; ++k)
        add_row(j, k, static_cast<float>(y.weight[j_global]), false, s);
    const int k = side == 0 ? z.first[K] - 1 : z.first[K + 1];
    const int k_global = line_z.neighbour(k + towards, side);
    if (k_global >= 0 && z.towards[k_global] == towards && z.weight[k_global] > 0.0)
      for (int jj = y.first[J]; jj < y.first[J + 1]; ++jj)
        add_row(jj, k, static_cast<float>(z.weight[k_global]), false, s);
  }
}

/// F_I = sum over children (all_i - w_i own_i) + w own of the cells next to I in its neighbours.
void Transfer::combine_along_row(int J, int K, Scratch& s) const
{
  constexpr int pad = Scratch::pad;
  const int n = fine_.box().lines[0].n;
  const int N = coarse_.box().lines[0].n;
  const bool periodic = fine_.box().lines[0].periodic;
  float* __restrict F = s.coarse.data() + pad;
  const auto plain = [&](int i) { return s.own[i & 1][pad + (i >> 1)]; };
  if (regular_) {
    const float* __restrict we = weight_[0].data() + pad;
    const float* __restrict wo = weight_[1].data() + pad;
    const float* __restrict ae = s.all[0].data() + pad;
    const float* __restrict ao = s.all[1].data() + pad;
    const float* __restrict be = s.own[0].data() + pad;
    const float* __restrict bo = s.own[1].data() + pad;
#pragma omp simd
    for (int I = 0; I < N; ++I)
      F[I] = ae[I] + ao[I] - we[I] * be[I] - wo[I] * bo[I] + wo[I - 1] * bo[I - 1] + we[I + 1] * be[I + 1];
  } else {
    float* __restrict natural = s.natural.data() + pad;
    float* __restrict to_left = s.to_left.data() + pad;
    float* __restrict to_right = s.to_right.data() + pad;
    for (int q = 0; q < 2; ++q) {
      const float* __restrict a = s.all[q].data() + pad;
      const float* __restrict b = s.own[q].data() + pad;
      const int m = (n - q + 1) / 2;
#pragma omp simd
      for (int t = 0; t < m; ++t) {
        const int i = 2 * t + q;
        to_left[i] = weight_left_[i] * b[t];
        to_right[i] = weight_right_[i] * b[t];
        natural[i] = a[t] - to_left[i] - to_right[i];
      }
    }
    const int* __restrict first = first_.data();
    const int* __restrict last = last_.data();
#pragma omp simd
    for (int I = 0; I < N; ++I) {
      const float second = natural[last[I]];
      F[I] = natural[first[I]] + (last[I] > first[I] ? second : 0.0f) + to_right[first[I] - 1] + to_left[last[I] + 1];
    }
  }
  if (periodic) {
    F[0] += weight_right_[n - 1] * plain(n - 1);
    F[N - 1] += weight_left_[0] * plain(0);
  }
  const Layout& layout = coarse_.layout();
  for (int q = 0; q < 2; ++q) {
    float* __restrict out = coarse_.f.data() + layout.start(J, K, (J + K + q) & 1);
    const int m = (N - q + 1) / 2;
#pragma omp simd
    for (int t = 0; t < m; ++t)
      out[t] = F[2 * t + q];
  }
}

void Transfer::restrict_row(int J, int K, Scratch& s) const
{
  gather_rows(J, K, s);
  combine_along_row(J, K, s);
}

void Transfer::restrict_residual()
{
  fine_.exchange().exchange(fine_.r.data(), fine_.residual_colours());
  const bool gather = fine_.distributed() && !coarse_.distributed();
  if (gather)
    std::fill_n(coarse_.f.data(), coarse_.f.size(), 0.0f);
  else
    std::fill_n(coarse_.f.data() + coarse_.layout().size, coarse_.extras(), 0.0f);
#pragma omp parallel num_threads(threads_for(fine_.layout().owned))
  {
    Scratch s(fine_.box().lines[0].n, coarse_.box().lines[0].n);
#pragma omp for schedule(static)
    for (int K = home_.lo[2]; K < home_.hi[2]; ++K)
      for (int J = home_.lo[1]; J < home_.hi[1]; ++J)
        restrict_row(J, K, s);
  }
  for (const Weight& w : restriction_)
    coarse_.f[w.coarse] += w.weight * fine_.r[w.fine];
  if (gather)
    fine_.sum_over_ranks(coarse_.f);
}

/// coarse = U along the coarse row that holds fine row (j, k); blend = U with the interpolation along j and k.
void Transfer::interpolate_rows(int j, int k, Scratch& s) const
{
  const Layout& layout = coarse_.layout();
  const int J = merges_[1].parent[j];
  const int K = merges_[2].parent[k];
  const int J2 = J + merges_[1].towards[j];
  const int K2 = K + merges_[2].towards[k];
  const auto wj = static_cast<float>(merges_[1].weight[j]);
  const auto wk = static_cast<float>(merges_[2].weight[k]);
  const float w0 = 1.0f - wj - wk;
  const int N = coarse_.box().lines[0].n;
  float* __restrict coarse = s.coarse.data() + Scratch::pad;
  float* __restrict blend = s.blend.data() + Scratch::pad;
  for (int q = 0; q < 2; ++q) {
    const auto row = [&](int Jr, int Kr) { return coarse_.u.data() + layout.start(Jr, Kr, (Jr + Kr + q) & 1); };
    const float* __restrict U = row(J, K);
    const float* __restrict Uj = row(J2, K);
    const float* __restrict Uk = row(J, K2);
    const int m = (N - q + 1) / 2;
#pragma omp simd
    for (int t = 0; t < m; ++t) {
      coarse[2 * t + q] = U[t];
      blend[2 * t + q] = w0 * U[t] + wj * Uj[t] + wk * Uk[t];
    }
  }
  coarse[-1] = coarse_.u[layout.index(-1, J, K)];
  coarse[N] = coarse_.u[layout.index(N, J, K)];
}

void Transfer::add_interpolated(int j, int k, const Scratch& s)
{
  const Layout& layout = fine_.layout();
  const float* __restrict coarse = s.coarse.data() + Scratch::pad;
  const float* __restrict blend = s.blend.data() + Scratch::pad;
  for (int colour = 0; colour < 2; ++colour) {
    if (!includes(fine_.residual_colours(), colour))
      continue;
    const int q = Layout::parity(j, k, colour);
    const int m = layout.count(q);
    const float* __restrict w = weight_[q].data() + Scratch::pad;
    float* __restrict u = fine_.u.data() + layout.start(j, k, colour);
    if (regular_) {
      const int towards = q == 0 ? -1 : 1;
#pragma omp simd
      for (int n = 0; n < m; ++n)
        u[n] += blend[n] + w[n] * (coarse[n + towards] - coarse[n]);
    } else {
      const int* __restrict p = parent_[q].data();
      const int* __restrict o = other_[q].data();
#pragma omp simd
      for (int n = 0; n < m; ++n)
        u[n] += blend[p[n]] + w[n] * (coarse[o[n]] - coarse[p[n]]);
    }
  }
}

void Transfer::prolong_plane(int k)
{
  const IndexBox& owned = fine_.layout().owned;
  Scratch s(1, coarse_.box().lines[0].n);
  for (int j = owned.lo[1]; j < owned.hi[1]; ++j) {
    interpolate_rows(j, k, s);
    add_interpolated(j, k, s);
  }
  const int plane = k - owned.lo[2];
  for (int p = first_of_plane_[plane]; p < first_of_plane_[plane + 1]; ++p)
    fine_.u[prolongation_[p].fine] += prolongation_[p].weight * coarse_.u[prolongation_[p].coarse];
  fine_.exchange().close_plane(fine_.u.data(), k, fine_.residual_colours());
}

void Transfer::prolong_extras()
{
  const int planes = fine_.layout().owned.extent(2);
  for (int p = first_of_plane_[planes]; p < first_of_plane_[planes + 1]; ++p)
    if (prolongation_[p].coarse >= 0)
      fine_.u[prolongation_[p].fine] += prolongation_[p].weight * coarse_.u[prolongation_[p].coarse];
  fine_.share_extras(fine_.u.data());
}

}  // namespace luff::poisson
