// SPDX-License-Identifier: BSD-3-Clause
// Direction of the material in every triangle of the reference.
#include "shell/fibres.hpp"

#include <Eigen/Geometry>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// Smallest length of a unit direction's projection that still tells a direction in the plane.
constexpr double least_projection = 1e-3;

Fibre fibre_in_triangle(const surface::TriangleMesh& mesh, int t, const Vec3& direction, std::string_view shell)
{
  const auto& corners = mesh.triangles[t];
  const Vec3 e1 = (mesh.vertices[corners[1]] - mesh.vertices[corners[0]]).normalized();
  const Vec3 e2 = unit_normal(mesh, t).cross(e1);
  const Fibre a(e1.dot(direction), e2.dot(direction));
  if (a.norm() > least_projection * direction.norm())
    return a.normalized();
  const Vec3 x = centroid(mesh, t);
  fail_input(
      "shell '{}': the fibre ({:g}, {:g}, {:g}) of triangle {} near ({:.4g}, {:.4g}, {:.4g}) must not be zero or "
      "normal to the triangle: it has no direction in its plane",
      shell, direction.x(), direction.y(), direction.z(), t, x.x(), x.y(), x.z());
}

}  // namespace

std::vector<Fibre> fibres_in_triangles(const surface::TriangleMesh& mesh, const std::vector<Vec3>& directions,
                                       std::string_view shell)
{
  if (directions.empty())
    return std::vector<Fibre>(mesh.n_triangles(), Fibre::UnitX());
  if (directions.size() != mesh.triangles.size())
    fail_input("shell '{}': there are {} fibre directions for {} triangles; there must be one for each", shell,
               directions.size(), mesh.n_triangles());
  std::vector<Fibre> fibres;
  fibres.reserve(directions.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    fibres.push_back(fibre_in_triangle(mesh, t, directions[t], shell));
  return fibres;
}

std::vector<Vec3> uniform_directions(const surface::TriangleMesh& mesh, const Vec3& direction)
{
  return std::vector<Vec3>(mesh.n_triangles(), direction);
}

std::vector<Vec3> circumferential_directions(const surface::TriangleMesh& mesh, const Vec3& axis, const Vec3& through,
                                             std::string_view shell)
{
  std::vector<Vec3> directions;
  directions.reserve(mesh.triangles.size());
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 arm = centroid(mesh, t) - through;
    const Vec3 around = axis.normalized().cross(arm);
    if (!(around.norm() > least_projection * arm.norm()))
      fail_input("shell '{}': triangle {} lies on the axis about which the fibres run; move the axis", shell, t);
    directions.push_back(around);
  }
  return directions;
}

}  // namespace luff::shell
