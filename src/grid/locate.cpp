// SPDX-License-Identifier: BSD-3-Clause
#include "grid/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/bounding_box.hpp"

namespace luff::grid {

namespace {

/// Points on the faces of cells are found in either; on sides, in spite of rounding.
constexpr double tolerance = 1e-9;
/// Distance from a side, in cells, up to which points stand on it.
constexpr double on_side_below = 1e-6;

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

/// dx/ds
Mat3 trilinear_slope(const Corners& corners, const Vec3& s)
{
  Mat3 J = Mat3::Zero();
  for (int c = 0; c < 8; ++c)
    J += corners[c] * weight_slope(c, s).transpose();
  return J;
}

/// s with sum_c w_c(s) x_c = x, by Newton's method from the middle; none where it does not converge.
std::optional<Vec3> invert_trilinear(const Corners& corners, const Vec3& x)
{
  constexpr int most_steps = 30;
  Vec3 s = Vec3::Constant(0.5);
  for (int step = 0; step < most_steps; ++step) {
    Vec3 residual = x;
    for (int c = 0; c < 8; ++c)
      residual -= weight_of(c, s) * corners[c];
    const Vec3 change = trilinear_slope(corners, s).inverse() * residual;
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

/// Larger by rounding.
BoundingBox widened(const BoundingBox& box)
{
  const Vec3 rounding = Vec3::Constant(tolerance * box.size());
  return {box.low - rounding, box.high + rounding};
}

/// Around a cell, a little too large for faces that are curved.
BoundingBox box_of_cell(const Corners& nodes)
{
  return widened(bounding_box(nodes));
}

/// The same around the cells from `begin` to before `end` of a row.
BoundingBox box_of_cells(const Curvilinear& m, int begin, int end, int j, int k)
{
  BoundingBox box;
  for (int a = 0; a < 3; ++a) {
    double low = m.node[a](begin, j, k);
    double high = low;
    for (const double* row :
         {m.node[a].row(j, k), m.node[a].row(j + 1, k), m.node[a].row(j, k + 1), m.node[a].row(j + 1, k + 1)})
      for (int i = begin; i <= end; ++i) {
        low = std::min(low, row[i]);
        high = std::max(high, row[i]);
      }
    box.low[a] = low;
    box.high[a] = high;
  }
  return widened(box);
}

/// Where a point lies in a cell, 0 to 1 along each direction, if it does.
std::optional<Vec3> place_in_cell(const Corners& nodes, const Vec3& x)
{
  const auto s = invert_trilinear(nodes, x);
  const bool in_cell = s && (s->array() >= -tolerance).all() && (s->array() <= 1.0 + tolerance).all();
  return in_cell ? s : std::nullopt;
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
    if (held || !box_of_cell(nodes).holds(x))
      return;
    if (const auto s = place_in_cell(nodes, x))
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
    around_ = bounding_box(points);
    const double size = around_.extent().maxCoeff();
    n_ = std::max(1, static_cast<int>(std::cbrt(double(points.size()))));
    per_length_ = size > 0.0 ? n_ / size : 0.0;
    bins_.resize(static_cast<std::size_t>(n_) * n_ * n_);
    for (std::size_t p = 0; p < points.size(); ++p)
      bins_[number(place(points[p]))].push_back(static_cast<int>(p));
  }

  /// visit(point) of every point in the boxes that `region` touches.
  template <class Visit>
  void for_each_near(const BoundingBox& region, Visit visit) const
  {
    if (!around_.touches(region))
      return;
    const Index3 from = place(region.low);
    const Index3 to = place(region.high);
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i)
          for (const int point : bins_[number({i, j, k})])
            visit(point);
  }

  [[nodiscard]] bool any_near(const BoundingBox& region) const
  {
    bool any = false;
    for_each_near(region, [&](int) { any = true; });
    return any;
  }

 private:
  [[nodiscard]] Index3 place(const Vec3& x) const
  {
    Index3 box{};
    for (int a = 0; a < 3; ++a)
      box[a] = static_cast<int>(std::clamp((x[a] - around_.low[a]) * per_length_, 0.0, n_ - 1.0));
    return box;
  }
  [[nodiscard]] std::size_t number(const Index3& box) const
  {
    return box[0] + n_ * (box[1] + std::size_t(n_) * box[2]);
  }

  BoundingBox around_;
  int n_ = 1;
  double per_length_ = 0.0;
  std::vector<std::vector<int>> bins_;
};

/// visit(i, j, k) in order for the cells of a box, but for pieces of rows without any point near them.
template <class Visit>
void for_each_cell_near(const IndexBox& box, const Curvilinear& m, const Bins& bins, Visit visit)
{
  constexpr int piece = 8;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int begin = box.lo[0]; begin < box.hi[0]; begin += piece) {
        const int end = std::min(begin + piece, box.hi[0]);
        if (!bins.any_near(box_of_cells(m, begin, end, j, k)))
          continue;
        for (int i = begin; i < end; ++i)
          visit(i, j, k);
      }
}

/// Bits of a standing: 0 inside, 1 + 2 axis + end on a side.
using Bits = unsigned;

Bits side_bit(int axis, int end)
{
  return 2U << (2 * axis + end);
}

Bits bits_at(const Grid& grid, const Index3& cell, const Vec3& s)
{
  Bits bits = 1;
  for (int a = 0; a < 3; ++a) {
    if (cell[a] == 0 && s[a] <= on_side_below)
      bits |= side_bit(a, 0);
    if (cell[a] + 1 == grid.cells()[a] && s[a] >= 1.0 - on_side_below)
      bits |= side_bit(a, 1);
  }
  return bits;
}

/// What is known of points in a curvilinear grid: bits, and the sums of ds/dx over the cells that hold a point, several
/// on faces, with their number after the nine.
struct Search {
  static constexpr int stride = 10;
  std::vector<Bits> bits;
  std::vector<double> slopes;

  explicit Search(std::size_t points) : bits(points, 0), slopes(stride * points, 0.0) {}
  void add(int point, const Mat3& slope)
  {
    double* const sums = &slopes[stride * static_cast<std::size_t>(point)];
    Eigen::Map<Mat3>(sums, 3, 3) += slope;
    sums[stride - 1] += 1.0;
  }
  [[nodiscard]] Mat3 mean_slope(std::size_t point) const
  {
    const double* const sums = &slopes[stride * point];
    return Eigen::Map<const Mat3>(sums, 3, 3) / sums[stride - 1];
  }
  /// Collects what all ranks found, the same bits on each.
  void collect(MPI_Comm comm)
  {
    MPI_Allreduce(MPI_IN_PLACE, bits.data(), static_cast<int>(bits.size()), MPI_UNSIGNED, MPI_BOR, comm);
    std::vector<double> of_all(slopes.size());
    MPI_Reduce(slopes.data(), of_all.data(), static_cast<int>(slopes.size()), MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(of_all.data(), static_cast<int>(of_all.size()), MPI_DOUBLE, 0, comm);
    slopes = std::move(of_all);
  }
};

bool is_at_side(const Grid& grid, const Index3& cell)
{
  for (int a = 0; a < 3; ++a)
    if (cell[a] == 0 || cell[a] + 1 == grid.cells()[a])
      return true;
  return false;
}

/// The cells at sides whose centres are nearest to points, each on the one rank that has the nearest of all.
/// Collective.
std::vector<std::optional<Index3>> nearest_side_cells(const Grid& grid, std::span<const Vec3> points)
{
  struct Nearest {
    double distance = std::numeric_limits<double>::max();
    int rank = 0;
  };
  const int rank = grid.ranks().rank();
  std::vector<Nearest> nearest(points.size(), {.rank = rank});
  std::vector<std::optional<Index3>> cells(points.size());
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    if (!is_at_side(grid, {i, j, k}))
      return;
    const Vec3 centre = grid.centre(i, j, k);
    for (std::size_t p = 0; p < points.size(); ++p)
      if (const double distance = (centre - points[p]).norm(); distance < nearest[p].distance) {
        nearest[p].distance = distance;
        cells[p] = {i, j, k};
      }
  });
  MPI_Allreduce(MPI_IN_PLACE, nearest.data(), static_cast<int>(nearest.size()), MPI_DOUBLE_INT, MPI_MINLOC,
                grid.ranks().comm());
  for (std::size_t p = 0; p < points.size(); ++p)
    if (nearest[p].rank != rank)
      cells[p].reset();
  return cells;
}

/// Points outside the grid take the slope in the middle of the nearest cell.  Collective.
void search_beside_grid(const Grid& grid, const Curvilinear& m, std::span<const Vec3> points, Search& search)
{
  std::vector<int> lost;
  std::vector<Vec3> places;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (search.bits[p] == 0) {
      lost.push_back(static_cast<int>(p));
      places.push_back(points[p]);
    }
  if (lost.empty())
    return;
  const auto cells = nearest_side_cells(grid, places);
  Search beside(lost.size());
  for (std::size_t n = 0; n < lost.size(); ++n)
    if (cells[n])
      beside.add(static_cast<int>(n), trilinear_slope(nodes_of(m, *cells[n]), Vec3::Constant(0.5)).inverse());
  beside.collect(grid.ranks().comm());
  for (std::size_t n = 0; n < lost.size(); ++n)
    search.add(lost[n], beside.mean_slope(n));
}

CellShape shape_of(const Mat3& slope)
{
  const Vec3 widths = slope.rowwise().norm().cwiseInverse();
  return {.normals = widths.asDiagonal() * slope, .widths = widths};
}

std::vector<Standing> standings_in_curvilinear(const Grid& grid, const Curvilinear& m, std::span<const Vec3> points)
{
  Search search(points.size());
  const Bins bins(points);
  for_each_cell_near(grid.owned(), m, bins, [&](int i, int j, int k) {
    const Corners nodes = nodes_of(m, {i, j, k});
    const BoundingBox box = box_of_cell(nodes);
    bins.for_each_near(box, [&](int p) {
      if (!box.holds(points[p]))
        return;
      if (const auto s = place_in_cell(nodes, points[p])) {
        search.bits[p] |= bits_at(grid, {i, j, k}, *s);
        search.add(p, trilinear_slope(nodes, *s).inverse());
      }
    });
  });
  search.collect(grid.ranks().comm());
  search_beside_grid(grid, m, points, search);
  std::vector<Standing> result(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    result[p].inside = (search.bits[p] & 1U) != 0;
    result[p].cell = shape_of(search.mean_slope(p));
    for (int a = 0; a < 3; ++a)
      for (int end = 0; end < 2; ++end) {
        const bool on_seam = grid.ranks().periodic(a) && (search.bits[p] & side_bit(a, 1 - end)) != 0;
        result[p].on_side[a][end] = (search.bits[p] & side_bit(a, end)) != 0 && !on_seam;
      }
  }
  return result;
}

Standing standing_in_box(const Grid& grid, const Vec3& x)
{
  Standing result{.inside = true, .on_side = {}, .cell = {.normals = Mat3::Identity(), .widths = widths_at(grid, x)}};
  for (int a = 0; a < 3; ++a)
    for (const int end : {0, 1}) {
      const double width = grid.width(a, end == 0 ? 0 : grid.cells()[a] - 1);
      const double inwards = end == 0 ? x[a] - grid.faces(a).front() : grid.faces(a).back() - x[a];
      result.inside = result.inside && inwards >= -tolerance * width;
      result.on_side[a][end] = std::abs(inwards) <= on_side_below * width;
    }
  return result;
}

std::vector<Standing> standings_in_box(const Grid& grid, std::span<const Vec3> points)
{
  std::vector<Standing> result;
  for (const Vec3& x : points)
    result.push_back(standing_in_box(grid, x));
  return result;
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
  if (points.empty())
    return {};
  return grid.visit([&]<class Metric>(const Metric& m) -> std::vector<Standing> {
    if constexpr (is_curvilinear<Metric>)
      return standings_in_curvilinear(grid, m, points);
    else
      return standings_in_box(grid, points);
  });
}

}  // namespace luff::grid
