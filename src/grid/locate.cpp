// SPDX-License-Identifier: BSD-3-Clause
#include "grid/locate.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/error.hpp"

namespace luff::grid {

namespace {

/// Points on the faces of cells are found in either; on sides, in spite of rounding.
constexpr double tolerance = 1e-9;

using Corners = std::array<Vec3, 8>;

/// Weight of a corner, and its derivatives.
double weight_of(int corner, const Vec3& s)
{
  double w = 1.0;
  for (int a = 0; a < 3; ++a)
    w *= (corner >> a & 1) == 1 ? s[a] : 1.0 - s[a];
  return w;
}

Vec3 weight_slope(int corner, const Vec3& s)
{
  Vec3 slope = Vec3::Ones();
  for (int a = 0; a < 3; ++a)
    for (int d = 0; d < 3; ++d)
      slope[d] *= (corner >> a & 1) == 1 ? (a == d ? 1.0 : s[a]) : (a == d ? -1.0 : 1.0 - s[a]);
  return slope;
}

/// s with sum_c w_c(s) x_c = x, by Newton's method from the middle; none where it does not converge.
std::optional<Vec3> invert_trilinear(const Corners& corners, const Vec3& x)
{
  constexpr int most_steps = 30;
  Vec3 s = Vec3::Constant(0.5);
  for (int step = 0; step < most_steps; ++step) {
    Vec3 residual = x;
    Mat3 J = Mat3::Zero();
    for (int c = 0; c < 8; ++c) {
      residual -= weight_of(c, s) * corners[c];
      J += corners[c] * weight_slope(c, s).transpose();
    }
    const Vec3 change = J.inverse() * residual;
    if (!change.allFinite())
      return std::nullopt;
    s += change;
    if (change.cwiseAbs().maxCoeff() < 1e-13)
      return s;
  }
  return std::nullopt;
}

/// Corner c of a box of points that p gives.
template <class Point>
Corners corners_from(const Index3& low, Point p)
{
  Corners corners;
  for (int c = 0; c < 8; ++c)
    corners[c] = p(low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2));
  return corners;
}

/// Keeps the eight centres among the cells of the domain.
void clamp_base(const Grid& grid, Index3& base)
{
  for (int a = 0; a < 3; ++a)
    if (!grid.ranks().periodic(a))
      base[a] = std::clamp(base[a], 0, std::max(0, grid.cells()[a] - 2));
}

// ---- boxes ------------------------------------------------------------------------------------------------------

std::optional<Location> locate_in_box(const Grid& grid, const Vec3& x)
{
  Index3 cell{};
  Location location;
  for (int a = 0; a < 3; ++a) {
    const std::vector<double>& faces = grid.faces(a);
    const double rounding = tolerance * (faces.back() - faces.front());
    if (!(x[a] >= faces.front() - rounding && x[a] <= faces.back() + rounding))
      return std::nullopt;
    cell[a] = cell_at(grid, a, x[a]);
    location.base[a] = x[a] < grid.centre(a, cell[a]) ? cell[a] - 1 : cell[a];
  }
  clamp_base(grid, location.base);
  for (int a = 0; a < 3; ++a) {
    const double low = grid.centre(a, location.base[a]);
    location.weight[a] = (x[a] - low) / (grid.centre(a, location.base[a] + 1) - low);
  }
  location.mine = grid.owned().contains(cell);
  return location;
}

// ---- curvilinear grids ------------------------------------------------------------------------------------------

Corners nodes_of(const Curvilinear& m, const Index3& c)
{
  return corners_from(
      c, [&](int i, int j, int k) { return Vec3(m.node[0](i, j, k), m.node[1](i, j, k), m.node[2](i, j, k)); });
}

/// Whether a cell may hold the point: it lies in the box of the cell's nodes, which is a little too large for faces
/// that are curved.
bool is_near(const Corners& nodes, const Vec3& x)
{
  Vec3 low = nodes[0];
  Vec3 high = nodes[0];
  for (const Vec3& node : nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  const double rounding = tolerance * (high - low).norm();
  return ((x - low).array() >= -rounding).all() && ((high - x).array() >= -rounding).all();
}

struct Held {
  Index3 cell;
  Vec3 s;  ///< in the cell, 0 to 1
};

std::optional<Held> cell_that_holds(const Grid& grid, const Curvilinear& m, const Vec3& x)
{
  std::optional<Held> held;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const Corners nodes = nodes_of(m, {i, j, k});
    if (held || !is_near(nodes, x))
      return;
    const auto s = invert_trilinear(nodes, x);
    if (s && (s->array() >= -tolerance).all() && (s->array() <= 1.0 + tolerance).all())
      held = Held{{i, j, k}, *s};
  });
  return held;
}

/// The eight centres around the point; those first tried may be off by one where cells are skewed.
Location among_centres(const Grid& grid, const Held& held, const Vec3& x)
{
  Location location;
  for (int a = 0; a < 3; ++a)
    location.base[a] = held.s[a] < 0.5 ? held.cell[a] - 1 : held.cell[a];
  clamp_base(grid, location.base);
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Corners centres = corners_from(location.base, [&](int i, int j, int k) { return grid.centre(i, j, k); });
    const auto s = invert_trilinear(centres, x);
    if (!s)
      break;
    location.weight = *s;
    Index3 next = location.base;
    for (int a = 0; a < 3; ++a) {
      next[a] += static_cast<int>(std::floor(std::clamp((*s)[a], -0.5, 1.5)));
      next[a] = std::clamp(next[a], held.cell[a] - 1, held.cell[a]);
    }
    clamp_base(grid, next);
    if (next == location.base)
      break;
    location.base = next;
  }
  location.mine = true;
  return location;
}

std::optional<Location> locate_in_curvilinear(const Grid& grid, const Curvilinear& m, const Vec3& x)
{
  const auto held = cell_that_holds(grid, m, x);
  const int nobody = grid.ranks().size();
  int owner = held ? grid.ranks().rank() : nobody;
  MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MIN, grid.ranks().comm());
  if (owner == nobody)
    return std::nullopt;
  return owner == grid.ranks().rank() ? among_centres(grid, *held, x) : Location{};
}

// ---- many points ------------------------------------------------------------------------------------------------

/// Points sorted into equal boxes, a few in each.
class Bins {
 public:
  explicit Bins(std::span<const Vec3> points)
  {
    low_ = points.front();
    Vec3 high = points.front();
    for (const Vec3& x : points) {
      low_ = low_.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const double size = (high - low_).maxCoeff();
    n_ = std::max(1, static_cast<int>(std::cbrt(double(points.size()))));
    per_length_ = size > 0.0 ? n_ / size : 0.0;
    bins_.resize(static_cast<std::size_t>(n_) * n_ * n_);
    for (std::size_t p = 0; p < points.size(); ++p)
      bins_[number(place(points[p]))].push_back(static_cast<int>(p));
  }

  /// visit(point) of every point in the boxes that the box from low to high touches.
  template <class Visit>
  void for_each_near(const Vec3& low, const Vec3& high, Visit visit) const
  {
    const Index3 from = place(low);
    const Index3 to = place(high);
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i)
          for (const int point : bins_[number({i, j, k})])
            visit(point);
  }

 private:
  [[nodiscard]] Index3 place(const Vec3& x) const
  {
    Index3 box{};
    for (int a = 0; a < 3; ++a)
      box[a] = static_cast<int>(std::clamp((x[a] - low_[a]) * per_length_, 0.0, n_ - 1.0));
    return box;
  }
  [[nodiscard]] std::size_t number(const Index3& box) const
  {
    return box[0] + n_ * (box[1] + std::size_t(n_) * box[2]);
  }

  Vec3 low_;
  int n_ = 1;
  double per_length_ = 0.0;
  std::vector<std::vector<int>> bins_;
};

/// Bits of a standing: 0 inside, 1 + 2 axis + end on a side.
using Bits = unsigned;

Bits bits_in_cell(const Grid& grid, const Index3& cell, const Corners& nodes, const Vec3& x)
{
  if (!is_near(nodes, x))
    return 0;
  const auto s = invert_trilinear(nodes, x);
  if (!s || (s->array() < -tolerance).any() || (s->array() > 1.0 + tolerance).any())
    return 0;
  Bits bits = 1;
  for (int a = 0; a < 3; ++a) {
    if (cell[a] == 0 && (*s)[a] <= tolerance)
      bits |= 2U << 2 * a;
    if (cell[a] + 1 == grid.cells()[a] && (*s)[a] >= 1.0 - tolerance)
      bits |= 2U << (2 * a + 1);
  }
  return bits;
}

}  // namespace

int cell_at(const Grid& grid, int axis, double x)
{
  const std::vector<double>& faces = grid.faces(axis);
  const auto above = std::upper_bound(faces.begin(), faces.end(), x) - faces.begin();
  return std::clamp(static_cast<int>(above) - 1, 0, grid.cells()[axis] - 1);
}

Vec3 widths_at(const Grid& grid, const Vec3& x)
{
  Vec3 widths;
  for (int a = 0; a < 3; ++a)
    widths[a] = grid.width(a, cell_at(grid, a, x[a]));
  return widths;
}

std::optional<Location> locate(const Grid& grid, const Vec3& x)
{
  return grid.visit([&]<class Metric>(const Metric& m) -> std::optional<Location> {
    if constexpr (is_curvilinear<Metric>)
      return locate_in_curvilinear(grid, m, x);
    else
      return locate_in_box(grid, x);
  });
}

std::vector<Standing> standings(const Grid& grid, std::span<const Vec3> points)
{
  std::vector<Bits> bits(points.size(), 0);
  if (points.empty())
    return {};
  const Bins bins(points);
  grid.visit([&]<class Metric>(const Metric& m) {
    if constexpr (is_curvilinear<Metric>)
      for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
        const Corners nodes = nodes_of(m, {i, j, k});
        Vec3 low = nodes[0];
        Vec3 high = nodes[0];
        for (const Vec3& node : nodes) {
          low = low.cwiseMin(node);
          high = high.cwiseMax(node);
        }
        const Vec3 rounding = Vec3::Constant(tolerance * (high - low).norm());
        bins.for_each_near(low - rounding, high + rounding, [&](int p) {
          bits[p] |= bits_in_cell(grid, {i, j, k}, nodes, points[p]);
        });
      });
    else
      ensure(false, "boxes tell by their coordinates where a point stands");
  });
  MPI_Allreduce(MPI_IN_PLACE, bits.data(), static_cast<int>(bits.size()), MPI_UNSIGNED, MPI_BOR, grid.ranks().comm());
  std::vector<Standing> result(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    result[p].inside = (bits[p] & 1U) != 0;
    for (int a = 0; a < 3; ++a)
      for (int end = 0; end < 2; ++end)
        result[p].on_side[a][end] = !grid.ranks().periodic(a) && (bits[p] >> (1 + 2 * a + end) & 1U) != 0;
  }
  return result;
}

}  // namespace luff::grid
