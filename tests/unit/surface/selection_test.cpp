// SPDX-License-Identifier: BSD-3-Clause
// Vertices are found by where they are, whatever the scale.
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace luff::surface
