// SPDX-License-Identifier: BSD-3-Clause
// Meshes turned, moved and stretched.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/generators.hpp"

namespace luff::surface {

void rotate(TriangleMesh& mesh, const Vec3& axis, double degrees, const Vec3& about)
{
  if (!axis.allFinite() || !(axis.norm() > 0) || !std::isfinite(degrees))
    fail_input("rotate: axis = [{}, {}, {}] must have a length and angle = {} must be finite", axis.x(), axis.y(),
               axis.z(), degrees);
  const Eigen::AngleAxisd rotation(degrees * std::numbers::pi / 180, axis.normalized());
  for (Vec3& x : mesh.vertices)
    x = about + rotation * Vec3(x - about);
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
