// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/free_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "grid/locate.hpp"
#include "surface/topology.hpp"

namespace luff::immersed {

namespace {

/// Width of the strips in cells: more than covers faces, for the widths of cells change.
constexpr double strip_width = 1.25;
constexpr double whole_above = 0.95;
constexpr double none_below = 0.001;
/// Distance from a side of the domain, in parts of the cell's width there, up to which an edge lies in it.
constexpr double in_side = 1e-6;
/// Sharpest corner of an outline whose strips keep their width: cosine of half the angle that it turns by.
constexpr double sharpest_corner = 0.5;

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
  for (const FreeEdge& edge : edges)
    if (!lies_in_side(edge))
      edges_.push_back(edge);
  add_strips();
}

Vec3 FadingSheets::cell_widths(const Vec3& x) const
{
  return grid::widths_at(grid_, x);
}

bool FadingSheets::lies_in_side(const FreeEdge& edge) const
{
  for (int d = 0; d < 3; ++d)
    for (const int end : {0, grid_.cells()[d]}) {
      const double near = in_side * grid_.width(d, end == 0 ? 0 : end - 1);
      const double side = grid_.face(d, end);
      if (std::abs(positions_[edge.from][d] - side) <= near && std::abs(positions_[edge.to][d] - side) <= near)
        return true;
    }
  return false;
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
    const double cells_per_length = mean.cwiseQuotient(cell_widths(positions_[v])).norm();
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

/// Moves a hit of a strip to the point of its edge nearest to it, and returns what it covers of its face.
double FadingSheets::fade_out(Crossing& hit) const
{
  const auto& [a, b, c] = triangles_[hit.triangle];
  const Vec3 x = hit.weights[0] * positions_[a] + hit.weights[1] * positions_[b] + hit.weights[2] * positions_[c];
  const FreeEdge& edge = edges_[edge_of_strip_[hit.triangle - sheet_triangles_]];
  const Vec3& from = positions_[edge.from];
  const Vec3& to = positions_[edge.to];
  const double part = nearest_on_segment(x, from, to);
  hit.triangle = edge.triangle;
  for (int m = 0; m < 3; ++m) {
    const int v = triangles_[edge.triangle][m];
    hit.weights[m] = v == edge.from ? 1.0 - part : v == edge.to ? part : 0.0;
  }
  return cover_beyond_edge((x - from - part * (to - from)).cwiseQuotient(cell_widths(x)).norm());
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
