// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/transfer.hpp"

#include <algorithm>
#include <numeric>

namespace luff::poisson {

namespace {

constexpr int pad = 16;

}  // namespace

/// Sums along one row, split by parity of i: the even cells from `pad` on, the odd ones from `pad` + split_ on.  Loops
/// run over whole vectors, into the padding and into what later ones overwrite.
struct Transfer::Scratch {
  Scratch(std::ptrdiff_t split, int coarse_cells)
      : all(2 * split + pad),
        own(2 * split + pad),
        coarse(coarse_cells + 3 * pad),
        low(coarse_cells + 3 * pad),
        high(coarse_cells + 3 * pad)
  {
  }
  Values all, own;           // fine residuals with the weights along j and k, and plainly
  Values coarse, low, high;  // what a coarse cell, its lower and its upper neighbour get
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
  split_ = Layout::whole_vectors((n + 1) / 2) + 2 * pad;
  natural_stride_ = Layout::whole_vectors(N) + 2 * pad;
  natural_.resize(natural_stride_ * (home_.extent(1) + 2) * (home_.extent(2) + 2) + 2 * pad);
  weight_.resize(2 * split_ + pad);
  for (int i = 0; i < n; ++i)
    weight_[pad + split_place(i)] = static_cast<float>(x.weight[i]);
  for (int I = 0; I < N; ++I) {
    const bool pair = x.first[I + 1] - x.first[I] == 2;
    if (runs_.empty() || runs_.back().pairs != pair)
      runs_.push_back({.fine = x.first[I], .coarse = I, .count = 0, .pairs = pair});
    ++runs_.back().count;
  }
  for (int a = 1; a < 3; ++a)
    children_[a] = children_along(a);
}

std::vector<Transfer::Children> Transfer::children_along(int axis) const
{
  const Merge& merge = merges_[axis];
  const auto beyond = [&](int C, int side) {
    const int towards = side == 0 ? 1 : -1;
    const int last_inside = side == 0 ? merge.first[C] : merge.first[C + 1] - 1;
    const int i = fine_.box().lines[axis].neighbour(last_inside, side);
    return i >= 0 && merge.towards[i] == towards ? static_cast<float>(merge.weight[i]) : 0.0f;
  };
  std::vector<Children> children;
  for (int C = home_.lo[axis]; C < home_.hi[axis]; ++C) {
    const int first = merge.first[C];
    const int count = merge.first[C + 1] - first;
    children.push_back({first,
                        count,
                        {static_cast<float>(merge.weight[first]), static_cast<float>(merge.weight[first + count - 1])},
                        {beyond(C, 0), beyond(C, 1)}});
  }
  return children;
}

void Transfer::set_cuts(const Cuts& fine_cuts, const Cuts& coarse_cuts)
{
  restriction_.clear();
  const IndexBox& owned = fine_.layout().owned;
  const int planes = owned.extent(2);
  std::vector<std::pair<int, Weight>> of_planes;  // extras after the last
  first_of_plane_.assign(planes + 2, 0);
  for (const Interpolation& p : fine_cuts.interpolation) {
    const bool extra = !is_cell(p.fine);
    const Index3 c = extra ? Index3{} : fine_.box().cell(p.fine);
    if (!extra && !includes(fine_.residual_colours(), (c[0] + c[1] + c[2]) & 1))
      continue;
    const Index3 C = is_cell(p.coarse) ? coarse_.box().cell(p.coarse) : coarse_cuts.extras[extra_number(p.coarse)].cell;
    const bool restricts = home_.contains(C);
    const bool prolongs = extra || owned.contains(c);
    if (!restricts && !prolongs)
      continue;
    const Weight weight{static_cast<std::int32_t>(fine_.place(p.fine)),
                        static_cast<std::int32_t>(coarse_.place(p.coarse)), static_cast<float>(p.weight)};
    if (restricts)
      restriction_.push_back(weight);
    if (prolongs) {
      of_planes.emplace_back(extra ? planes : c[2] - owned.lo[2], weight);
      ++first_of_plane_[of_planes.back().first + 1];
    }
  }
  std::partial_sum(first_of_plane_.begin(), first_of_plane_.end(), first_of_plane_.begin());
  prolongation_.resize(of_planes.size());
  std::vector<int> next = first_of_plane_;
  for (const auto& [plane, weight] : of_planes)
    prolongation_[next[plane]++] = weight;
}

/// Rows of a coarse row's own children, and the nearest rows of its neighbours that interpolate from it too.
void Transfer::gather_rows(int J, int K, int colour, std::array<Rows, 2>& rows) const
{
  const Children& y = children_[1][J - home_.lo[1]];
  const Children& z = children_[2][K - home_.lo[2]];
  const Layout& layout = fine_.layout();
  const auto add = [&](int j, int k, float weight, bool own) {
    Rows& r = rows[Layout::parity(j, k, colour)];
    const int n = own ? r.own++ : r.beyond++;
    r.row[n] = fine_.r.data() + layout.start(j, k, colour);
    r.weight[n] = weight;
  };
  for (int b = 0; b < z.count; ++b)
    for (int a = 0; a < y.count; ++a)
      add(y.first + a, z.first + b, 1.0f - y.weight[a] - z.weight[b], true);
  for (int side = 0; side < 2; ++side) {
    const int j = side == 0 ? y.first - 1 : y.first + y.count;
    const int k = side == 0 ? z.first - 1 : z.first + z.count;
    for (int b = 0; b < z.count && y.beyond[side] > 0.0f; ++b)
      add(j, z.first + b, y.beyond[side], false);
    for (int a = 0; a < y.count && z.beyond[side] > 0.0f; ++a)
      add(y.first + a, k, z.beyond[side], false);
  }
}

/// The first rows of a parity overwrite what was there: a factor costs less than clearing.
void Transfer::add_rows(const Rows& rows, int parity, bool first, Scratch& s) const
{
  const int m = Layout::whole_vectors(fine_.layout().count(parity));
  float* __restrict all = s.all.data() + pad + parity * split_;
  float* __restrict own = s.own.data() + pad + parity * split_;
  // Rows that are missing repeat an existing one with weight zero.
  const float* any = rows.own > 0 ? rows.row[0] : rows.beyond > 2 ? rows.row[2] : nullptr;
  if (any == nullptr) {
    std::fill_n(all, first ? m : 0, 0.0f);
    std::fill_n(own, first ? m : 0, 0.0f);
    return;
  }
  const float kept = first ? 0.0f : 1.0f;
  std::array<const float*, 6> row;
  std::array<float, 6> w;
  for (int n = 0; n < 6; ++n) {
    const bool there = n < 2 ? n < rows.own : n < rows.beyond;
    row[n] = there ? rows.row[n] : any;
    w[n] = there ? rows.weight[n] : 0.0f;
  }
  const float own0 = rows.own > 0 ? 1.0f : 0.0f;
  const float own1 = rows.own > 1 ? 1.0f : 0.0f;
  const float* __restrict r0 = row[0];
  const float* __restrict r1 = row[1];
  const float* __restrict r2 = row[2];
  const float* __restrict r3 = row[3];
  const float* __restrict r4 = row[4];
  const float* __restrict r5 = row[5];
#pragma omp simd
  for (int n = 0; n < m; ++n) {
    all[n] = kept * all[n] + w[0] * r0[n] + w[1] * r1[n] + w[2] * r2[n] + w[3] * r3[n] + w[4] * r4[n] + w[5] * r5[n];
    own[n] = kept * own[n] + own0 * r0[n] + own1 * r1[n];
  }
}

/// Of a coarse cell with two children: sum (all_i - w_i own_i), and w own of either for the neighbour next to it.
void Transfer::combine_pairs(const Run& run, Scratch& s) const
{
  const std::ptrdiff_t first = pad + split_place(run.fine);
  const std::ptrdiff_t second = pad + split_place(run.fine + 1);
  float* __restrict F = s.coarse.data() + pad + run.coarse;
  float* __restrict low = s.low.data() + pad + run.coarse;
  float* __restrict high = s.high.data() + pad + run.coarse;
  const float* __restrict w_first = weight_.data() + first;
  const float* __restrict w_second = weight_.data() + second;
  const float* __restrict all_first = s.all.data() + first;
  const float* __restrict all_second = s.all.data() + second;
  const float* __restrict own_first = s.own.data() + first;
  const float* __restrict own_second = s.own.data() + second;
  const int m = Layout::whole_vectors(run.count);
#pragma omp simd
  for (int t = 0; t < m; ++t) {
    low[t] = w_first[t] * own_first[t];
    high[t] = w_second[t] * own_second[t];
    F[t] = all_first[t] + all_second[t] - low[t] - high[t];
  }
}

/// Cells that stay alone along the row interpolate from no neighbour there.
void Transfer::combine_singles(const Run& run, Scratch& s) const
{
  float* __restrict F = s.coarse.data() + pad + run.coarse;
  const float* __restrict even = s.all.data() + pad + split_place(run.fine);
  const float* __restrict odd = s.all.data() + pad + split_place(run.fine + 1);
  const int m = Layout::whole_vectors((run.count + 1) / 2);
#pragma omp simd
  for (int t = 0; t < m; ++t) {
    F[2 * t] = even[t];
    F[2 * t + 1] = odd[t];
  }
}

/// F_I = sum over children (all_i - w_i own_i) + w own of the cells next to I in its neighbours.
void Transfer::combine(Scratch& s) const
{
  for (const Run& run : runs_)
    if (run.pairs)
      combine_pairs(run, s);
    else
      combine_singles(run, s);
  const int N = coarse_.box().lines[0].n;
  float* __restrict F = s.coarse.data() + pad;
  const float* __restrict low = s.low.data() + pad;
  const float* __restrict high = s.high.data() + pad;
  const int m = Layout::whole_vectors(N);
#pragma omp simd
  for (int I = 0; I < m; ++I)
    F[I] += high[I - 1] + low[I + 1];
  std::fill_n(F + N, pad, 0.0f);
}

void Transfer::store_coarse_row(int J, int K, Scratch& s) const
{
  const int n = fine_.box().lines[0].n;
  const int N = coarse_.box().lines[0].n;
  float* __restrict F = s.coarse.data() + pad;
  if (fine_.box().lines[0].periodic) {
    const std::ptrdiff_t last = pad + split_place(n - 1);
    F[0] += weight_[last] * s.own[last];
    F[N - 1] += weight_[pad] * s.own[pad];
  }
  const Layout& layout = coarse_.layout();
  for (int q = 0; q < 2; ++q) {
    float* __restrict out = coarse_.f.data() + layout.start(J, K, (J + K + q) & 1);
    const int m = Layout::whole_vectors((N - q + 1) / 2);
#pragma omp simd
    for (int t = 0; t < m; ++t)
      out[t] = F[2 * t + q];
  }
}

void Transfer::restrict_row(int J, int K, Scratch& s) const
{
  bool first = true;
  for (int colour = 0; colour < 2; ++colour) {
    if (!includes(fine_.residual_colours(), colour))
      continue;
    std::array<Rows, 2> rows;
    gather_rows(J, K, colour, rows);
    for (int parity = 0; parity < 2; ++parity)
      add_rows(rows[parity], parity, first, s);
    first = false;
  }
  combine(s);
  store_coarse_row(J, K, s);
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
    Scratch s(split_, coarse_.box().lines[0].n);
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

void Transfer::begin_prolongation()
{
  const Layout& layout = coarse_.layout();
  const int N = coarse_.box().lines[0].n;
#pragma omp parallel for num_threads(threads_for(home_)) schedule(static)
  for (int K = home_.lo[2] - 1; K <= home_.hi[2]; ++K)
    for (int J = home_.lo[1] - 1; J <= home_.hi[1]; ++J) {
      float* __restrict out = natural_.data() + natural_row(J, K);
      const float* __restrict even = coarse_.u.data() + layout.start(J, K, (J + K) & 1);
      const float* __restrict odd = coarse_.u.data() + layout.start(J, K, (J + K + 1) & 1);
      const int m = Layout::whole_vectors((N + 1) / 2);
#pragma omp simd
      for (int t = 0; t < m; ++t) {
        out[2 * t] = even[t];
        out[2 * t + 1] = odd[t];
      }
      out[-1] = coarse_.u[layout.index(-1, J, K)];
      out[N] = coarse_.u[layout.index(N, J, K)];
    }
  prolong_extras();
}

/// u_i += U_I + sum over axes of w (U_beside - U_I) for the cells of a colour; either all first or all second children
/// of a run of pairs are of it, and every other cell of a run of single ones.
void Transfer::add_coarse_row(int j, int k, int colour)
{
  const Layout& layout = fine_.layout();
  const int J = merges_[1].parent[j];
  const int K = merges_[2].parent[k];
  const auto wj = static_cast<float>(merges_[1].weight[j]);
  const auto wk = static_cast<float>(merges_[2].weight[k]);
  const int q = Layout::parity(j, k, colour);
  const float* const row = natural_.data() + natural_row(J, K);
  const float* const row_j = natural_.data() + natural_row(J + merges_[1].towards[j], K);
  const float* const row_k = natural_.data() + natural_row(J, K + merges_[2].towards[k]);
  for (const Run& run : runs_) {
    const int skipped = (run.fine & 1) == q ? 0 : 1;
    const int i = run.fine + skipped;
    const float* __restrict w = weight_.data() + pad + split_place(i);
    float* __restrict u = fine_.u.data() + layout.start(j, k, colour) + (i >> 1);
    if (run.pairs) {
      const float* __restrict U = row + run.coarse;
      const float* __restrict Ui = U + (skipped == 0 ? -1 : 1);
      const float* __restrict Uj = row_j + run.coarse;
      const float* __restrict Uk = row_k + run.coarse;
#pragma omp simd
      for (int t = 0; t < run.count; ++t)
        u[t] += U[t] + w[t] * (Ui[t] - U[t]) + wj * (Uj[t] - U[t]) + wk * (Uk[t] - U[t]);
    } else {
      const float* __restrict U = row + run.coarse + skipped;
      const float* __restrict Uj = row_j + run.coarse + skipped;
      const float* __restrict Uk = row_k + run.coarse + skipped;
      const int m = (run.count - skipped + 1) / 2;
#pragma omp simd
      for (int t = 0; t < m; ++t)
        u[t] += U[2 * t] + wj * (Uj[2 * t] - U[2 * t]) + wk * (Uk[2 * t] - U[2 * t]);
    }
  }
}

void Transfer::prolong_plane(int k)
{
  const IndexBox& owned = fine_.layout().owned;
  for (int j = owned.lo[1]; j < owned.hi[1]; ++j)
    for (int colour = 0; colour < 2; ++colour)
      if (includes(fine_.residual_colours(), colour))
        add_coarse_row(j, k, colour);
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
