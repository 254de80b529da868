// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/edge_cover.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "surface/mesh.hpp"

namespace luff::immersed {

namespace {

constexpr double whole_above = 0.95;
constexpr double none_below = 0.001;
/// Distance from a side of the domain, in parts of the cell's width there, up to which an edge lies in it.
constexpr double in_side = 1e-6;

/// A plane by one of its points and its normal.
struct Plane {
  Vec3 point;
  Vec3 normal;

  /// Its coordinate along an axis, over another point's place across.
  [[nodiscard]] double height(int axis, const Vec3& x) const
  {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    return point[axis] - (normal[b] * (x[b] - point[b]) + normal[c] * (x[c] - point[c])) / normal[axis];
  }
};

/// A convex polygon: a triangle cut to a column.
class Polygon {
 public:
  explicit Polygon(const std::array<Vec3, 3>& x) : corners_(x.begin(), x.end()) {}

  /// Keeps what lies where sign (x_axis - bound) >= 0.
  void keep(int axis, double sign, double bound)
  {
    const std::vector<Vec3> old = std::move(corners_);
    corners_.clear();
    for (std::size_t m = 0; m < old.size(); ++m) {
      const Vec3& from = old[m];
      const Vec3& to = old[(m + 1) % old.size()];
      const double at_from = sign * (from[axis] - bound);
      const double at_to = sign * (to[axis] - bound);
      if (at_from >= 0.0)
        corners_.push_back(from);
      if ((at_from >= 0.0) != (at_to >= 0.0))
        corners_.push_back(from + at_from / (at_from - at_to) * (to - from));
    }
  }

  /// Area projected along an axis, with the sign of the normal there, and its centroid.
  [[nodiscard]] std::pair<double, Vec3> area_and_centroid(int axis) const
  {
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
    for (std::size_t m = 1; m + 1 < corners_.size(); ++m) {
      const double part = surface::area_vector(corners_[0], corners_[m], corners_[m + 1])[axis];
      area += part;
      moment += part / 3.0 * (corners_[0] + corners_[m] + corners_[m + 1]);
    }
    return {area, area != 0.0 ? Vec3(moment / area) : moment};
  }

 private:
  std::vector<Vec3> corners_;
};

/// What lies of a triangle in a column.
struct Piece {
  int triangle = 0;
  double area = 0.0;  ///< projected, signed
  Vec3 centroid = Vec3::Zero();
  bool taken = false;
};

/// What lies of a free edge in a column.
struct EdgePiece {
  int triangle = 0;
  Vec3 middle = Vec3::Zero();
};

/// The cells of one row across the link axis that an edge runs through, and what lies in them of the sheets.
struct Column {
  std::array<int, 2> place{};  ///< across: indices along b and c
  std::vector<EdgePiece> edges;
  std::vector<Piece> pieces;
};

/// Barycentric coordinates of a point of a triangle, within it to round-off.
std::array<double, 3> barycentric(const std::array<Vec3, 3>& x, const Vec3& point)
{
  const Vec3 normal = surface::area_vector(x[0], x[1], x[2]);
  std::array<double, 3> weights{};
  for (int m = 0; m < 3; ++m)
    weights[m] = std::max(0.0, surface::area_vector(point, x[(m + 1) % 3], x[(m + 2) % 3]).dot(normal));
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& w : weights)
    w /= sum;
  return weights;
}

/// The covers of the faces normal to one axis.
class AxisCovers {
 public:
  AxisCovers(const grid::Grid& grid, int axis, std::span<const Vec3> positions,
             std::span<const std::array<int, 3>> triangles)
      : grid_(grid), a_(axis), positions_(positions), triangles_(triangles)
  {
    for (int s = 0; s < 2; ++s) {
      const int across = s == 0 ? b_ : c_;
      low_[s] = grid.owned().lo[across];
      count_[s] = grid.owned().extent(across);
    }
    column_at_.assign(static_cast<std::size_t>(count_[0]) * count_[1], -1);
  }

  void find(std::span<const FreeEdge> edges, std::vector<EdgeCover>& covers)
  {
    for (const FreeEdge& edge : edges)
      add_edge(edge);
    if (columns_.empty())
      return;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
      add_triangle(t);
    for (Column& column : columns_)
      cover(column, covers);
  }

 private:
  [[nodiscard]] std::array<Vec3, 3> corners(int triangle) const
  {
    const auto& [a, b, c] = triangles_[triangle];
    return {positions_[a], positions_[b], positions_[c]};
  }
  [[nodiscard]] int across(int s) const { return s == 0 ? b_ : c_; }

  /// visit(column number, place) of the columns of this rank that [low, high] overlaps across the axis.
  template <class Visit>
  void for_columns(const Vec3& low, const Vec3& high, Visit visit)
  {
    std::array<std::array<int, 2>, 2> range{};
    for (int s = 0; s < 2; ++s) {
      const std::vector<double>& faces = grid_.faces(across(s));
      const auto first = std::upper_bound(faces.begin(), faces.end(), low[across(s)]) - faces.begin() - 1;
      const auto last = std::lower_bound(faces.begin(), faces.end(), high[across(s)]) - faces.begin();
      range[s] = {std::max(static_cast<int>(first), low_[s]), std::min(static_cast<int>(last), low_[s] + count_[s])};
    }
    for (int c = range[1][0]; c < range[1][1]; ++c)
      for (int b = range[0][0]; b < range[0][1]; ++b)
        visit(column_at_[(b - low_[0]) + static_cast<std::size_t>(count_[0]) * (c - low_[1])], std::array{b, c});
  }

  void add_edge(const FreeEdge& edge)
  {
    const Vec3& from = positions_[edge.from];
    const Vec3& to = positions_[edge.to];
    if (lies_in_side(from, to))
      return;
    for_columns(from.cwiseMin(to), from.cwiseMax(to), [&](int& number, const std::array<int, 2>& place) {
      const std::optional<Vec3> middle = middle_in_column(from, to, place);
      if (!middle)
        return;
      if (number < 0) {
        number = static_cast<int>(columns_.size());
        columns_.push_back({place, {}, {}});
      }
      columns_[number].edges.push_back({edge.triangle, *middle});
    });
  }

  [[nodiscard]] bool lies_in_side(const Vec3& from, const Vec3& to) const
  {
    for (int d = 0; d < 3; ++d)
      for (const int end : {0, grid_.cells()[d]}) {
        const double near = in_side * grid_.width(d, end == 0 ? 0 : end - 1);
        const double side = grid_.face(d, end);
        if (std::abs(from[d] - side) <= near && std::abs(to[d] - side) <= near)
          return true;
      }
    return false;
  }

  /// The middle of what lies of an edge in a column (Liang and Barsky's clipping).
  [[nodiscard]] std::optional<Vec3> middle_in_column(const Vec3& from, const Vec3& to,
                                                     const std::array<int, 2>& place) const
  {
    double begin = 0.0;
    double end = 1.0;
    for (int s = 0; s < 2; ++s) {
      const int d = across(s);
      const double step = to[d] - from[d];
      const double to_low = grid_.face(d, place[s]) - from[d];
      const double to_high = grid_.face(d, place[s] + 1) - from[d];
      if (step == 0.0) {
        if (to_low > 0.0 || to_high <= 0.0)
          return std::nullopt;
        continue;
      }
      begin = std::max(begin, std::min(to_low / step, to_high / step));
      end = std::min(end, std::max(to_low / step, to_high / step));
    }
    if (begin > end)
      return std::nullopt;
    return Vec3(from + 0.5 * (begin + end) * (to - from));
  }

  void add_triangle(int triangle)
  {
    const std::array<Vec3, 3> x = corners(triangle);
    for_columns(x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2]),
                [&](int number, const std::array<int, 2>& place) {
                  if (number < 0)
                    return;
                  Polygon polygon(x);
                  for (int s = 0; s < 2; ++s) {
                    polygon.keep(across(s), 1.0, grid_.face(across(s), place[s]));
                    polygon.keep(across(s), -1.0, grid_.face(across(s), place[s] + 1));
                  }
                  if (const auto [area, centroid] = polygon.area_and_centroid(a_); area != 0.0)
                    columns_[number].pieces.push_back({triangle, area, centroid});
                });
  }

  [[nodiscard]] Plane plane_of(int triangle) const
  {
    const std::array<Vec3, 3> x = corners(triangle);
    return {x[0], surface::area_vector(x[0], x[1], x[2])};
  }

  /// Whether a place of a column belongs to the sheet that passes through it along a plane: it lies within one link and
  /// half of what the plane rises by in the column.
  [[nodiscard]] bool is_near(const Column& column, const Plane& plane, double link, const Vec3& x) const
  {
    double rise = 0.0;
    for (int s = 0; s < 2; ++s)
      rise += std::abs(plane.normal[across(s)]) * grid_.width(across(s), column.place[s]);
    const double reach = link + 0.5 * rise / std::abs(plane.normal[a_]);
    return std::abs(x[a_] - plane.height(a_, x)) <= reach;
  }

  /// Net projected area around a plane over that of the face; takes the pieces.
  double take_covered_part(Column& column, const Plane& plane, double link) const
  {
    double net = 0.0;
    for (Piece& piece : column.pieces)
      if (!piece.taken && is_near(column, plane, link, piece.centroid)) {
        net += piece.area;
        piece.taken = true;
      }
    const double area = grid_.width(b_, column.place[0]) * grid_.width(c_, column.place[1]);
    const double part = std::copysign(net, net * plane.normal[a_]) / area;
    return part > whole_above ? 1.0 : part < none_below ? 0.0 : part;
  }

  void cover(Column& column, std::vector<EdgeCover>& covers) const
  {
    for (const Crossing& hit : crossings_of(column)) {
      const Plane plane = plane_of(hit.triangle);
      const double link = grid_.distance(a_, hit.cell[a_]);
      const bool at_edge = std::any_of(column.edges.begin(), column.edges.end(), [&](const EdgePiece& edge) {
        return is_near(column, plane, link, edge.middle);
      });
      const double part = take_covered_part(column, plane, link);
      if (at_edge && part > 0.0 && part < 1.0)
        add({hit, true, part}, covers);
    }
    for (const EdgePiece& edge : column.edges)
      cover_beside_line(column, edge, covers);
  }

  [[nodiscard]] std::vector<Crossing> crossings_of(const Column& column) const
  {
    std::vector<int> triangles;
    for (const Piece& piece : column.pieces)
      triangles.push_back(piece.triangle);
    return crossings_of_line(grid_, a_, cell_of(column, 0), positions_, triangles_, triangles);
  }

  [[nodiscard]] Index3 cell_of(const Column& column, int along) const
  {
    Index3 cell{};
    cell[a_] = along;
    cell[b_] = column.place[0];
    cell[c_] = column.place[1];
    return cell;
  }

  /// Of an edge whose sheet does not reach the line of centres.
  void cover_beside_line(Column& column, const EdgePiece& edge, std::vector<EdgeCover>& covers) const
  {
    const auto own = std::find_if(column.pieces.begin(), column.pieces.end(),
                                  [&](const Piece& piece) { return piece.triangle == edge.triangle && !piece.taken; });
    if (own == column.pieces.end())
      return;
    const Piece end = *own;
    const int face = first_centre_above(grid_, a_, end.centroid[a_]);
    const bool between_centres = face > 0 && face < grid_.cells()[a_];
    const double link = grid_.distance(a_, std::clamp(face, 1, grid_.cells()[a_] - 1));
    const double part = take_covered_part(column, plane_of(edge.triangle), link);
    if (!between_centres || part == 0.0)
      return;
    add({{.axis = a_,
          .cell = cell_of(column, face),
          .theta = (end.centroid[a_] - grid_.centre(a_, face - 1)) / link,
          .triangle = end.triangle,
          .weights = barycentric(corners(end.triangle), end.centroid),
          .side = end.area > 0.0 ? 1 : -1},
         false,
         part},
        covers);
  }

  /// If it is one of this rank's; the link that wraps around is that of two faces.
  void add(const EdgeCover& cover, std::vector<EdgeCover>& covers) const
  {
    for (const int face : {cover.hit.cell[a_], grid_.cells()[a_]}) {
      EdgeCover copy = cover;
      copy.hit.cell[a_] = face;
      if (face >= grid_.owned().lo[a_] && face <= grid_.owned().hi[a_])
        covers.push_back(copy);
      if (cover.hit.cell[a_] != 0)
        return;
    }
  }

  const grid::Grid& grid_;
  int a_;
  int b_ = (a_ + 1) % 3;
  int c_ = (a_ + 2) % 3;
  std::span<const Vec3> positions_;
  std::span<const std::array<int, 3>> triangles_;
  std::array<int, 2> low_{};
  std::array<int, 2> count_{};
  std::vector<int> column_at_;
  std::vector<Column> columns_;
};

}  // namespace

std::vector<FreeEdge> free_edges(std::span<const std::array<int, 3>> triangles)
{
  std::vector<FreeEdge> edges;  // all of them, the smaller vertex first
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int m = 0; m < 3; ++m) {
      const int v = triangles[t][m];
      const int w = triangles[t][(m + 1) % 3];
      edges.push_back({std::min(v, w), std::max(v, w), t});
    }
  std::sort(edges.begin(), edges.end());
  const auto same = [](const FreeEdge& a, const FreeEdge& b) { return a.from == b.from && a.to == b.to; };
  std::vector<FreeEdge> free;
  for (std::size_t n = 0; n < edges.size(); ++n)
    if ((n == 0 || !same(edges[n - 1], edges[n])) && (n + 1 == edges.size() || !same(edges[n], edges[n + 1])))
      free.push_back(edges[n]);
  return free;
}

namespace {

/// Covers of the same face become one, of the crossing if there is one.
std::vector<EdgeCover> add_up(std::vector<EdgeCover> covers)
{
  const auto face = [](const EdgeCover& cover) {
    const Crossing& hit = cover.hit;
    return std::tuple(hit.axis, hit.cell[2], hit.cell[1], hit.cell[0]);
  };
  std::stable_sort(covers.begin(), covers.end(),
                   [&](const EdgeCover& p, const EdgeCover& q) { return face(p) < face(q); });
  std::vector<EdgeCover> sums;
  for (const EdgeCover& cover : covers) {
    if (sums.empty() || face(sums.back()) != face(cover)) {
      sums.push_back(cover);
      continue;
    }
    const double part = sums.back().part + cover.part;
    if (cover.on_line && !sums.back().on_line)
      sums.back() = cover;
    sums.back().part = part > whole_above ? 1.0 : part;
  }
  return sums;
}

}  // namespace

std::vector<EdgeCover> edge_covers(const grid::Grid& grid, std::span<const Vec3> positions,
                                   std::span<const std::array<int, 3>> triangles, std::span<const FreeEdge> edges)
{
  std::vector<EdgeCover> covers;
  for (int axis = 0; axis < 3; ++axis)
    if (grid.cells()[axis] > 1)
      AxisCovers(grid, axis, positions, triangles).find(edges, covers);
  return add_up(covers);
}

}  // namespace luff::immersed
