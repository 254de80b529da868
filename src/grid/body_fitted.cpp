// SPDX-License-Identifier: BSD-3-Clause
#include "grid/body_fitted.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace luff::grid {

namespace {

/// Consecutive nodes along one axis that a source can be asked for at once.
struct Stretch {
  int first = 0;   ///< number of the first node wanted
  int count = 0;   ///< how many
  int source = 0;  ///< number under which the source knows it
  int turns = 0;   ///< periods between the two
};

/// Nodes lo - 1 ... hi + 1 along an axis, as far as the source knows them; along periodic axes all.
std::vector<Stretch> stretches(const Decomposition& ranks, int axis)
{
  const int n = ranks.cells()[axis];
  const int first = ranks.owned().lo[axis] - 1;
  const int last = ranks.owned().hi[axis] + 1;
  std::vector<Stretch> result;
  const int inner_first = std::max(first, 0);
  const int inner_last = std::min(last, n);
  result.push_back({inner_first, inner_last - inner_first + 1, inner_first, 0});
  if (!ranks.periodic(axis))
    return result;
  if (first < 0)
    result.push_back({-1, 1, n - 1, -1});
  if (last > n)
    result.push_back({n + 1, 1, 1, 1});
  return result;
}

/// What one period along an axis adds to a place.
Vec3 period(const Decomposition& ranks, int axis, const NodeSource& source)
{
  const auto at = [&](const Index3& node) { return source({node, {node[0] + 1, node[1] + 1, node[2] + 1}}).front(); };
  return at(stepped({0, 0, 0}, axis, ranks.cells()[axis])) - at({0, 0, 0});
}

}  // namespace

BodyFitted::BodyFitted(const Decomposition& ranks, const NodeSource& source) : owned_(ranks.owned())
{
  read_nodes(ranks, source);
  extrapolate_nodes(ranks);
  for (int c = 0; c < 3; ++c)
    metric_.node[c] = std::as_const(nodes_[c]).view();
  find_handedness(ranks);
  make_area_vectors();
  make_cells(ranks);
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 3; ++c)
      metric_.S[a][c] = std::as_const(area_[a][c]).view();
  for (int n = 0; n < 6; ++n)
    metric_.G[n] = std::as_const(tensor_[n]).view();
  metric_.V = std::as_const(volume_).view();
}

void BodyFitted::read_nodes(const Decomposition& ranks, const NodeSource& source)
{
  nodes_ = make_field3<double>(owned_.faces(0).faces(1).faces(2));
  std::array<Vec3, 3> turn;
  for (int a = 0; a < 3; ++a)
    turn[a] = ranks.periodic(a) ? period(ranks, a, source) : Vec3::Zero();
  for (const Stretch& z : stretches(ranks, 2))
    for (const Stretch& y : stretches(ranks, 1))
      for (const Stretch& x : stretches(ranks, 0)) {
        const std::vector<Vec3> values =
            source({{x.source, y.source, z.source}, {x.source + x.count, y.source + y.count, z.source + z.count}});
        const Vec3 moved = x.turns * turn[0] + y.turns * turn[1] + z.turns * turn[2];
        std::size_t n = 0;
        for (int k = z.first; k < z.first + z.count; ++k)
          for (int j = y.first; j < y.first + y.count; ++j)
            for (int i = x.first; i < x.first + x.count; ++i, ++n)
              for (int c = 0; c < 3; ++c)
                nodes_[c](i, j, k) = values[n][c] + moved[c];
      }
}

/// Beyond the sides of the domain cells repeat the edges of those inside.
void BodyFitted::extrapolate_nodes(const Decomposition& ranks)
{
  const IndexBox nodes = owned_.faces(0).faces(1).faces(2).grown(1);
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end) {
      if (!ranks.at_boundary(a, end))
        continue;
      IndexBox layer = nodes;
      const int beyond = end == 0 ? nodes.lo[a] : nodes.hi[a] - 1;
      layer.lo[a] = beyond;
      layer.hi[a] = beyond + 1;
      const int inwards = end == 0 ? 1 : -1;
      for (int c = 0; c < 3; ++c)
        for_each_cell_in_order(layer, [&, x = nodes_[c].view()](int i, int j, int k) {
          const Index3 here{i, j, k};
          x(here) = 2.0 * x(stepped(here, a, inwards)) - x(stepped(here, a, 2 * inwards));
        });
    }
}

Vec3 BodyFitted::centre(int i, int j, int k) const
{
  Vec3 sum = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner)
    sum += node(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
  return 0.125 * sum;
}

Vec3 BodyFitted::face_centre(int axis, int i, int j, int k) const
{
  const Index3 low{i, j, k};
  const int b = (axis + 1) % 3;
  const int c = (axis + 2) % 3;
  Vec3 sum = Vec3::Zero();
  for (const Index3& n : {low, stepped(low, b, 1), stepped(low, c, 1), stepped(stepped(low, b, 1), c, 1)})
    sum += node(n[0], n[1], n[2]);
  return 0.25 * sum;
}

/// T_a, the mean of the four edges of a cell along each direction.
std::array<Vec3, 3> BodyFitted::mean_edges(int i, int j, int k) const
{
  std::array<Vec3, 3> T;
  const Index3 low{i, j, k};
  for (int a = 0; a < 3; ++a) {
    const Index3 high = stepped(low, a, 1);
    T[a] = face_centre(a, high[0], high[1], high[2]) - face_centre(a, i, j, k);
  }
  return T;
}

double BodyFitted::jacobian(int i, int j, int k) const
{
  const auto T = mean_edges(i, j, k);
  return handedness_ * T[0].dot(T[1].cross(T[2]));
}

/// By the majority of volume, so that one folded cell does not turn the whole grid.
void BodyFitted::find_handedness(const Decomposition& ranks)
{
  double volume = 0.0;
  for_each_cell_in_order(owned_, [&](int i, int j, int k) { volume += jacobian(i, j, k); });
  handedness_ = ranks.sum(volume) < 0.0 ? -1.0 : 1.0;
}

/// S = (x_11 - x_00) x (x_01 - x_10)/2.
void BodyFitted::make_area_vectors()
{
  for (int a = 0; a < 3; ++a) {
    area_[a] = make_field3<double>(owned_);
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    for_each_cell_in_order(owned_.grown(1), [&, S = views(area_[a])](int i, int j, int k) {
      const Index3 n{i, j, k};
      const auto at = [&](const Index3& m) { return node(m[0], m[1], m[2]); };
      const Vec3 diagonal = at(stepped(stepped(n, b, 1), c, 1)) - at(n);
      const Vec3 other = at(stepped(n, c, 1)) - at(stepped(n, b, 1));
      const Vec3 vector = 0.5 * handedness_ * diagonal.cross(other);
      for (int d = 0; d < 3; ++d)
        S[d](i, j, k) = vector[d];
    });
  }
}

/// Volume inside the bilinear faces [grandy_1997_efficient], Eq. (16).
double BodyFitted::exact_volume(int i, int j, int k) const
{
  const auto x = [&](int a, int b, int c) { return node(i + a, j + b, k + c); };
  const auto triple = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); };
  const std::array<Vec3, 3> from_origin{x(0, 1, 1) - x(0, 0, 0), x(1, 0, 1) - x(0, 0, 0), x(1, 1, 0) - x(0, 0, 0)};
  const std::array<Vec3, 3> to_end{x(1, 1, 1) - x(1, 0, 0), x(1, 1, 1) - x(0, 1, 0), x(1, 1, 1) - x(0, 0, 1)};
  return handedness_ / 12.0 *
         (triple(to_end[0] + from_origin[0], to_end[1], from_origin[2]) +
          triple(from_origin[0], to_end[1] + from_origin[1], to_end[2]) +
          triple(to_end[0], from_origin[1], to_end[2] + from_origin[2]));
}

/// G_ab = S_a . S_b/V with S_1 = T_2 x T_3 and so on, V = T_1 . S_1 [ge_2007_numerical].
void BodyFitted::make_cells(const Decomposition& ranks)
{
  volume_ = Field<double>(owned_, 1.0);
  for (auto& G : tensor_)
    G = Field<double>(owned_);
  double narrowest = std::numeric_limits<double>::max();
  for_each_cell_in_order(owned_.grown(1), [&](int i, int j, int k) {
    const auto T = mean_edges(i, j, k);
    const std::array<Vec3, 3> S{T[1].cross(T[2]), T[2].cross(T[0]), T[0].cross(T[1])};
    const double V = std::abs(T[0].dot(S[0]));
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b)
        tensor_[symmetric(a, b)](i, j, k) = S[a].dot(S[b]) / V;
    volume_(i, j, k) = exact_volume(i, j, k);
    if (owned_.contains(i, j, k))
      for (int a = 0; a < 3; ++a)
        narrowest = std::min(narrowest, V / S[a].norm());
  });
  smallest_width_ = -ranks.max(-narrowest);
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      if (ranks.at_boundary(a, end))
        repeat_inside(a, end);
}

/// Tensor and volume of the cells beyond a side are those of the cells inside.
void BodyFitted::repeat_inside(int axis, int end)
{
  IndexBox layer = owned_.grown(1);
  const int beyond = end == 0 ? layer.lo[axis] : layer.hi[axis] - 1;
  layer.lo[axis] = beyond;
  layer.hi[axis] = beyond + 1;
  const auto repeat = [&](const View<double>& value) {
    for_each_cell_in_order(layer, [&](int i, int j, int k) {
      value(i, j, k) = value(stepped({i, j, k}, axis, end == 0 ? 1 : -1));
    });
  };
  for (auto& G : tensor_)
    repeat(G.view());
  repeat(volume_.view());
}

}  // namespace luff::grid
