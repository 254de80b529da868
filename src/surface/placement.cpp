// SPDX-License-Identifier: BSD-3-Clause
// Meshes turned, moved and stretched.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/generators.hpp"

namespace luff::surface {

namespace {

Eigen::AngleAxisd rotation(const Vec3& axis, double degrees)
{
  if (!axis.allFinite() || !(axis.norm() > 0) || !std::isfinite(degrees))
    fail_input("rotate: axis = [{}, {}, {}] must have a length and angle = {} must be finite", axis.x(), axis.y(),
               axis.z(), degrees);
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized());
}

}  // namespace

void rotate(TriangleMesh& mesh, const Vec3& axis, double degrees, const Vec3& about)
{
  const Eigen::AngleAxisd turn = rotation(axis, degrees);
  for (Vec3& x : mesh.vertices)
    x = about + turn * Vec3(x - about);
}

void rotate(MarkedMesh& marked, const Vec3& axis, double degrees, const Vec3& about)
{
  rotate(marked.mesh, axis, degrees, about);
  const Eigen::AngleAxisd turn = rotation(axis, degrees);
  for (auto& [name, field] : marked.marks.directions)
    for (Vec3& direction : field)
      direction = turn * direction;
}

void translate(TriangleMesh& mesh, const Vec3& shift)
{
  for (Vec3& x : mesh.vertices)
    x += shift;
}

void scale(TriangleMesh& mesh, const Vec3& factors)
{
  if (!(factors.minCoeff() > 0) || !factors.allFinite())
    fail_input("scale: factors [{}, {}, {}] must be positive", factors.x(), factors.y(), factors.z());
  for (Vec3& x : mesh.vertices)
    x = x.cwiseProduct(factors);
}

}  // namespace luff::surface
