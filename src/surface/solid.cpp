// SPDX-License-Identifier: BSD-3-Clause
#include "surface/solid.hpp"
#include "core/bounding_box.hpp"

#include <numeric>
#include <utility>

namespace luff::surface {

namespace {

struct Moments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

/// Adds what a point on the surface with the area normal n dA along axis d stands for: the column from x_d = 0 to it.
void add_column(Moments& moments, const Vec3& x, int d, double n_dA)
{
  const double h = x[d];
  Vec3 middle = x;
  middle[d] = 0.5 * h;
  moments.volume += n_dA * h;
  moments.first += n_dA * h * middle;
  Mat3 second = h * middle * middle.transpose();
  second(d, d) = h * h * h / 3.0;
  moments.second += n_dA * second;
}

/// Four points, exact for polynomials of degree 3.
void add_triangle(Moments& moments, const std::array<Vec3, 3>& x, int d)
{
  const double n_dA = area_vector(x[0], x[1], x[2])[d];
  const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0;
  add_column(moments, middle, d, -27.0 / 48.0 * n_dA);
  for (const Vec3& corner : x)
    add_column(moments, 0.6 * middle + 0.4 * corner, d, 25.0 / 48.0 * n_dA);
}

}  // namespace

Solid solid(const TriangleMesh& mesh, const AxisPlane& plane)
{
  Vec3 origin = std::accumulate(mesh.vertices.begin(), mesh.vertices.end(), Vec3(Vec3::Zero())) / mesh.n_vertices();
  origin[plane.axis] = plane.at;
  Moments m;
  for (const auto& t : mesh.triangles)
    add_triangle(m, {mesh.vertices[t[0]] - origin, mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin},
                 plane.axis);
  const Vec3 centroid = m.first / m.volume;
  const Mat3 about_centroid = m.second - m.volume * centroid * centroid.transpose();
  return {.volume = m.volume,
          .centroid = origin + centroid,
          .inertia = about_centroid.trace() * Mat3::Identity() - about_centroid};
}

Solid solid(const TriangleMesh& mesh)
{
  return solid(mesh, {0, bounding_box(mesh.vertices).low[0]});
}

void reverse(TriangleMesh& mesh)
{
  for (auto& t : mesh.triangles)
    std::swap(t[1], t[2]);
}

}  // namespace luff::surface
