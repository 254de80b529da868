// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/free_edges.hpp"

#include <algorithm>
#include <cmath>

#include "surface/topology.hpp"

namespace luff::immersed {

namespace {

/// Width of the strips in cells: more than covers faces, for the widths of cells change.
constexpr double strip_width = 1.25;
constexpr double whole_above = 0.95;
constexpr double none_below = 0.001;
/// Sharpest corner of an outline whose strips keep their width: cosine of half the angle that it turns by.
constexpr double sharpest_corner = 0.5;

/// Whether both ends of an edge stand on the same side of the domain.
bool lies_in_side(const grid::Standing& from, const grid::Standing& to)
{
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end)
      if (from.on_side[a][end] && to.on_side[a][end])
        return true;
  return false;
}

/// Place on the segment from a to b nearest to x, as a part of it.
double nearest_on_segment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  return std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
}

}  // namespace

std::vector<FreeEdge> free_edges(std::span<const std::array<int, 3>> triangles)
{
  std::vector<FreeEdge> edges;
  for (const auto& [key, sides] :
       surface::edge_map({.vertices = {}, .triangles = {triangles.begin(), triangles.end()}}))
    if (sides.size() == 1) {
      const auto [from, to] = surface::edge_vertices(triangles[sides[0].triangle], sides[0].edge);
      edges.push_back({from, to, sides[0].triangle});
    }
  std::ranges::sort(edges, {}, &FreeEdge::triangle);
  return edges;
}

double cover_beyond_edge(double t)
{
  const double cover = 1.0 - t;
  return cover > whole_above ? 1.0 : cover < none_below ? 0.0 : cover;
}

FadingSheets::FadingSheets(const grid::Grid& grid, std::span<const Vec3> positions,
                           std::span<const std::array<int, 3>> triangles, std::span<const FreeEdge> edges)
    : grid_(grid),
      sheet_triangles_(static_cast<int>(triangles.size())),
      positions_(positions.begin(), positions.end()),
      triangles_(triangles.begin(), triangles.end())
{
  keep_free(edges);
  add_strips();
}

void FadingSheets::keep_free(std::span<const FreeEdge> edges)
{
  std::map<int, grid::Standing> standing_of;
  for (const FreeEdge& edge : edges)
    for (const int v : {edge.from, edge.to})
      standing_of[v] = {};
  std::vector<Vec3> points;
  for (const auto& [v, unknown] : standing_of)
    points.push_back(positions_[v]);
  const std::vector<grid::Standing> standings = grid::standings(grid_, points);
  for (auto next = standings.begin(); auto& [v, standing] : standing_of)
    standing = *next++;
  for (const FreeEdge& edge : edges) {
    const grid::Standing& from = standing_of[edge.from];
    const grid::Standing& to = standing_of[edge.to];
    if (lies_in_side(from, to))
      continue;
    edges_.push_back(edge);
    cell_at_[edge.from] = from.cell;
    cell_at_[edge.to] = to.cell;
  }
}

/// Unit vector in the plane of the edge's triangle, normal to the edge, away from the sheet.
Vec3 FadingSheets::outwards(const FreeEdge& edge) const
{
  const auto& [a, b, c] = triangles_[edge.triangle];
  const Vec3 normal = surface::area_vector(positions_[a], positions_[b], positions_[c]);
  return (positions_[edge.to] - positions_[edge.from]).cross(normal).normalized();
}

/// Vertices of free edges get another one, strip_width cells beyond them.
void FadingSheets::add_strips()
{
  std::map<int, std::vector<Vec3>> directions;  // of the edges that meet in a vertex
  for (const FreeEdge& edge : edges_)
    for (const int v : {edge.from, edge.to})
      directions[v].push_back(outwards(edge));
  std::map<int, int> beyond;
  for (const auto& [v, all] : directions) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& d : all)
      mean += d;
    mean.normalize();
    const double cells_per_length = cell_at_.at(v).in_cells(mean).norm();
    const double corner = std::max(mean.dot(all.front()), sharpest_corner);
    const double width = cells_per_length > 0.0 ? strip_width / (cells_per_length * corner) : 0.0;
    beyond[v] = static_cast<int>(positions_.size());
    positions_.push_back(positions_[v] + width * mean);
  }
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    const FreeEdge& edge = edges_[e];
    triangles_.push_back({edge.to, edge.from, beyond[edge.from]});
    triangles_.push_back({edge.to, beyond[edge.from], beyond[edge.to]});
    edge_of_strip_.insert(edge_of_strip_.end(), {e, e});
  }
}

/// Distance in cells of x from a place on an edge: in those around x; on curvilinear grids, where no rank knows all
/// cells, in those around the edge.
double FadingSheets::cells_beyond(const FreeEdge& edge, double part, const Vec3& x) const
{
  const Vec3& from = positions_[edge.from];
  const Vec3 beyond = x - from - part * (positions_[edge.to] - from);
  if (grid_.kind() != grid::Kind::Curvilinear)
    return beyond.cwiseQuotient(grid::widths_at(grid_, x)).norm();
  const Vec3 at_from = cell_at_.at(edge.from).in_cells(beyond);
  const Vec3 at_to = cell_at_.at(edge.to).in_cells(beyond);
  return ((1.0 - part) * at_from + part * at_to).norm();
}

/// Moves a hit of a strip to the point of its edge nearest to it, and returns what it covers of its face.
double FadingSheets::fade_out(Crossing& hit) const
{
  const auto& [a, b, c] = triangles_[hit.triangle];
  const Vec3 x = hit.weights[0] * positions_[a] + hit.weights[1] * positions_[b] + hit.weights[2] * positions_[c];
  const FreeEdge& edge = edges_[edge_of_strip_[hit.triangle - sheet_triangles_]];
  const double part = nearest_on_segment(x, positions_[edge.from], positions_[edge.to]);
  hit.triangle = edge.triangle;
  for (int m = 0; m < 3; ++m) {
    const int v = triangles_[edge.triangle][m];
    hit.weights[m] = v == edge.from ? 1.0 - part : v == edge.to ? part : 0.0;
  }
  return cover_beyond_edge(cells_beyond(edge, part, x));
}

std::vector<double> FadingSheets::settle(std::vector<Crossing>& hits) const
{
  const std::vector<Crossing> all = std::move(hits);
  const auto same_link = [&](std::size_t p, std::size_t q) {
    return all[p].axis == all[q].axis && all[p].cell == all[q].cell;
  };
  hits.clear();
  std::vector<double> covers;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const bool alone = (q == 0 || !same_link(q - 1, q)) && (q + 1 == all.size() || !same_link(q, q + 1));
    Crossing hit = all[q];
    const double cover = !is_of_strip(hit) ? 1.0 : alone ? fade_out(hit) : 0.0;
    if (cover == 0.0)
      continue;
    hits.push_back(hit);
    covers.push_back(cover);
  }
  return covers;
}

}  // namespace luff::immersed
