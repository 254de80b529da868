// SPDX-License-Identifier: BSD-3-Clause
// Small faults are put right and counted, names and directions stay with what they belong to.
#include "surface/repair.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "surface/generators.hpp"
#include "surface/validation.hpp"

namespace luff::surface {
namespace {

/// 2 x 2 squares over [0, 2]^2, every triangle with corners of its own.
MarkedMesh soup()
{
  const TriangleMesh whole = rectangle({.a = Vec3(2, 0, 0), .b = Vec3(0, 2, 0), .divisions = {2, 2}});
  MarkedMesh marked;
  for (const auto& t : whole.triangles) {
    const int first = marked.mesh.n_vertices();
    for (const int v : t)
      marked.mesh.vertices.push_back(whole.vertices[v] + 1e-12 * Vec3(first % 2, first % 3, 0));
    marked.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return marked;
}

MarkedMesh sheet()
{
  return make(Rectangle{.a = Vec3(2, 0, 0), .b = Vec3(0, 2, 0), .divisions = {2, 2}});
}

TEST(Repair, SeparateTrianglesBecomeOneSheet)
{
  MarkedMesh marked = soup();
  repair(marked);
  EXPECT_NO_THROW(validate(marked.mesh, "soup"));
  EXPECT_EQ(marked.mesh.n_vertices(), 9);
  EXPECT_EQ(marked.mesh.n_triangles(), 8);
  EXPECT_EQ(marked.marks.repairs.united_vertices, 15);
  EXPECT_EQ(text(marked.marks.repairs), "15 vertices united with another at the same place");
}

TEST(Repair, SoundMeshStaysAsItIs)
{
  MarkedMesh marked = sheet();
  const MarkedMesh before = marked;
  repair(marked);
  EXPECT_FALSE(marked.marks.repairs.any());
  EXPECT_EQ(marked.mesh.vertices, before.mesh.vertices);
  EXPECT_EQ(marked.mesh.triangles, before.mesh.triangles);
  EXPECT_EQ(marked.marks.sets.edges, before.marks.sets.edges);
}

TEST(Repair, FewerTrianglesOfEachPieceAreReversed)
{
  MarkedMesh marked = sheet();
  const auto good = marked.mesh.triangles;
  std::swap(marked.mesh.triangles[5][0], marked.mesh.triangles[5][1]);
  std::swap(marked.mesh.triangles[2][1], marked.mesh.triangles[2][2]);
  // A second piece, whose larger part faces down: it stays so.
  const int first = marked.mesh.n_vertices();
  for (const Vec3& x : {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(6, 1, 0), Vec3(5, 1, 0), Vec3(4, 0, 0)})
    marked.mesh.vertices.push_back(x);
  marked.mesh.triangles.push_back({first, first + 2, first + 1});
  marked.mesh.triangles.push_back({first, first + 3, first + 2});
  marked.mesh.triangles.push_back({first, first + 3, first + 4});
  repair(marked);
  EXPECT_NO_THROW(validate(marked.mesh, "sheet"));
  EXPECT_EQ(marked.marks.repairs.reversed_triangles, 3);
  EXPECT_GT(unit_normal(marked.mesh, 5).z(), 0);
  EXPECT_GT(unit_normal(marked.mesh, 2).z(), 0);
  for (const int t : {8, 9, 10})
    EXPECT_LT(unit_normal(marked.mesh, t).z(), 0);
}

TEST(Repair, NamesAndDirectionsFollowWhatIsUnitedAndDropped)
{
  MarkedMesh marked = soup();
  marked.mesh.vertices.insert(marked.mesh.vertices.begin(), Vec3(9, 9, 9));
  for (auto& triangle : marked.mesh.triangles)
    for (int& v : triangle)
      ++v;
  const auto t = marked.mesh.triangles[1];
  marked.mesh.triangles.insert(marked.mesh.triangles.begin() + 4, {t[2], t[0], t[1]});
  std::vector<Vec3>& field = marked.marks.directions["fibre"];
  for (int n = 0; n < 9; ++n)
    field.emplace_back(n, 0, 0);
  marked.marks.sets.vertices["some"] = {0, 1, 4};  // the orphan, and two at the place of the first corner
  marked.marks.sets.triangles["again"] = {4, 8};
  marked.marks.sets.edges["side"] = {{1, 2}};
  repair(marked);
  const Repairs& repairs = marked.marks.repairs;
  EXPECT_NO_THROW(validate(marked.mesh, "sheet"));
  EXPECT_EQ(repairs.dropped_vertices, 1);
  EXPECT_EQ(repairs.dropped_triangles, 1);
  EXPECT_EQ(text(repairs),
            "15 vertices united with another at the same place, 1 vertex without triangle dropped, 1 triangle with the "
            "corners of another dropped");
  EXPECT_EQ(marked.marks.sets.vertices["some"], (std::vector<int>{0}));
  EXPECT_EQ(marked.marks.sets.triangles["again"], (std::vector<int>{1, 7}));
  EXPECT_EQ(marked.marks.sets.edges["side"], (std::vector<EdgeKey>{{0, 1}}));
  EXPECT_EQ(marked.mesh.vertices[0].norm() < 1e-9, true);
  ASSERT_EQ(field.size(), 8u);
  EXPECT_EQ(field[3].x(), 3);
  EXPECT_EQ(field[4].x(), 5);
}

TEST(Repair, WhatCannotBePutRightIsLeftForValidation)
{
  MarkedMesh fin = sheet();
  fin.mesh.vertices.emplace_back(0.5, 0.5, 1);
  fin.mesh.triangles.push_back({0, 4, 9});
  repair(fin);
  EXPECT_THROW(validate(fin.mesh, "fin"), InputError);
  MarkedMesh thin = sheet();
  thin.mesh.vertices.emplace_back(0, 0.5, 0);
  thin.mesh.triangles.push_back({0, 1, 9});
  repair(thin);
  EXPECT_THROW(validate(thin.mesh, "thin"), InputError);
}

}  // namespace
}  // namespace luff::surface
