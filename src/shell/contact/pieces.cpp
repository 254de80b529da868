// SPDX-License-Identifier: BSD-3-Clause
// All surfaces that may touch, as vertices, edges and triangles.
#include "shell/contact/pieces.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "surface/topology.hpp"

namespace luff::shell {

namespace {

template <std::size_t N>
void box(const std::vector<std::array<int, N>>& pieces, const Eigen::VectorXd& x, Boxes& boxes)
{
  boxes.clear();
  for (const auto& piece : pieces) {
    Vec3 low = vertex(x, piece[0]), high = low;
    for (std::size_t k = 1; k < N; ++k) {
      low = low.cwiseMin(vertex(x, piece[k]));
      high = high.cwiseMax(vertex(x, piece[k]));
    }
    boxes.low.push_back(low);
    boxes.high.push_back(high);
  }
}

}  // namespace

ContactPieces::ContactPieces(std::span<const ContactSheet> sheets)
{
  int n = 0;
  for (const ContactSheet& sheet : sheets)
    n += sheet.mesh.n_vertices();
  reference_.resize(3 * n);
  vertex_area_.assign(n, 0.0);
  int first = 0;
  for (const ContactSheet& sheet : sheets) {
    add(sheet, first);
    first += sheet.mesh.n_vertices();
  }
  number_surfaces();
}

void ContactPieces::add(const ContactSheet& sheet, int first)
{
  sheet_names_.push_back(sheet.name);
  first_vertex_.push_back(first);
  reference_.segment(3 * first, 3 * sheet.mesh.n_vertices()) = surface::interleaved(sheet.mesh.vertices);
  deforms_.insert(deforms_.end(), sheet.mesh.vertices.size(), sheet.deforms ? 1 : 0);
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t) {
    const auto& [a, b, c] = sheet.mesh.triangles[t];
    triangles_.push_back({first + a, first + b, first + c});
    triangle_area_.push_back(surface::area(sheet.mesh, t));
    for (const int corner : triangles_.back())
      vertex_area_[corner] += triangle_area_.back() / 3;
  }
  double length = 0;
  const auto edges = surface::edge_map(sheet.mesh);
  for (const auto& [key, sides] : edges) {
    edges_.push_back({first + key.first, first + key.second});
    edge_area_.push_back(0);
    for (const surface::TriangleEdge& side : sides)
      edge_area_.back() += surface::area(sheet.mesh, side.triangle) / 3;
    length += (sheet.mesh.vertices[key.second] - sheet.mesh.vertices[key.first]).norm();
  }
  const double mean_edge = length / static_cast<double>(edges.size());
  if (sheet.deforms && (finest_sheet_.empty() || mean_edge < shortest_mean_edge_)) {
    shortest_mean_edge_ = mean_edge;
    finest_sheet_ = sheet.name;
  }
}

/// Vertices joined by edges belong to one surface; it takes the number of its lowest vertex.
void ContactPieces::number_surfaces()
{
  surface_.resize(vertex_area_.size());
  std::iota(surface_.begin(), surface_.end(), 0);
  const auto root = [this](int v) {
    while (surface_[v] != v)
      v = surface_[v] = surface_[surface_[v]];
    return v;
  };
  for (const auto& [a, b] : edges_) {
    const int at_a = root(a), at_b = root(b);
    surface_[std::max(at_a, at_b)] = std::min(at_a, at_b);
  }
  for (int v = 0; v < n_vertices(); ++v)
    surface_[v] = root(v);
}

std::string ContactPieces::name_of(int vertex) const
{
  const auto next = std::upper_bound(first_vertex_.begin(), first_vertex_.end(), vertex);
  const auto sheet = next - first_vertex_.begin() - 1;
  return fmt::format("vertex {} of '{}'", vertex - first_vertex_[sheet], sheet_names_[sheet]);
}

void box_vertices(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes)
{
  boxes.clear();
  for (int v = 0; v < pieces.n_vertices(); ++v)
    boxes.low.push_back(vertex(x, v));
  boxes.high = boxes.low;
}

void box_edges(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes)
{
  box(pieces.edges(), x, boxes);
}

void box_triangles(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes)
{
  box(pieces.triangles(), x, boxes);
}

}  // namespace luff::shell
