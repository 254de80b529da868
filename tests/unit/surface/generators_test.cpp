// SPDX-License-Identifier: BSD-3-Clause
// Generated sheets are sound, cover what they should, and move as told.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "surface/generators.hpp"
#include "surface/topology.hpp"
#include "surface/validation.hpp"

namespace luff::surface {
namespace {

Rectangle slanted(Pattern pattern)
{
  return {.origin = Vec3(1, 2, 3),
          .a = Vec3(3, 0, 1),
          .b = Vec3(0.2, 2, 0),
          .divisions = {9, 7},
          .pattern = pattern,
          .seed = 3};
}

TEST(Rectangle, EveryPatternIsSoundAndCoversTheParallelogram)
{
  for (const Pattern pattern : {Pattern::Diagonal, Pattern::Alternating, Pattern::Irregular}) {
    const Rectangle shape = slanted(pattern);
    const TriangleMesh mesh = rectangle(shape);
    EXPECT_NO_THROW(validate(mesh, "rectangle"));
    EXPECT_EQ(mesh.n_vertices(), 80);
    EXPECT_EQ(mesh.n_triangles(), 126);
    const Vec3 exact = shape.a.cross(shape.b);
    EXPECT_NEAR(total_area(mesh), exact.norm(), 1e-12);
    for (int t = 0; t < mesh.n_triangles(); ++t)
      EXPECT_NEAR(unit_normal(mesh, t).dot(exact.normalized()), 1, 1e-12);
    EXPECT_EQ(topology(mesh).boundary.size(), 32u);
  }
}

TEST(Rectangle, IrregularPatternIsDelaunay)
{
  const TriangleMesh mesh = rectangle(slanted(Pattern::Irregular));
  const Topology neighbours = topology(mesh);
  const auto angle = [&](int t, int k) {
    const auto [a, b] = edge_vertices(mesh.triangles[t], k);
    const Vec3 p = mesh.vertices[mesh.triangles[t][k]];
    const Vec3 u = (mesh.vertices[a] - p).normalized(), v = (mesh.vertices[b] - p).normalized();
    return std::acos(u.dot(v));
  };
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (neighbours.neighbour[t][k] < 0)
        continue;
      EXPECT_LT(angle(t, k) + angle(neighbours.neighbour[t][k], neighbours.neighbour_edge[t][k]), M_PI + 1e-6);
    }
}

TEST(Rectangle, SameSeedGivesTheSameMeshAndAnotherSeedAnother)
{
  Rectangle shape = slanted(Pattern::Irregular);
  const TriangleMesh first = rectangle(shape), again = rectangle(shape);
  shape.seed = 4;
  const TriangleMesh other = rectangle(shape);
  EXPECT_EQ(first.vertices, again.vertices);
  EXPECT_EQ(first.triangles, again.triangles);
  EXPECT_NE(first.vertices, other.vertices);
}

TEST(Rectangle, BadNumbersAreRefused)
{
  EXPECT_THROW(rectangle({.divisions = {0, 3}}), InputError);
  EXPECT_THROW(rectangle({.a = Vec3(1, 0, 0), .b = Vec3(2, 0, 0)}), InputError);
  EXPECT_THROW(rectangle({.a = Vec3::Zero()}), InputError);
  EXPECT_THROW(rectangle({.a = Vec3(std::numeric_limits<double>::infinity(), 0, 0)}), InputError);
  EXPECT_THROW(rectangle({.displacement = 0.6}), InputError);
}

TEST(Transform, ScaleRotateAndTranslateMoveTheVertices)
{
  TriangleMesh mesh = rectangle({});
  scale(mesh, Vec3(2, 3, 1));
  rotate(mesh, Vec3(0, 0, 5), 90, Vec3(2, 0, 0));
  translate(mesh, Vec3(0, 0, 7));
  EXPECT_LT((mesh.vertices[0] - Vec3(2, -2, 7)).norm(), 1e-14);
  EXPECT_LT((mesh.vertices[3] - Vec3(-1, 0, 7)).norm(), 1e-14);
  EXPECT_THROW(rotate(mesh, Vec3::Zero(), 10), InputError);
  EXPECT_THROW(scale(mesh, Vec3(1, 0, 1)), InputError);
}

TEST(Topology, NeighboursAgreeAboutTheirSharedEdge)
{
  const TriangleMesh mesh = rectangle(slanted(Pattern::Irregular));
  const Topology neighbours = topology(mesh);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int u = neighbours.neighbour[t][k], l = neighbours.neighbour_edge[t][k];
      if (u < 0)
        continue;
      EXPECT_EQ(neighbours.neighbour[u][l], t);
      const auto [a, b] = edge_vertices(mesh.triangles[t], k);
      EXPECT_EQ(edge_vertices(mesh.triangles[u], l), (std::pair{b, a}));
    }
}

}  // namespace
}  // namespace luff::surface
