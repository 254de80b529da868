// SPDX-License-Identifier: BSD-3-Clause
// A triangulated surface and the geometry of its triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "core/vec3.hpp"

namespace luff::surface {

/// Vertices and triangles; corners run counter-clockwise seen from the side the normal points to.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  int n_vertices() const { return static_cast<int>(vertices.size()); }
  int n_triangles() const { return static_cast<int>(triangles.size()); }
};

/// Half the cross product of two sides: normal times area [L^2].
inline Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return 0.5 * (b - a).cross(c - a);
}

double area(const TriangleMesh& mesh, int triangle);
Vec3 unit_normal(const TriangleMesh& mesh, int triangle);
Vec3 centroid(const TriangleMesh& mesh, int triangle);

/// Sum of the triangles' areas [L^2].
double total_area(const TriangleMesh& mesh);

/// Mean over the triangles of sqrt(2 area) [L], the side of an equal square's half.
double mean_element_size(const TriangleMesh& mesh);

/// Coordinates x0 y0 z0 x1 ... of the points, 3n numbers.
Eigen::VectorXd interleaved(std::span<const Vec3> points);

/// Inverse of interleaved().
std::vector<Vec3> points(const Eigen::VectorXd& coordinates);

}  // namespace luff::surface
