// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/level.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace luff::poisson {

namespace {

/// Seven-point rows of one colour: every neighbour is of the other one.
struct Neighbours {
  const float* __restrict left;
  const float* __restrict right;
  const float* __restrict j_low;
  const float* __restrict j_high;
  const float* __restrict k_low;
  const float* __restrict k_high;

  Neighbours(const float* values, const Stencil& s)
      : left(values + s.left),
        right(values + s.right),
        j_low(values + s.j_low),
        j_high(values + s.j_high),
        k_low(values + s.k_low),
        k_high(values + s.k_high)
  {
  }
};

/// Coefficients from tables along each axis; a row of the operator gives
///   neighbours:  sum of the neighbours' values times coefficients, so that u = (f + neighbours)/diagonal;
///   image:       A u at a cell of value `own`, by differences: exactly zero where u is constant, or modes that are
///                nearly constant on both sides of a narrow gap would drown in round-off.
struct ProductRow {
  Neighbours u;
  const float* __restrict left_face;
  const float* __restrict right_face;
  const float* __restrict width;
  const float* __restrict inverse_diagonal;
  float row, cj_low, cj_high, ck_low, ck_high;

  [[nodiscard]] float neighbours(int n) const
  {
    return row * (left_face[n] * u.left[n] + right_face[n] * u.right[n]) +
           width[n] * (cj_low * u.j_low[n] + cj_high * u.j_high[n] + ck_low * u.k_low[n] + ck_high * u.k_high[n]);
  }
  [[nodiscard]] float image(int n, float own) const
  {
    return row * (left_face[n] * (own - u.left[n]) + right_face[n] * (own - u.right[n])) +
           width[n] * (cj_low * (own - u.j_low[n]) + cj_high * (own - u.j_high[n]) + ck_low * (own - u.k_low[n]) +
                       ck_high * (own - u.k_high[n]));
  }
  [[nodiscard]] float inverse(int n) const { return inverse_diagonal[n]; }
  /// Where loops end: beyond the row all coefficients are zero, and so is what they make.
  [[nodiscard]] static int end(const Stencil& s) { return Layout::whole_vectors(s.count); }
};

/// Coefficients from memory.
struct StoredRow {
  Neighbours u;
  const float* __restrict left;
  const float* __restrict right;
  const float* __restrict j_low;
  const float* __restrict j_high;
  const float* __restrict k_low;
  const float* __restrict k_high;

  StoredRow(const float* values, const StoredCoefficients& c, const Stencil& s)
      : u(values, s),
        left(c.face(0) + s.own),
        right(c.face(0) + s.right),
        j_low(c.face(1) + s.own),
        j_high(c.face(1) + s.j_high),
        k_low(c.face(2) + s.own),
        k_high(c.face(2) + s.k_high)
  {
  }
  [[nodiscard]] float neighbours(int n) const
  {
    return left[n] * u.left[n] + right[n] * u.right[n] + j_low[n] * u.j_low[n] + j_high[n] * u.j_high[n] +
           k_low[n] * u.k_low[n] + k_high[n] * u.k_high[n];
  }
  [[nodiscard]] float image(int n, float own) const
  {
    return left[n] * (own - u.left[n]) + right[n] * (own - u.right[n]) + j_low[n] * (own - u.j_low[n]) +
           j_high[n] * (own - u.j_high[n]) + k_low[n] * (own - u.k_low[n]) + k_high[n] * (own - u.k_high[n]);
  }
  /// 0 in isolated cells.
  [[nodiscard]] float inverse(int n) const
  {
    const float diagonal = left[n] + right[n] + j_low[n] + j_high[n] + k_low[n] + k_high[n];
    return diagonal > 0.0f ? 1.0f / diagonal : 0.0f;
  }
  [[nodiscard]] static int end(const Stencil& s) { return s.count; }
};

}  // namespace

Level::Level(const Box& box, const IndexBox& owned, const Neighbourhood* neighbourhood, Kind kind)
    : layout_(owned),
      stored_(kind == Kind::Stored ? std::make_unique<StoredCoefficients>(layout_, box.lines) : nullptr),
      box_{box.lines, stored_.get()},
      distributed_(neighbourhood != nullptr),
      neighbourhood_(neighbourhood),
      exchange_(layout_, box.lines, neighbourhood),
      places_(Layout::whole_vectors(layout_.count(0)))
{
  colours_clash_ = box.lines[0].odd_seam() || box.lines[1].odd_seam() || box.lines[2].odd_seam();
  residual_colours_ = colours_clash_ ? Colours::Both : Colours::Red;
  if (stored_ == nullptr) {
    make_tables();
    make_row_coefficients();
  }
  set_cuts(Cuts{});
}

void Level::make_tables()
{
  const Line& x = box_.lines[0];
  for (auto* table : {&left_, &right_, &width_})
    for (Values& values : *table)
      values.resize(places_);
  for (int i = 0; i < x.n; ++i) {
    left_[i & 1][i >> 1] = static_cast<float>(x.inverse_d[i]);
    right_[i & 1][i >> 1] = static_cast<float>(x.inverse_d[i + 1]);
    width_[i & 1][i >> 1] = static_cast<float>(x.h[i]);
  }
}

/// Rows with the same widths across them share their inverse diagonals.
void Level::make_row_coefficients()
{
  const auto float_of = [](double value) { return static_cast<float>(value); };
  const IndexBox& owned = layout_.owned;
  const Line& y = box_.lines[1];
  const Line& z = box_.lines[2];
  std::map<std::pair<float, float>, std::ptrdiff_t> known;
  for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
    for (int j = owned.lo[1]; j < owned.hi[1]; ++j) {
      const float hj = float_of(y.h[j]);
      const float hk = float_of(z.h[k]);
      RowCoefficients c{hj * hk,
                        hk * float_of(y.inverse_d[j]),
                        hk * float_of(y.inverse_d[j + 1]),
                        hj * float_of(z.inverse_d[k]),
                        hj * float_of(z.inverse_d[k + 1]),
                        0};
      const float across = c.j_low + c.j_high + c.k_low + c.k_high;
      const auto next = 2 * places_ * static_cast<std::ptrdiff_t>(known.size());
      c.inverse = known.try_emplace({c.row, across}, next).first->second;
      row_coefficients_.push_back(c);
    }
  inverse_diagonals_.resize(2 * places_ * static_cast<std::ptrdiff_t>(known.size()));
  for (const auto& [widths, start] : known)
    for (int parity = 0; parity < 2; ++parity)
      for (int n = 0; n < layout_.count(parity); ++n)
        inverse_diagonals_[start + parity * places_ + n] =
            1.0f / (widths.first * (left_[parity][n] + right_[parity][n]) + widths.second * width_[parity][n]);
}

/// work(stencil, row) for the rows of a colour on plane k, as functions of `values`.
template <class Work>
void Level::for_rows(int k, int colour, const float* values, Work work) const
{
  if (stored_ != nullptr) {
    for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j) {
      const Stencil s(layout_, j, k, colour);
      work(s, StoredRow(values, *stored_, s));
    }
    return;
  }
  const RowCoefficients* c =
      row_coefficients_.data() + static_cast<std::ptrdiff_t>(k - layout_.owned.lo[2]) * layout_.owned.extent(1);
  for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j, ++c) {
    const Stencil s(layout_, j, k, colour);
    work(s, ProductRow{Neighbours(values, s), left_[s.parity].data(), right_[s.parity].data(), width_[s.parity].data(),
                       inverse_diagonals_.data() + c->inverse + s.parity * places_, c->row, c->j_low, c->j_high,
                       c->k_low, c->k_high});
  }
}

void Level::start_plane(int k, int colour, Values& x, const Values& b)
{
  for_rows(k, colour, x.data(), [&x, &b](const Stencil& s, const auto& row) {
    const float* __restrict rhs = b.data() + s.own;
    float* __restrict out = x.data() + s.own;
    const int end = row.end(s);
#pragma omp simd
    for (int n = 0; n < end; ++n)
      out[n] = rhs[n] * row.inverse(n);
  });
  for (const Row* row = rows_begin(k, colour); row != rows_end(k, colour); ++row) {
    x[row->place] = (b[row->place] + sum_of_extras(*row, x.data())) * row->inverse;
  }
  exchange_.close_plane(x.data(), k, colour == 0 ? Colours::Red : Colours::Black);
}

void Level::relax_plane(int k, int colour, Values& x, const Values& b)
{
  for_rows(k, colour, x.data(), [&x, &b](const Stencil& s, const auto& row) {
    const float* __restrict rhs = b.data() + s.own;
    float* __restrict out = x.data() + s.own;
    const int end = row.end(s);
#pragma omp simd
    for (int n = 0; n < end; ++n)
      out[n] = (rhs[n] + row.neighbours(n)) * row.inverse(n);
  });
  relax_cut_cells_plane(k, colour, x, b);
}

void Level::relax_cut_cells_plane(int k, int colour, Values& x, const Values& b)
{
  for (const Row* row = rows_begin(k, colour); row != rows_end(k, colour); ++row)
    x[row->place] = (b[row->place] + neighbour_sum(*row, x.data())) * row->inverse;
  exchange_.close_plane(x.data(), k, colour == 0 ? Colours::Red : Colours::Black);
}

void Level::residual_plane(int k, int colour)
{
  for_rows(k, colour, u.data(), [this](const Stencil& s, const auto& row) {
    const float* __restrict rhs = f.data() + s.own;
    const float* __restrict own = u.data() + s.own;
    float* __restrict out = r.data() + s.own;
    const int end = row.end(s);
#pragma omp simd
    for (int n = 0; n < end; ++n)
      out[n] = rhs[n] - row.image(n, own[n]);
  });
  for (const Row* row = rows_begin(k, colour); row != rows_end(k, colour); ++row)
    r[row->place] = f[row->place] - image(*row, u.data());
  exchange_.close_plane(r.data(), k, colour == 0 ? Colours::Red : Colours::Black);
}

double Level::apply_plane(int k, const float* p, float* q) const
{
  double sum = 0.0;
  for (int colour = 0; colour < 2; ++colour) {
    for_rows(k, colour, p, [&](const Stencil& s, const auto& row) {
      const float* __restrict own = p + s.own;
      float* __restrict out = q + s.own;
      float part = 0.0f;
      const int end = row.end(s);
#pragma omp simd reduction(+ : part)
      for (int n = 0; n < end; ++n) {
        const float value = row.image(n, own[n]);
        out[n] = value;
        part += value * own[n];
      }
      sum += part;
    });
    for (const Row* row = rows_begin(k, colour); row != rows_end(k, colour); ++row) {
      const float value = image(*row, p);
      sum += static_cast<double>(p[row->place]) * (value - q[row->place]);
      q[row->place] = value;
    }
  }
  return sum;
}

float Level::neighbour_sum(const Row& row, const float* values) const
{
  float sum = 0.0f;
  for (int e = row.begin; e < row.end; ++e)
    sum += entries_[e].coefficient * values[entries_[e].place];
  return sum;
}

float Level::sum_of_extras(const Row& row, const float* values) const
{
  float sum = 0.0f;
  for (int e = row.begin; e < row.end; ++e)
    if (entries_[e].place >= layout_.size)
      sum += entries_[e].coefficient * values[entries_[e].place];
  return sum;
}

float Level::image(const Row& row, const float* values) const
{
  const float own = values[row.place];
  float sum = row.grounded * own;
  for (int e = row.begin; e < row.end; ++e)
    sum += entries_[e].coefficient * (own - values[entries_[e].place]);
  return sum;
}

void Level::relax_extra_rows(int begin, int end, Order order, Values& x, const Values& b) const
{
  for (int t = begin; t < end; ++t) {
    const Row& row = extra_rows_[order == Order::Forward ? t : begin + end - 1 - t];
    x[row.place] = (b[row.place] + neighbour_sum(row, x.data())) * row.inverse;
  }
}

void Level::relax_extras_plane(int k, Order order)
{
  const auto [begin, end] = extra_rows_of_plane_[k - layout_.owned.lo[2]];
  relax_extra_rows(begin, end, order, u, f);
}

void Level::relax_extras(Order order, bool from_zero, Values& x, const Values& b)
{
  if (extras_ == 0)
    return;
  if (from_zero) {
    std::fill_n(x.data() + layout_.size, extras_, 0.0f);
    for (const Row& row : extra_rows_)
      x[row.place] = (b[row.place] + sum_of_extras(row, x.data())) * row.inverse;
  } else {
    relax_extra_rows(0, static_cast<int>(extra_rows_.size()), order, x, b);
  }
  share_extras(x.data());
}

void Level::residual_extras()
{
  for (const Row& row : extra_rows_)
    r[row.place] = f[row.place] - image(row, u.data());
  share_extras(r.data());
}

void Level::share_extras(float* values) const
{
  if (!distributed_ || extras_ == 0)
    return;
  std::vector<float> own(extras_, 0.0f);
  for (const int e : owned_extras_)
    own[e] = values[layout_.size + e];
  MPI_Allreduce(own.data(), values + layout_.size, extras_, MPI_FLOAT, MPI_SUM, neighbourhood_->comm);
}

void Level::sum_over_ranks(Values& values) const
{
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_FLOAT, MPI_SUM, neighbourhood_->comm);
}

const Level::Row* Level::rows_begin(int k, int colour) const
{
  return rows_.data() + first_row_[2 * (k - layout_.owned.lo[2]) + colour];
}
const Level::Row* Level::rows_end(int k, int colour) const
{
  return rows_.data() + first_row_[2 * (k - layout_.owned.lo[2]) + colour + 1];
}

std::ptrdiff_t Level::place(Unknown x) const
{
  if (!is_cell(x))
    return layout_.size + extra_number(x);
  Index3 c = box_.cell(x);
  for (int a = 0; a < 3; ++a) {
    const int n = box_.lines[a].n;
    const auto near = [&](int i) { return i >= layout_.owned.lo[a] - 1 && i <= layout_.owned.hi[a]; };
    for (const int shift : {0, -n, n})
      if (near(c[a] + shift)) {
        c[a] += shift;
        break;
      }
    if (!near(c[a]))
      return -1;
  }
  return layout_.index(c[0], c[1], c[2]);
}

/// The place of a neighbour, seen across periodic seams as a halo cell, or of the cell itself.
std::ptrdiff_t Level::place_beside(const Index3& cell, int side, Unknown x) const
{
  if (!is_cell(x))
    return layout_.size + extra_number(x);
  if (side == within)
    return layout_.index(cell);
  Index3 c = cell;
  c[side / 2] += side % 2 == 0 ? -1 : 1;
  return layout_.index(c[0], c[1], c[2]);
}

/// Stored coefficients are rounded to single precision.
bool Level::differs(const CutCell& cut) const
{
  const double round_off = stored_ != nullptr ? 1e-6 : 1e-9;
  for (int side = 0; side < 6; ++side) {
    const double clean = box_.coefficient(cut.cell, side);
    if (std::abs(cut.coefficient[side] - clean) > round_off * clean)
      return true;
  }
  return false;
}

void Level::finish_row(std::int32_t place, int begin, double grounded, std::vector<Row>& rows)
{
  double diagonal = grounded;
  for (std::size_t e = begin; e < entries_.size(); ++e)
    diagonal += entries_[e].coefficient;
  rows.push_back({place, begin, static_cast<int>(entries_.size()), static_cast<float>(grounded),
                  diagonal > 0.0 ? static_cast<float>(1.0 / diagonal) : 0.0f});
}

void Level::add_cell_row(const Cuts& cuts, const CutCell& cut)
{
  const auto links = cuts.links_from(cut.links);
  if (links.empty() && !differs(cut))
    return;
  const int begin = static_cast<int>(entries_.size());
  for (int side = 0; side < 6; ++side) {
    const double c = cut.coefficient[side];
    if (c > 0.0)
      entries_.push_back({static_cast<std::int32_t>(place_beside(cut.cell, side, 0)), static_cast<float>(c)});
  }
  for (const Link& link : links) {
    entries_.push_back(
        {static_cast<std::int32_t>(place_beside(cut.cell, link.side, link.to)), static_cast<float>(link.coefficient)});
  }
  const Index3& c = cut.cell;
  finish_row(static_cast<std::int32_t>(layout_.index(c[0], c[1], c[2])), begin, /*grounded=*/0.0, rows_);
}

void Level::add_extra_row(const Cuts& cuts, int e)
{
  const int begin = static_cast<int>(entries_.size());
  double grounded = 0.0;
  for (const Link& link : cuts.links_from_extra(e)) {
    if (link.to == outside)
      grounded += link.coefficient;
    else
      entries_.push_back({static_cast<std::int32_t>(place_beside(cuts.extras[e].cell, link.side, link.to)),
                          static_cast<float>(link.coefficient)});
  }
  finish_row(static_cast<std::int32_t>(layout_.size + e), begin, grounded, extra_rows_);
}

/// By planes, the even ones first: extras of planes of one parity know nothing of each other.
void Level::add_extra_rows(const Cuts& cuts)
{
  const auto plane = [&](int e) { return cuts.extras[e].cell[2]; };
  std::stable_sort(owned_extras_.begin(), owned_extras_.end(),
                   [&](int a, int b) { return std::pair(plane(a) & 1, plane(a)) < std::pair(plane(b) & 1, plane(b)); });
  extra_rows_of_plane_.assign(layout_.owned.extent(2), {0, 0});
  for (const int e : owned_extras_) {
    auto& [begin, end] = extra_rows_of_plane_[plane(e) - layout_.owned.lo[2]];
    if (begin == end)
      begin = static_cast<int>(extra_rows_.size());
    add_extra_row(cuts, e);
    end = static_cast<int>(extra_rows_.size());
  }
}

void Level::set_cuts(const Cuts& cuts)
{
  rows_.clear();
  extra_rows_.clear();
  entries_.clear();
  owned_extras_.clear();
  extras_ = static_cast<int>(cuts.extras.size());
  for (Values* values : {&u, &f, &r})
    values->resize_from(layout_.size, layout_.size + extras_);
  const auto& owned = layout_.owned;
  std::vector<std::pair<std::ptrdiff_t, const CutCell*>> cells;  // by planes and colours, then along rows
  for (const CutCell& cut : cuts.cells)
    if (owned.contains(cut.cell))
      cells.emplace_back(layout_.index(cut.cell), &cut);
  std::sort(cells.begin(), cells.end());
  first_row_.assign(1, 0);
  auto next = cells.begin();
  for (int k = owned.lo[2]; k < owned.hi[2]; ++k)
    for (int colour = 0; colour < 2; ++colour) {
      const std::ptrdiff_t end = layout_.start(owned.hi[1], k, colour);
      for (; next != cells.end() && next->first < end; ++next)
        add_cell_row(cuts, *next->second);
      first_row_.push_back(static_cast<int>(rows_.size()));
    }
  for (int e = 0; e < extras_; ++e)
    if (owned.contains(cuts.extras[e].cell))
      owned_extras_.push_back(e);
  add_extra_rows(cuts);
}

}  // namespace luff::poisson
