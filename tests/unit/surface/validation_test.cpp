// SPDX-License-Identifier: BSD-3-Clause
// Every kind of bad mesh is refused, with the number, the place and a remedy.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "surface/generators.hpp"
#include "surface/validation.hpp"

namespace luff::surface {
namespace {

/// 2 x 2 squares over [0, 2 size]^2.
TriangleMesh sheet(double size = 1)
{
  return rectangle({.a = Vec3(2 * size, 0, 0), .b = Vec3(0, 2 * size, 0), .divisions = {2, 2}});
}

/// The message with which validate() refuses the mesh.
std::string refusal(const TriangleMesh& mesh)
{
  try {
    validate(mesh, "sheet.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_all(const std::string& text, std::initializer_list<const char*> parts)
{
  for (const char* part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is missing in: " << text;
}

TEST(Validation, SoundMeshPassesAtAnyScale)
{
  for (const double size : {1e-9, 1.0, 1e9})
    EXPECT_EQ(refusal(sheet(size)), "accepted") << size;
}

TEST(Validation, MeshWithoutTrianglesIsRefused)
{
  expect_all(refusal({}), {"sheet.stl", "no triangles"});
}

TEST(Validation, CornerOutOfRangeIsRefused)
{
  TriangleMesh mesh = sheet();
  mesh.triangles[3][1] = 9;
  expect_all(refusal(mesh), {"sheet.stl", "triangle 3", "vertex 9", "0..8"});
}

TEST(Validation, CoordinateThatIsNotFiniteIsRefused)
{
  TriangleMesh mesh = sheet();
  mesh.vertices[4].y() = std::numeric_limits<double>::quiet_NaN();
  expect_all(refusal(mesh), {"vertex 4", "nan", "not finite"});
}

TEST(Validation, TriangleThatUsesAVertexTwiceIsRefused)
{
  TriangleMesh mesh = sheet();
  mesh.triangles[2][1] = mesh.triangles[2][0];
  expect_all(refusal(mesh), {"triangle 2", "twice", "remove"});
}

TEST(Validation, TriangleWithoutAreaIsRefusedAtAnyScale)
{
  for (const double size : {1e-9, 1.0, 1e9}) {
    TriangleMesh mesh = sheet(size);
    const int middle = mesh.n_vertices();
    mesh.vertices.emplace_back(0, size / 2, 0);
    mesh.triangles.push_back({0, 1, middle});
    expect_all(refusal(mesh), {"triangle 8", "no area", "remove"});
  }
}

TEST(Validation, SmallButSoundTriangleBesideLargeOnesPasses)
{
  TriangleMesh mesh = sheet();
  const int first = mesh.n_vertices();
  for (const Vec3& x : {Vec3(5, 5, 0), Vec3(5 + 1e-7, 5, 0), Vec3(5, 5 + 1e-7, 0)})
    mesh.vertices.push_back(x);
  mesh.triangles.push_back({first, first + 1, first + 2});
  EXPECT_EQ(refusal(mesh), "accepted");
}

TEST(Validation, VerticesAtTheSamePlaceAreRefused)
{
  TriangleMesh mesh = sheet();
  mesh.vertices.push_back(mesh.vertices[4] + Vec3(0, 0, 1e-12));
  mesh.triangles[0][2] = 9;
  expect_all(refusal(mesh), {"vertices 4 and 9", "(1, 1, 1e-12)", "merge"});
}

TEST(Validation, UnusedVertexIsRefused)
{
  TriangleMesh mesh = sheet();
  mesh.vertices.emplace_back(7, 8, 9);
  expect_all(refusal(mesh), {"vertex 9", "(7, 8, 9)", "no triangle", "remove"});
}

TEST(Validation, DuplicateTriangleIsRefusedWhateverItsFirstCorner)
{
  TriangleMesh mesh = sheet();
  const auto t = mesh.triangles[1];
  mesh.triangles.push_back({t[1], t[2], t[0]});
  expect_all(refusal(mesh), {"triangle 8", "duplicate of triangle 1", "remove"});
}

TEST(Validation, EdgeOfThreeTrianglesIsRefused)
{
  TriangleMesh mesh = sheet();
  mesh.vertices.emplace_back(0.5, 0.5, 1);
  mesh.triangles.push_back({0, 4, 9});
  expect_all(refusal(mesh), {"3 triangles", "vertices 0 and 4", "(0.5, 0.5, 0)", "split"});
}

TEST(Validation, FlippedTriangleIsNamed)
{
  TriangleMesh mesh = sheet();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  expect_all(refusal(mesh), {"triangle 5", "flipped", "1 of 8", "reverse"});
}

TEST(Validation, SurfaceWithOneSideIsRefused)
{
  TriangleMesh band;
  constexpr int n = 12;
  for (int i = 0; i < n; ++i)
    for (const double s : {-0.3, 0.3}) {
      const double angle = 2 * M_PI * i / n;
      const double radius = 1 + s * std::cos(angle / 2);
      band.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), s * std::sin(angle / 2));
    }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    band.triangles.push_back({a, c, b});
    band.triangles.push_back({b, c, d});
  }
  expect_all(refusal(band), {"one side", "cut"});
}

}  // namespace
}  // namespace luff::surface
