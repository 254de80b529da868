// SPDX-License-Identifier: BSD-3-Clause
// Vertices are found by where they are, whatever the scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "surface/generators.hpp"
#include "surface/selection.hpp"

namespace luff::surface {
namespace {

using Numbers = std::vector<int>;

TriangleMesh sheet(double size)
{
  return rectangle({.a = Vec3(size, 0, 0), .b = Vec3(0, size, 0), .divisions = {2, 2}});
}

TEST(Selection, EdgeBoxPlaneAndPointFindTheirVerticesAtAnyScale)
{
  for (const double s : {1e-6, 1.0, 1e6}) {
    const TriangleMesh mesh = sheet(s);
    EXPECT_EQ(select_vertices(mesh, EdgeWhere{Vec3(0, 0, 0), Vec3(0, s, 0)}, "support"), (Numbers{0, 1, 2}));
    EXPECT_EQ(select_vertices(mesh, EdgeWhere{Vec3(0, 0, 0), Vec3(0, 0.6 * s, 0)}, "support"), (Numbers{0, 1}));
    EXPECT_EQ(select_vertices(mesh, BoxWhere{Vec3(0.4 * s, 0, -s), Vec3(s, 0.6 * s, s)}, "support"),
              (Numbers{3, 4, 6, 7}));
    EXPECT_EQ(select_vertices(mesh, PlaneWhere{Vec3(0, 0.5 * s, 0), Vec3(0, 7, 0)}, "support"), (Numbers{1, 4, 7}));
    EXPECT_EQ(select_vertices(mesh, PointWhere{Vec3(0.9 * s, 0.8 * s, s)}, "load"), (Numbers{8}));
  }
}

TEST(Selection, ToleranceIsAMillionthOfTheMesh)
{
  const TriangleMesh mesh = sheet(1e-3);
  const double size = bounding_box(mesh.vertices).size();
  EXPECT_EQ(select_vertices(mesh, PlaneWhere{Vec3(0.9e-6 * size, 0, 0), Vec3::UnitX()}, "support").size(), 3u);
  EXPECT_THROW(select_vertices(mesh, PlaneWhere{Vec3(1.1e-6 * size, 0, 0), Vec3::UnitX()}, "support"), InputError);
}

TEST(Selection, EmptySelectionNamesTheNearestVertex)
{
  try {
    select_vertices(sheet(1), EdgeWhere{Vec3(1.25, 0.9, 0), Vec3(1.25, 1.1, 0)}, "case.toml:12: support");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("case.toml:12: support"), std::string::npos) << text;
    EXPECT_NE(text.find("vertex 8 at [1, 1, 0], 0.25 away"), std::string::npos) << text;
  }
}

TEST(Selection, PlacesWithoutExtentAreRefused)
{
  const TriangleMesh mesh = sheet(1);
  EXPECT_THROW(select_vertices(mesh, EdgeWhere{Vec3::Zero(), Vec3::Zero()}, "support"), InputError);
  EXPECT_THROW(select_vertices(mesh, BoxWhere{Vec3::Ones(), Vec3::Zero()}, "support"), InputError);
  EXPECT_THROW(select_vertices(mesh, PlaneWhere{Vec3::Ones(), Vec3::Zero()}, "support"), InputError);
}

std::string refusal(const MarkedMesh& marked, const std::string& name)
{
  try {
    select_vertices(marked.mesh, SetWhere{name}, "support", marked.marks.sets);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Selection, SetsStandForTheVerticesOfTheirVerticesEdgesAndTriangles)
{
  MarkedMesh marked{.mesh = sheet(1)};
  marked.marks.sets.vertices["mixed"] = {8};
  marked.marks.sets.edges["mixed"] = {{2, 5}};
  marked.marks.sets.triangles["mixed"] = {0};
  const Sets& sets = marked.marks.sets;
  EXPECT_EQ(select_vertices(marked.mesh, SetWhere{"mixed"}, "load", sets), (Numbers{0, 2, 3, 4, 5, 8}));
  EXPECT_EQ(select_triangles(marked.mesh, SetWhere{"mixed"}, "load", sets), (Numbers{0}));
}

TEST(Selection, AllIsEverything)
{
  const TriangleMesh mesh = sheet(1);
  EXPECT_EQ(select_vertices(mesh, AllWhere{}, "load").size(), 9u);
  EXPECT_EQ(select_triangles(mesh, AllWhere{}, "load").size(), 8u);
}

TEST(Selection, TrianglesOfAPlaceHaveAllTheirCornersThere)
{
  const TriangleMesh mesh = sheet(1);
  EXPECT_EQ(select_triangles(mesh, BoxWhere{Vec3(0, 0, 0), Vec3(0.5, 1, 0)}, "load").size(), 4u);
  EXPECT_THROW(select_triangles(mesh, EdgeWhere{Vec3(0, 0, 0), Vec3(0, 1, 0)}, "load"), InputError);
}

TEST(Selection, UnknownAndEmptySetsAreRefusedWithTheNearestName)
{
  MarkedMesh marked{.mesh = sheet(1)};
  EXPECT_NE(refusal(marked, "attached").find("the mesh has no named sets"), std::string::npos);
  marked.marks.sets.vertices["attached"] = {};
  marked.marks.sets.edges["free edge"] = {{0, 1}};
  EXPECT_EQ(refusal(marked, "atached"), "support: the mesh has no set \"atached\" (did you mean 'attached'?)");
  EXPECT_EQ(refusal(marked, "attached"), "support: the mesh's set \"attached\" is empty");
}

TEST(Selection, EdgesOfMadeSurfacesHaveNames)
{
  const MarkedMesh strip = make(Rectangle{.divisions = {2, 3}});
  EXPECT_EQ(select_vertices(strip.mesh, SetWhere{"a_min"}, "support", strip.marks.sets), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(select_vertices(strip.mesh, SetWhere{"b_max"}, "support", strip.marks.sets), (Numbers{3, 7, 11}));
  const auto heights = [](const Shape& shape, const std::string& name) {
    const MarkedMesh marked = make(shape);
    double low = 1e9, high = -1e9;
    for (const int v : select_vertices(marked.mesh, SetWhere{name}, "support", marked.marks.sets)) {
      low = std::min(low, marked.mesh.vertices[v].z());
      high = std::max(high, marked.mesh.vertices[v].z());
    }
    return std::pair{low, high};
  };
  EXPECT_EQ(heights(Cylinder{.length = 3}, "length_max"), (std::pair{3.0, 3.0}));
  EXPECT_EQ(heights(Cylinder{.length = 3, .angle = {0, 90}}, "angle_max"), (std::pair{0.0, 3.0}));
  EXPECT_EQ(heights(Cylinder{.length = 3}, "boundary"), (std::pair{0.0, 3.0}));
  EXPECT_EQ(heights(SphereCap{.polar = {0, 60}}, "polar_min"), (std::pair{1.0, 1.0}));
  EXPECT_NEAR(heights(SphereCap{.polar = {0, 60}}, "polar_max").first, 0.5, 1e-15);
  EXPECT_NEAR(heights(SphereCap{.polar = {60, 180}}, "polar_min").second, 0.5, 1e-15);
  EXPECT_EQ(heights(SphereCap{.polar = {60, 180}}, "polar_max"), (std::pair{-1.0, -1.0}));
  EXPECT_NEAR(heights(SphereCap{.polar = {18, 90}}, "polar_max").first, 0, 1e-15);
  const MarkedMesh ring = make(Annulus{.inner_radius = 2, .radius = 3});
  for (const int v : select_vertices(ring.mesh, SetWhere{"radius_min"}, "support", ring.marks.sets))
    EXPECT_NEAR(ring.mesh.vertices[v].norm(), 2, 1e-14);
  const MarkedMesh balloon = make(SphereCap{.polar = {0, 180}});
  EXPECT_FALSE(balloon.marks.sets.edges.contains("boundary"));
  const MarkedMesh lower = make(SphereCap{.polar = {90, 180}, .angle = {0, 90}});
  for (const int v : select_vertices(lower.mesh, SetWhere{"angle_min"}, "support", lower.marks.sets))
    EXPECT_NEAR(lower.mesh.vertices[v].y(), 0, 1e-15);
}

}  // namespace
}  // namespace luff::surface
