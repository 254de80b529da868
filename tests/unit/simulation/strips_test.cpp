// SPDX-License-Identifier: BSD-3-Clause
// Forces by strips of a surface.
#include <numeric>

#include <gtest/gtest.h>

#include "simulation/section_record.hpp"
#include "surface/generators.hpp"

namespace luff::simulation {
namespace {

surface::TriangleMesh slanted()
{
  return surface::rectangle({.a = Vec3(1.0, 0.0, 0.2), .b = Vec3(0.3, 2.0, 0.0), .divisions = {7, 5}});
}

TEST(Strips, AddUpToTheWholeForce)
{
  const surface::TriangleMesh mesh = slanted();
  std::vector<Vec3> forces;
  Vec3 whole = Vec3::Zero();
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    forces.emplace_back(std::sin(3.0 * v), 1.0 + 0.1 * v, std::cos(v));
    whole += forces.back();
  }
  for (const int count : {1, 3, 4, 17}) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& force : Strips(mesh, {0.4, 3.0, -1.0}, count).forces(forces))
      sum += force;
    EXPECT_LE((sum - whole).norm(), 1e-13 * whole.norm()) << count;
  }
}

TEST(Strips, OfAUniformTractionTakeItsForcePerLength)
{
  // Strips that lie within the width of the mesh's own, at other places.
  const surface::TriangleMesh mesh =
      surface::rectangle({.a = Vec3(1.0, 0.0, 0.0), .b = Vec3(0.0, 2.0, 0.0), .divisions = {40, 60}});
  std::vector<Vec3> forces(mesh.n_vertices(), Vec3::Zero());
  const Vec3 traction(0.5, -1.0, 2.0);
  for (const auto& [a, b, c] : mesh.triangles)
    for (const int v : {a, b, c})
      forces[v] += surface::area_vector(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]).norm() / 3.0 * traction;
  const Strips strips(mesh, Vec3::UnitY(), 7);
  EXPECT_DOUBLE_EQ(strips.width(), 2.0 / 7.0);
  const std::vector<Vec3> by_strip = strips.forces(forces);
  for (int n = 0; n < strips.count(); ++n) {
    EXPECT_NEAR(strips.begin(n), n * 2.0 / 7.0, 1e-15);
    // At the ends the force of the last row of vertices is spread over the row of triangles beside it: a sixth of it.
    EXPECT_LE((by_strip[n] / strips.width() - traction).norm(), 0.02 * traction.norm()) << n;
  }
}

}  // namespace
}  // namespace luff::simulation
