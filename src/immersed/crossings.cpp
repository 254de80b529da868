// SPDX-License-Identifier: BSD-3-Clause
// Crossings by exact signs and one symbolic displacement of the grid; the reasoning is in docs/numerics/crossings.md.
#include "immersed/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "immersed/predicates.hpp"

namespace luff::immersed {

namespace {

/// The first centre along an axis beyond x; the number of cells if there is none.
int first_centre_above(const grid::Grid& grid, int axis, double x)
{
  int from = 0;
  int to = grid.cells()[axis];
  while (from < to) {
    const int middle = (from + to) / 2;
    if (grid.centre(axis, middle) > x)
      to = middle;
    else
      from = middle + 1;
  }
  return from;
}

struct Range {
  int first = 0;
  int last = 0;  ///< one past the end
};

/// Centres c along an axis that lie within [low, high] once displaced: low < c <= high.
Range displaced_centres_within(const grid::Grid& grid, int axis, double low, double high)
{
  Range range{immersed::first_centre_above(grid, axis, low), 0};
  range.last = range.first;
  while (range.last < grid.cells()[axis] && grid.centre(axis, range.last) <= high)
    ++range.last;
  return range;
}

Range clipped(const Range& range, int first, int last)
{
  return {std::max(range.first, first), std::min(range.last, last)};
}

/// Side of the edge (from, to) on which the displaced point q - (e_b, e_c) lies: +1 left, -1 right, 0 when the edge has
/// no length.  `area` is (from - q) x (to - q); where it vanishes, e_b (to_c - from_c) - e_c (to_b - from_b) decides,
/// the larger displacement first.
int side_of_edge(double area, const Point2& from, const Point2& to, bool b_moves_more)
{
  if (area != 0.0)
    return sign(area);
  const int by_b = sign(to[1] - from[1]);
  const int by_c = sign(from[0] - to[0]);
  if (b_moves_more)
    return by_b != 0 ? by_b : by_c;
  return by_c != 0 ? by_c : by_b;
}

/// One triangle and the lines along one axis.
class LineSearch {
 public:
  /// `faces`: along the axis, those that hits are wanted of.
  LineSearch(const grid::Grid& grid, int axis, const Corners& x, int triangle, const Range& links, const Range& faces)
      : grid_(grid), a_(axis), x_(x), triangle_(triangle), links_(links), faces_(faces)
  {
    for (int m = 0; m < 3; ++m)
      shadow_[m] = projected(x[m], axis);
  }

  /// Appends the hit of the line through the centres (cell[b], cell[c]), if there is one and its face is wanted.
  void hit(Index3 cell, std::vector<Crossing>& found)
  {
    line_ = {grid_.centre(b_, cell[b_]), grid_.centre(c_, cell[c_])};
    if (!inside())
      return;
    const double total = areas_[0] + areas_[1] + areas_[2];
    for (int m = 0; m < 3; ++m)
      weights_[m] = areas_[m] / total;
    append(cell, first_centre_above(), found);
  }

 private:
  /// Whether the displaced line passes through the triangle; sets areas_ and side_.
  bool inside()
  {
    side_ = 0;
    for (int m = 0; m < 3; ++m) {
      const Point2& from = shadow_[(m + 1) % 3];
      const Point2& to = shadow_[(m + 2) % 3];
      areas_[m] = area(from, to, line_);
      const int side = side_of_edge(areas_[m], from, to, b_ < c_);
      if (side == 0 || (m > 0 && side != side_))
        return false;
      side_ = side;
    }
    return true;
  }

  /// sum_m w_m (x_m - from) along the line, and the largest |x_m - from|.
  std::array<double, 2> distance_to_hit(double from) const
  {
    double distance = 0.0;
    double reach = 0.0;
    for (int m = 0; m < 3; ++m) {
      distance += weights_[m] * (x_[m][a_] - from);
      reach = std::max(reach, std::abs(x_[m][a_] - from));
    }
    return {distance, reach};
  }

  /// Number of the first centre on the line, displaced, that lies above the hit; cells() when none does.
  int first_centre_above() const
  {
    Range range = links_;
    while (range.first < range.last) {
      const int middle = (range.first + range.last) / 2;
      if (hit_is_above(grid_.centre(a_, middle)))
        range.first = middle + 1;
      else
        range.last = middle;
    }
    return range.first;
  }

  /// Whether the hit lies above the displaced centre at `centre`.
  bool hit_is_above(double centre) const
  {
    // Areas right to 2^-45 make weights right to 2^-44 of themselves, and the distance to 2^-43 reach.
    constexpr double doubt = 0x1p-40;
    const auto [distance, reach] = distance_to_hit(centre);
    if (std::abs(distance) > doubt * reach)
      return distance > 0.0;
    const int exact = side_ * sign(exact_moment(centre));
    return exact != 0 ? exact > 0 : hit_is_above_touched_centre();
  }

  /// sum_m A_m (x_m - centre), A_m the areas of the projected triangle's parts: the triangle's determinant with the
  /// centre, exact in its sign.
  double exact_moment(double centre) const
  {
    ExactSum<192> sum;
    for (int m = 0; m < 3; ++m) {
      const auto part = exact_area(shadow_[(m + 1) % 3], shadow_[(m + 2) % 3], line_);
      const ExactDifference height(x_[m][a_], centre);
      for (int t = 0; t < part.count(); ++t) {
        sum.add_product(part.term(t), height.tail);
        sum.add_product(part.term(t), height.head);
      }
    }
    return sum.value();
  }

  /// The centre lies in the triangle's plane.  Displaced by -e it lies at -n.e along the normal n, and the hit above it
  /// when n.e and n_a have the same sign; the first component of n that is not zero decides.
  bool hit_is_above_touched_centre() const
  {
    for (int axis = 0; axis < a_; ++axis)
      if (const int normal = sign_of_normal(x_, axis); normal != 0)
        return normal == side_;
    return true;
  }

  /// The hit lies between centres `above` - 1 and `above`.
  void append(Index3 cell, int above, std::vector<Crossing>& found) const
  {
    const int last = grid_.cells()[a_];
    const bool outermost = above == 0 || above == last;
    if (outermost && !grid_.ranks().periodic(a_))
      return;
    constexpr double largest_below_one = 0x1.fffffffffffffp-1;
    const double theta = distance_to_hit(grid_.centre(a_, above - 1))[0] / grid_.distance(a_, above);
    Crossing crossing{a_, cell, std::clamp(theta, 0.0, largest_below_one), triangle_, weights_, side_};
    const auto append_at = [&](int face) {
      if (face < faces_.first || face >= faces_.last)
        return;
      crossing.cell[a_] = face;
      found.push_back(crossing);
    };
    append_at(outermost ? 0 : above);
    if (outermost)
      append_at(last);
  }

  const grid::Grid& grid_;
  int a_;
  int b_ = (a_ + 1) % 3;
  int c_ = (a_ + 2) % 3;
  const Corners& x_;
  int triangle_;
  Range links_;
  Range faces_;
  std::array<Point2, 3> shadow_{};
  Point2 line_{};
  std::array<double, 3> areas_{};
  std::array<double, 3> weights_{};
  int side_ = 0;
};

void cross_lines(const grid::Grid& grid, int axis, const Corners& x, int triangle, const std::array<Range, 3>& around,
                 std::vector<Crossing>& found)
{
  const IndexBox& owned = grid.owned();
  const int b = (axis + 1) % 3;
  const int c = (axis + 2) % 3;
  const Range lines_b = clipped(around[b], owned.lo[b], owned.hi[b]);
  const Range lines_c = clipped(around[c], owned.lo[c], owned.hi[c]);
  if (lines_b.first >= lines_b.last || lines_c.first >= lines_c.last)
    return;
  LineSearch search(grid, axis, x, triangle, around[axis], {owned.lo[axis], owned.hi[axis] + 1});
  Index3 cell{};
  for (cell[c] = lines_c.first; cell[c] < lines_c.last; ++cell[c])
    for (cell[b] = lines_b.first; cell[b] < lines_b.last; ++cell[b])
      search.hit(cell, found);
}

}  // namespace

void sort(std::vector<Crossing>& crossings, const Index3& cells)
{
  const auto place = [&](const Crossing& x) {
    const auto plane = static_cast<std::int64_t>(x.axis) * (cells[2] + 1) + x.cell[2];
    return (plane * (cells[1] + 1) + x.cell[1]) * (cells[0] + 1) + x.cell[0];
  };
  std::sort(crossings.begin(), crossings.end(), [&](const Crossing& p, const Crossing& q) {
    const std::int64_t at_p = place(p);
    const std::int64_t at_q = place(q);
    return at_p != at_q ? at_p < at_q : std::tie(p.theta, p.triangle) < std::tie(q.theta, q.triangle);
  });
}

std::vector<Crossing> find_crossings(const grid::Grid& grid, std::span<const Vec3> positions,
                                     std::span<const std::array<int, 3>> triangles)
{
  std::vector<Crossing> found;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const auto& corner = triangles[t];
    const Corners x{positions[corner[0]], positions[corner[1]], positions[corner[2]]};
    std::array<Range, 3> around;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({x[0][axis], x[1][axis], x[2][axis]});
      around[axis] = displaced_centres_within(grid, axis, low, high);
    }
    for (int axis = 0; axis < 3; ++axis)
      cross_lines(grid, axis, x, t, around, found);
  }
  sort(found, grid.cells());
  return found;
}

}  // namespace luff::immersed
