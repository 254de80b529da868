// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/cross_terms.hpp"

#include "poisson/curvilinear_operator.hpp"

namespace luff::poisson {

CrossTerms::CrossTerms(Level& level) : level_(level), layout_(level.layout()), cells_(level.box().cells())
{
  for (int a = 0; a < 3; ++a) {
    g_[a].resize(layout_.size);
    w_[a].resize(layout_.size);
    for (int side = 0; side < 2; ++side) {
      const Line& line = level.box().lines[a];
      const bool at_end = layout_.owned.lo[a] == 0 && side == 0;
      const bool at_other_end = layout_.owned.hi[a] == line.n && side == 1;
      const bool side_of_domain = !line.periodic && (at_end || at_other_end);
      beyond_[a][side] = !side_of_domain                                ? Beyond::Cells
                         : line.sides[side] == SideCondition::Dirichlet ? Beyond::Pressure
                                                                        : Beyond::Wall;
    }
  }
}

void CrossTerms::load(const IndexBox& box, const Source& source)
{
  for (int pair = 0; pair < 3; ++pair)
    for_each_cell_in_order(box, [&](int i, int j, int k) {
      g_[pair][layout_.index(i, j, k)] = static_cast<float>(source(pair, {i, j, k}));
    });
}

void CrossTerms::load(std::span<const Index3> cells, const Source& source)
{
  for (const Index3& c : cells)
    for (int pair = 0; pair < 3; ++pair)
      g_[pair][layout_.index(c)] = static_cast<float>(source(pair, c));
}

void CrossTerms::close()
{
  for (Values& g : g_)
    level_.exchange().exchange_with_edges(g.data());
}

void CrossTerms::set_partial_faces(std::span<const FaceIndex> faces)
{
  const auto& lines = level_.box().lines;
  beside_partial_ = {faces, layout_.owned, cells_, {lines[0].periodic, lines[1].periodic, lines[2].periodic}, 2};
}

inline float CrossTerms::half(int axis, int side, int index) const
{
  const int end = side == 0 ? 0 : cells_[axis] - 1;
  return beyond_[axis][side] == Beyond::Pressure && index == end ? 1.0f : 0.5f;
}

namespace {

/// Differences across the two faces of the cells of a row, each halved, 0 across closed ones.
struct Differences {
  const float* __restrict low_open;
  const float* __restrict high_open;
  const float* __restrict low;
  const float* __restrict high;
  float low_half, high_half;

  [[nodiscard]] float operator()(int n, float own) const
  {
    return (low_open[n] > 0.0f ? low_half * (own - low[n]) : 0.0f) +
           (high_open[n] > 0.0f ? high_half * (high[n] - own) : 0.0f);
  }
};

}  // namespace

/// w of the cells of one colour in row (j, k), without what p = 0 on a side at an end of the row adds.
void CrossTerms::cross_row(int j, int k, int colour, const float* values)
{
  const StoredCoefficients& a = level_.coefficients();
  const Stencil s(layout_, j, k, colour);
  const Differences dx{a.face(0) + s.own, a.face(0) + s.right, values + s.left, values + s.right, 0.5f, 0.5f};
  const Differences dy{a.face(1) + s.own, a.face(1) + s.j_high, values + s.j_low,
                       values + s.j_high, half(1, 0, j),        half(1, 1, j)};
  const Differences dz{a.face(2) + s.own, a.face(2) + s.k_high, values + s.k_low,
                       values + s.k_high, half(2, 0, k),        half(2, 1, k)};
  const float* __restrict own = values + s.own;
  const float* __restrict g_xy = g_[0].data() + s.own;
  const float* __restrict g_xz = g_[1].data() + s.own;
  const float* __restrict g_yz = g_[2].data() + s.own;
  float* __restrict w_x = w(0, k) + s.own;
  float* __restrict w_y = w(1, k) + s.own;
  float* __restrict w_z = w(2, k) + s.own;
#pragma omp simd
  for (int n = 0; n < s.count; ++n) {
    const float x = dx(n, own[n]);
    const float y = dy(n, own[n]);
    const float z = dz(n, own[n]);
    w_x[n] = g_xy[n] * y + g_xz[n] * z;
    w_y[n] = g_xy[n] * x + g_yz[n] * z;
    w_z[n] = g_xz[n] * x + g_yz[n] * y;
  }
}

/// w_a alone, of cells beyond an edge of the block along a = 1 or 2.
void CrossTerms::cross_row_across(int axis, int j, int k, int colour, const float* values)
{
  const StoredCoefficients& a = level_.coefficients();
  const Stencil s(layout_, j, k, colour);
  const Differences dx{a.face(0) + s.own, a.face(0) + s.right, values + s.left, values + s.right, 0.5f, 0.5f};
  const int other = 3 - axis;
  const std::ptrdiff_t low = other == 1 ? s.j_low : s.k_low;
  const std::ptrdiff_t high = other == 1 ? s.j_high : s.k_high;
  const int index = other == 1 ? j : k;
  const Differences d{a.face(other) + s.own, a.face(other) + high,  values + low,
                      values + high,         half(other, 0, index), half(other, 1, index)};
  const float* __restrict own = values + s.own;
  const float* __restrict g_x = g_[axis == 1 ? 0 : 1].data() + s.own;
  const float* __restrict g_other = g_[2].data() + s.own;
  float* __restrict out = w(axis, k) + s.own;
#pragma omp simd
  for (int n = 0; n < s.count; ++n)
    out[n] = g_x[n] * dx(n, own[n]) + g_other[n] * d(n, own[n]);
}

/// The other half of the difference to p = 0 at the ends of a row.
void CrossTerms::add_ends(int j, int k, const float* values)
{
  for (int side = 0; side < 2; ++side) {
    if (beyond_[0][side] != Beyond::Pressure)
      continue;
    const int i = side == 0 ? 0 : cells_[0] - 1;
    const std::ptrdiff_t q = layout_.index(i, j, k);
    if (!(level_.coefficients().face(0, {i + side, j, k}) > 0.0))
      continue;
    const float d = (side == 0 ? 0.5f : -0.5f) * values[q];
    w(1, k)[q] += g_[0][q] * d;
    w(2, k)[q] += g_[1][q] * d;
  }
}

/// Takes the closed parts of faces out of w in the cells of a plane.  None of them lies on a side of the domain.
void CrossTerms::weigh_cross_terms(int k, const float* values)
{
  for (const PartialFaces::Beside& face : beside_partial_.on_plane(k)) {
    const int b = face.axis;
    const std::ptrdiff_t own = layout_.index(face.cell);
    const std::ptrdiff_t beyond = layout_.index(stepped(face.cell, b, face.side == 0 ? -1 : 1));
    const float d = (face.side == 0 ? -0.5f : 0.5f) * (values[beyond] - values[own]);
    for (const int a : {(b + 1) % 3, (b + 2) % 3})
      if (beside_partial_.has_cross_term(a, face.cell))
        w(a, k)[own] -= static_cast<float>(face.closed) * g_[pair_without(3 - a - b)][own] * d;
  }
}

/// w_1 beyond the ends of a row.
void CrossTerms::close_row(int j, int k)
{
  const int n = cells_[0];
  const bool periodic = beyond_[0][0] == Beyond::Cells;
  float* const along = w(0, k);
  along[layout_.index(-1, j, k)] = along[layout_.index(periodic ? n - 1 : 0, j, k)];
  along[layout_.index(n, j, k)] = along[layout_.index(periodic ? 0 : n - 1, j, k)];
}

void CrossTerms::prepare_plane(int k, const float* values)
{
  const IndexBox& owned = layout_.owned;
  const auto across = [&](int axis, int j, int plane) {
    for (int colour = 0; colour < 2; ++colour)
      cross_row_across(axis, j, plane, colour, values);
    add_ends(j, plane, values);
  };
  for (int j = owned.lo[1]; j < owned.hi[1]; ++j) {
    for (int colour = 0; colour < 2; ++colour)
      cross_row(j, k, colour, values);
    add_ends(j, k, values);
  }
  for (int side = 0; side < 2; ++side) {
    if (beyond_[1][side] == Beyond::Cells && cells_[1] > 1)
      across(1, side == 0 ? owned.lo[1] - 1 : owned.hi[1], k);
    if (beyond_[2][side] != Beyond::Cells || cells_[2] == 1 || k != (side == 0 ? owned.lo[2] : owned.hi[2] - 1))
      continue;
    const int beyond = side == 0 ? k - 1 : k + 1;
    for (int j = owned.lo[1]; j < owned.hi[1]; ++j)
      across(2, j, beyond);
    weigh_cross_terms(beyond, values);
  }
  weigh_cross_terms(k, values);
  for (int j = owned.lo[1]; j < owned.hi[1]; ++j)
    close_row(j, k);
}

/// Takes the closed parts of faces out of what was added on a plane; returns the change of the sum.
template <int sign>
double CrossTerms::weigh_cross_fluxes(int k, const float* p, float* q) const
{
  double sum = 0.0;
  for (const PartialFaces::Beside& face : beside_partial_.on_plane(k)) {
    if (!beside_partial_.owns(face.cell))
      continue;
    const Index3 beyond = stepped(face.cell, face.axis, face.side == 0 ? -1 : 1);
    const std::ptrdiff_t own = layout_.index(face.cell);
    const float flux = w(face.axis, k)[own] + w(face.axis, beyond[2])[layout_.index(beyond)];
    const float value = (face.side == 0 ? -0.5f : 0.5f) * sign * static_cast<float>(face.closed) * flux;
    q[own] += value;
    sum += value * p[own];
  }
  return sum;
}

/// At sides of the domain w beyond is that of the cell itself.
template <int sign>
double CrossTerms::add_plane(int k, const float* p, float* q) const
{
  const StoredCoefficients& a = level_.coefficients();
  double sum = 0.0;
  for (int j = layout_.owned.lo[1]; j < layout_.owned.hi[1]; ++j)
    for (int colour = 0; colour < 2; ++colour) {
      const Stencil s(layout_, j, k, colour);
      const float* __restrict x_low = a.face(0) + s.own;
      const float* __restrict x_high = a.face(0) + s.right;
      const float* __restrict y_low = a.face(1) + s.own;
      const float* __restrict y_high = a.face(1) + s.j_high;
      const float* __restrict z_low = a.face(2) + s.own;
      const float* __restrict z_high = a.face(2) + s.k_high;
      const float* __restrict wx = w(0, k) + s.own;
      const float* __restrict wx_low = w(0, k) + s.left;
      const float* __restrict wx_high = w(0, k) + s.right;
      const float* __restrict wy = w(1, k) + s.own;
      const float* __restrict wy_low = at_side(1, 0, j) ? wy : w(1, k) + s.j_low;
      const float* __restrict wy_high = at_side(1, 1, j) ? wy : w(1, k) + s.j_high;
      const float* __restrict wz = w(2, k) + s.own;
      const float* __restrict wz_low = at_side(2, 0, k) ? wz : w(2, k - 1) + s.k_low;
      const float* __restrict wz_high = at_side(2, 1, k) ? wz : w(2, k + 1) + s.k_high;
      const float* __restrict own = p + s.own;
      float* __restrict out = q + s.own;
      float part = 0.0f;
#pragma omp simd reduction(+ : part)
      for (int n = 0; n < s.count; ++n) {
        const float x = (x_low[n] > 0.0f ? wx[n] + wx_low[n] : 0.0f) - (x_high[n] > 0.0f ? wx[n] + wx_high[n] : 0.0f);
        const float y = (y_low[n] > 0.0f ? wy[n] + wy_low[n] : 0.0f) - (y_high[n] > 0.0f ? wy[n] + wy_high[n] : 0.0f);
        const float z = (z_low[n] > 0.0f ? wz[n] + wz_low[n] : 0.0f) - (z_high[n] > 0.0f ? wz[n] + wz_high[n] : 0.0f);
        const float value = 0.5f * sign * (x + y + z);
        out[n] += value;
        part += value * own[n];
      }
      sum += part;
    }
  return sum + weigh_cross_fluxes<sign>(k, p, q);
}

template double CrossTerms::add_plane<1>(int, const float*, float*) const;
template double CrossTerms::add_plane<-1>(int, const float*, float*) const;

}  // namespace luff::poisson
