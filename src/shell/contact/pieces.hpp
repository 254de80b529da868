// SPDX-License-Identifier: BSD-3-Clause
// All surfaces that may touch, as vertices, edges and triangles.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "shell/contact/boxes.hpp"
#include "surface/closest_points.hpp"
#include "surface/mesh.hpp"

namespace luff::shell {

using surface::Corners;

/// One sheet: a deformable shell or part of one, or a rigid body that moves as prescribed.
struct ContactSheet {
  std::string name;
  surface::TriangleMesh mesh;  ///< at the start
  bool deforms = true;
};

/// Vertices of all sheets, numbered one sheet after the other; positions are vectors x0 y0 z0 x1 ... of all of them.
/// A surface is a connected part of a sheet: the three leaflets of a valve are three surfaces, in one file or in three.
class ContactPieces {
 public:
  explicit ContactPieces(std::span<const ContactSheet> sheets);

  int n_vertices() const { return static_cast<int>(surface_.size()); }
  const Eigen::VectorXd& reference() const { return reference_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  /// Number of the connected surface of each vertex.
  int surface(int vertex) const { return surface_[vertex]; }
  bool deforms(int vertex) const { return deforms_[vertex] != 0; }
  /// A third of the triangles around a vertex, or of those on an edge; of a triangle [L^2].
  double vertex_area(int vertex) const { return vertex_area_[vertex]; }
  double edge_area(int edge) const { return edge_area_[edge]; }
  double triangle_area(int triangle) const { return triangle_area_[triangle]; }
  /// Mean edge length of the deformable sheet with the shortest, and its name.
  double shortest_mean_edge() const { return shortest_mean_edge_; }
  const std::string& finest_sheet() const { return finest_sheet_; }
  /// "vertex 3 of 'leaflet'"
  std::string name_of(int vertex) const;

 private:
  void add(const ContactSheet& sheet, int first);
  void number_surfaces();

  std::vector<std::string> sheet_names_;
  std::vector<int> first_vertex_;
  Eigen::VectorXd reference_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<int> surface_;
  std::vector<char> deforms_;
  std::vector<double> vertex_area_, edge_area_, triangle_area_;
  double shortest_mean_edge_ = 0;
  std::string finest_sheet_;
};

inline Vec3 vertex(const Eigen::VectorXd& x, int v)
{
  return x.segment<3>(3 * v);
}

inline Corners corners(const Eigen::VectorXd& x, const std::array<int, 4>& v)
{
  return {vertex(x, v[0]), vertex(x, v[1]), vertex(x, v[2]), vertex(x, v[3])};
}

/// Boxes around every vertex, edge or triangle.
void box_vertices(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes);
void box_edges(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes);
void box_triangles(const ContactPieces& pieces, const Eigen::VectorXd& x, Boxes& boxes);

}  // namespace luff::shell
