// SPDX-License-Identifier: BSD-3-Clause
// Geometry of the triangles of a surface.
#include "surface/mesh.hpp"

#include <cmath>

namespace luff::surface {

namespace {

std::array<Vec3, 3> corners(const TriangleMesh& mesh, int triangle)
{
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Vec3 area_vector_of(const TriangleMesh& mesh, int triangle)
{
  const auto [a, b, c] = corners(mesh, triangle);
  return area_vector(a, b, c);
}

}  // namespace

double area(const TriangleMesh& mesh, int triangle)
{
  return area_vector_of(mesh, triangle).norm();
}

Vec3 unit_normal(const TriangleMesh& mesh, int triangle)
{
  return area_vector_of(mesh, triangle).normalized();
}

Vec3 centroid(const TriangleMesh& mesh, int triangle)
{
  const auto [a, b, c] = corners(mesh, triangle);
  return (a + b + c) / 3;
}

double total_area(const TriangleMesh& mesh)
{
  double sum = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    sum += area(mesh, t);
  return sum;
}

double mean_element_size(const TriangleMesh& mesh)
{
  double sum = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    sum += std::sqrt(2 * area(mesh, t));
  return sum / mesh.n_triangles();
}

Eigen::VectorXd interleaved(std::span<const Vec3> points)
{
  Eigen::VectorXd coordinates(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    coordinates.segment<3>(3 * i) = points[i];
  return coordinates;
}

std::vector<Vec3> points(const Eigen::VectorXd& coordinates)
{
  std::vector<Vec3> result(coordinates.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = coordinates.segment<3>(3 * i);
  return result;
}

}  // namespace luff::surface
