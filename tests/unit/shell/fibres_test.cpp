// SPDX-License-Identifier: BSD-3-Clause
// Directions of the material in the triangles' frames.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/fibres.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::test::curved_sheet;

/// The fibre of a triangle as a direction in space.
Vec3 in_space(const surface::TriangleMesh& mesh, int t, const Fibre& a)
{
  const auto& corners = mesh.triangles[t];
  const Vec3 e1 = (mesh.vertices[corners[1]] - mesh.vertices[corners[0]]).normalized();
  return a[0] * e1 + a[1] * unit_normal(mesh, t).cross(e1);
}

TEST(Fibres, AreTheProjectionsOfTheirDirections)
{
  const surface::TriangleMesh mesh = curved_sheet();
  const Vec3 direction(1, 2, 0.5);
  const std::vector<Fibre> fibres = fibres_in_triangles(mesh, uniform_directions(mesh, direction), "sheet");
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    const Vec3 n = unit_normal(mesh, t);
    const Vec3 projection = (direction - direction.dot(n) * n).normalized();
    EXPECT_LT((in_space(mesh, t, fibres[t]) - projection).norm(), 1e-14);
  }
}

TEST(Fibres, RunAlongTheFirstSideWhereNoDirectionIsGiven)
{
  const surface::TriangleMesh mesh = curved_sheet();
  for (const Fibre& a : fibres_in_triangles(mesh, {}, "sheet"))
    EXPECT_EQ(a, Fibre(1, 0));
}

TEST(Fibres, OfACircumferenceAreTangentialToCirclesAboutTheAxis)
{
  const surface::TriangleMesh mesh = curved_sheet();
  const Vec3 axis(0, 0, 2), through(-1, 3, 0.4);
  const std::vector<Vec3> directions = circumferential_directions(mesh, axis, through, "sheet");
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    EXPECT_NEAR(directions[t].dot(axis), 0, 1e-14);
    EXPECT_NEAR(directions[t].dot(centroid(mesh, t) - through), 0, 1e-13);
    EXPECT_GT(axis.dot((centroid(mesh, t) - through).cross(directions[t])), 0) << "right-handed";
  }
}

TEST(Fibres, NormalToATriangleAreRefused)
{
  const surface::TriangleMesh mesh = luff::test::sheet(1, 1, 2, 2);
  EXPECT_THROW(fibres_in_triangles(mesh, uniform_directions(mesh, Vec3(0, 0, 3)), "sheet"), InputError);
  EXPECT_THROW(fibres_in_triangles(mesh, uniform_directions(mesh, Vec3::Zero()), "sheet"), InputError);
  EXPECT_THROW(fibres_in_triangles(mesh, {Vec3(1, 0, 0)}, "sheet"), InputError);
  EXPECT_THROW(circumferential_directions(mesh, Vec3::UnitZ(), centroid(mesh, 3), "sheet"), InputError);
}

}  // namespace
}  // namespace luff::shell
