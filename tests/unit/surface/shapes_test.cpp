// SPDX-License-Identifier: BSD-3-Clause
// Disks, annuli, cylinders and spheres are sound, lie on the exact surface, and approach its area.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "surface/generators.hpp"
#include "surface/topology.hpp"
#include "surface/validation.hpp"

namespace luff::surface {
namespace {

constexpr double pi = std::numbers::pi;
const Frame tilted{.centre = Vec3(1, -2, 0.5), .axis = Vec3(1, 2, 2), .start = Vec3(0, 1, 0)};
const Vec3 axis = tilted.axis / 3;

Vec3 from_axis(const Vec3& x)
{
  return x - tilted.centre - axis.dot(x - tilted.centre) * axis;
}

/// Angle about the axis from the start, in (-pi, pi].
double angle_of(const Vec3& x)
{
  const Vec3 start = (*tilted.start - axis.dot(*tilted.start) * axis).normalized();
  return std::atan2(axis.cross(start).dot(from_axis(x)), start.dot(from_axis(x)));
}

double height(const Vec3& x)
{
  return axis.dot(x - tilted.centre);
}

double polar_angle(const Vec3& x)
{
  return std::atan2(from_axis(x).norm(), height(x));
}

/// A shape of n parts, and what is known about the surface it stands for.
struct Known {
  std::string name;
  std::function<TriangleMesh(int n, Pattern, unsigned seed)> make;
  double area;
  int euler_characteristic;
  std::function<double(const Vec3&)> distance;            ///< from the surface
  std::function<Vec3(const Vec3&)> normal;                ///< on the side it must point to
  std::function<double(const Vec3&)> edge_distance = {};  ///< from the boundary; none: closed
  bool has_rings = false;
};

double nearest_of(std::initializer_list<double> distances)
{
  double least = 1e300;
  for (const double d : distances)
    least = std::min(least, std::abs(d));
  return least;
}

Known quarter_disk()
{
  return {"quarter disk",
          [](int n, Pattern p, unsigned seed) {
            return disk({.frame = tilted, .radius = 2, .angle = {-30, 60}, .rings = n, .pattern = p, .seed = seed});
          },
          pi,
          1,
          height,
          [](const Vec3&) { return axis; },
          [](const Vec3& x) {
            const double r = from_axis(x).norm();
            return nearest_of({r - 2, r * std::sin(angle_of(x) + pi / 6), r * std::sin(angle_of(x) - pi / 3)});
          },
          true};
}

Known whole_disk()
{
  return {"disk",
          [](int n, Pattern p, unsigned seed) {
            return disk({.frame = tilted, .radius = 2, .rings = n, .pattern = p, .seed = seed});
          },
          4 * pi,
          1,
          height,
          [](const Vec3&) { return axis; },
          [](const Vec3& x) { return from_axis(x).norm() - 2; },
          true};
}

Known whole_annulus()
{
  return {"annulus",
          [](int n, Pattern p, unsigned seed) {
            return annulus(
                {.frame = tilted, .inner_radius = 1, .radius = 2, .divisions = {8 * n, n}, .pattern = p, .seed = seed});
          },
          3 * pi,
          0,
          height,
          [](const Vec3&) { return axis; },
          [](const Vec3& x) {
            return nearest_of({from_axis(x).norm() - 1, from_axis(x).norm() - 2});
          }};
}

Known whole_cylinder()
{
  return {"cylinder",
          [](int n, Pattern p, unsigned seed) {
            return cylinder(
                {.frame = tilted, .radius = 2, .length = 3, .divisions = {6 * n, 2 * n}, .pattern = p, .seed = seed});
          },
          12 * pi,
          0,
          [](const Vec3& x) { return from_axis(x).norm() - 2; },
          from_axis,
          [](const Vec3& x) {
            return nearest_of({height(x), height(x) - 3});
          }};
}

Known eighth_cylinder()
{
  return {"part of a cylinder",
          [](int n, Pattern p, unsigned seed) {
            return cylinder({.frame = tilted,
                             .radius = 2,
                             .length = 3,
                             .angle = {0, 90},
                             .divisions = {2 * n, 2 * n},
                             .pattern = p,
                             .seed = seed});
          },
          3 * pi,
          1,
          [](const Vec3& x) { return from_axis(x).norm() - 2; },
          from_axis,
          [](const Vec3& x) {
            return nearest_of({height(x), height(x) - 3, 2 * angle_of(x), 2 * (angle_of(x) - pi / 2)});
          }};
}

/// Zone of the sphere of radius 2.
Known zone(const std::string& name, Sector polar, Sector angle, int euler_characteristic)
{
  Known known;
  known.name = name;
  known.make = [=](int n, Pattern p, unsigned seed) {
    return sphere_cap({.frame = tilted,
                       .radius = 2,
                       .polar = polar,
                       .angle = angle,
                       .rings = 2 * n,
                       .divisions = {2 * n * static_cast<int>(std::lround((angle.to - angle.from) / 90)), 2 * n},
                       .pattern = p,
                       .seed = seed});
  };
  known.area =
      4 * (angle.to - angle.from) * pi / 180 * (std::cos(polar.from * pi / 180) - std::cos(polar.to * pi / 180));
  known.euler_characteristic = euler_characteristic;
  known.distance = [](const Vec3& x) { return (x - tilted.centre).norm() - 2; };
  known.normal = [](const Vec3& x) { return Vec3(x - tilted.centre); };
  known.has_rings = has_pole({.polar = polar});
  if (polar.to - polar.from < 180)
    known.edge_distance = [=](const Vec3& x) {
      double least = nearest_of({polar_angle(x) - polar.from * pi / 180, polar_angle(x) - polar.to * pi / 180});
      if (angle.to - angle.from < 360)
        for (const double edge : {angle.from, angle.to})
          least = std::min(least, std::abs(from_axis(x).norm() * std::sin(angle_of(x) - edge * pi / 180)));
      return 2 * least;
    };
  return known;
}

std::vector<Known> all_shapes()
{
  return {quarter_disk(),
          whole_disk(),
          whole_annulus(),
          whole_cylinder(),
          eighth_cylinder(),
          zone("hemisphere", {0, 90}, {0, 360}, 1),
          zone("lower hemisphere", {90, 180}, {0, 360}, 1),
          zone("octant", {0, 90}, {0, 90}, 1),
          zone("more than half a sphere", {0, 130}, {0, 360}, 1),
          zone("sphere", {0, 180}, {0, 360}, 2),
          zone("hemisphere with a hole", {18, 90}, {0, 360}, 0),
          zone("its quarter", {18, 90}, {0, 90}, 1)};
}

std::vector<Pattern> patterns_of(const Known& known)
{
  if (known.has_rings)
    return {Pattern::Diagonal, Pattern::Irregular, Pattern::Delaunay};
  return {Pattern::Diagonal, Pattern::Alternating, Pattern::Irregular, Pattern::Delaunay};
}

std::vector<bool> on_boundary(const TriangleMesh& mesh)
{
  std::vector<bool> result(mesh.vertices.size(), false);
  for (const auto& [t, k] : topology(mesh).boundary) {
    const auto [a, b] = edge_vertices(mesh.triangles[t], k);
    result[a] = result[b] = true;
  }
  return result;
}

TEST(Shapes, EveryPatternIsSoundAndHasTheTopologyOfItsSurface)
{
  for (const Known& known : all_shapes())
    for (const Pattern pattern : patterns_of(known)) {
      const TriangleMesh mesh = known.make(4, pattern, 1);
      EXPECT_NO_THROW(validate(mesh, known.name));
      const int edges = static_cast<int>(edge_map(mesh).size());
      EXPECT_EQ(mesh.n_vertices() - edges + mesh.n_triangles(), known.euler_characteristic) << known.name;
      EXPECT_EQ(topology(mesh).boundary.empty(), !known.edge_distance) << known.name;
    }
}

TEST(Shapes, VerticesLieOnTheSurfaceAndThoseOfTheBoundaryOnItsEdges)
{
  for (const Known& known : all_shapes())
    for (const Pattern pattern : patterns_of(known)) {
      const TriangleMesh mesh = known.make(4, pattern, 1);
      const std::vector<bool> boundary = on_boundary(mesh);
      for (int v = 0; v < mesh.n_vertices(); ++v) {
        EXPECT_NEAR(known.distance(mesh.vertices[v]), 0, 1e-14 * 10) << known.name;
        if (boundary[v]) {
          EXPECT_NEAR(known.edge_distance(mesh.vertices[v]), 0, 1e-14 * 10) << known.name;
        }
      }
    }
}

TEST(Shapes, NormalsPointAlongTheAxisOrOutwards)
{
  for (const Known& known : all_shapes())
    for (const Pattern pattern : patterns_of(known)) {
      const TriangleMesh mesh = known.make(4, pattern, 1);
      for (int t = 0; t < mesh.n_triangles(); ++t)
        EXPECT_GT(unit_normal(mesh, t).dot(known.normal(centroid(mesh, t)).normalized()), 0.9) << known.name;
    }
}

TEST(Shapes, AreaApproachesTheSurfacesWithSecondOrder)
{
  for (const Known& known : all_shapes())
    for (const Pattern pattern : patterns_of(known)) {
      const double coarse = known.area - total_area(known.make(6, pattern, 1));
      const double fine = known.area - total_area(known.make(12, pattern, 1));
      EXPECT_GT(fine, 0) << known.name;
      EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << known.name << ", pattern " << int(pattern);
    }
}

TEST(Shapes, SameSeedGivesTheSameMeshAndAnotherSeedAnother)
{
  for (const Known& known : all_shapes())
    for (const Pattern pattern : {Pattern::Irregular, Pattern::Delaunay}) {
      const TriangleMesh mesh = known.make(3, pattern, 1);
      EXPECT_EQ(mesh.vertices, known.make(3, pattern, 1).vertices) << known.name;
      EXPECT_EQ(mesh.triangles, known.make(3, pattern, 1).triangles) << known.name;
      EXPECT_NE(mesh.vertices, known.make(3, pattern, 2).vertices) << known.name;
    }
}

/// 4 sqrt(3) area / (sum of squared sides): 1 for an equilateral triangle.
double worst_quality(const TriangleMesh& mesh)
{
  double worst = 1;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    double sides = 0;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = edge_vertices(mesh.triangles[t], k);
      sides += (mesh.vertices[a] - mesh.vertices[b]).squaredNorm();
    }
    worst = std::min(worst, 4 * std::sqrt(3) * area(mesh, t) / sides);
  }
  return worst;
}

/// Of the inner vertices, the share where six triangles meet.
double regular_share(const TriangleMesh& mesh)
{
  std::vector<int> triangles(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const int v : t)
      ++triangles[v];
  const std::vector<bool> boundary = on_boundary(mesh);
  int inner = 0, regular = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!boundary[v]) {
      ++inner;
      regular += triangles[v] == 6;
    }
  return double(regular) / inner;
}

TEST(Shapes, DelaunayPatternHasGoodTrianglesAndNoTraceOfRowsAndColumns)
{
  for (const unsigned seed : {1u, 2u, 3u})
    for (const TriangleMesh& mesh :
         {rectangle({.divisions = {24, 24}, .pattern = Pattern::Delaunay, .seed = seed}),
          whole_disk().make(12, Pattern::Delaunay, seed), whole_cylinder().make(8, Pattern::Delaunay, seed),
          zone("sphere", {0, 180}, {0, 360}, 2).make(8, Pattern::Delaunay, seed)}) {
      EXPECT_GT(worst_quality(mesh), 0.7);
      EXPECT_GT(regular_share(mesh), 0.35);
      EXPECT_LT(regular_share(mesh), 0.6);
    }
}

TEST(Shapes, WholeSphereIsTheOctahedronCutFiner)
{
  const TriangleMesh octahedron = sphere_cap({.polar = {0, 180}, .rings = 2});
  EXPECT_EQ(octahedron.n_vertices(), 6);
  EXPECT_EQ(octahedron.n_triangles(), 8);
  const TriangleMesh finer = sphere_cap({.polar = {0, 180}, .rings = 8});
  EXPECT_EQ(finer.n_vertices(), 4 * 16 + 2);
  EXPECT_EQ(finer.n_triangles(), 8 * 16);
}

TEST(Shapes, AnglesStartAtTheXAxisOrAtYWhereThatIsTheAxis)
{
  EXPECT_LT((cylinder({.angle = {0, 90}}).vertices[0] - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((cylinder({.frame = {.axis = Vec3(2, 0, 0)}, .angle = {0, 90}}).vertices[0] - Vec3(0, 1, 0)).norm(), 1e-15);
}

// Along the axis from spacing s to 8 s in 4 divisions: growth 8^(1/4) from one to the next; around by 1/8.
TEST(Shapes, GradedSpacingsGrowByAConstantFactor)
{
  for (const Pattern pattern : {Pattern::Diagonal, Pattern::Alternating, Pattern::Irregular}) {
    const TriangleMesh mesh =
        cylinder({.length = 2, .angle = {0, 90}, .divisions = {5, 4}, .grading = {0.125, 8}, .pattern = pattern});
    EXPECT_NO_THROW(validate(mesh, "cylinder"));
    for (int j = 1; j < 4; ++j) {
      const double before = mesh.vertices[j].z() - mesh.vertices[j - 1].z();
      const double after = mesh.vertices[j + 1].z() - mesh.vertices[j].z();
      EXPECT_NEAR(after / before, std::pow(8, 0.25), 1e-12);
    }
    EXPECT_NEAR(mesh.vertices[4].z(), 2, 1e-15);
    const auto angle = [&](int i) { return std::atan2(mesh.vertices[5 * i].y(), mesh.vertices[5 * i].x()); };
    for (int i = 1; i < 5; ++i)
      EXPECT_NEAR((angle(i + 1) - angle(i)) / (angle(i) - angle(i - 1)), std::pow(0.125, 0.2), 1e-12);
    EXPECT_NEAR(angle(5), std::numbers::pi / 2, 1e-15);
  }
  const TriangleMesh sheet = rectangle({.divisions = {2, 1}, .grading = {4, 1}});
  EXPECT_NEAR(sheet.vertices[2].x(), 1.0 / 3, 1e-15);
}

// From the far end, 90 degrees off the axis, to the near one.
TEST(Shapes, ZonesAreGradedFromTheirFarEnd)
{
  const TriangleMesh mesh = sphere_cap({.polar = {18, 90}, .angle = {0, 90}, .divisions = {3, 4}, .grading = {0.5, 8}});
  const auto polar = [&](int j) { return std::acos(mesh.vertices[j].z()); };
  EXPECT_NEAR(polar(0), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(polar(4), std::numbers::pi / 10, 1e-15);
  for (int j = 1; j < 4; ++j)
    EXPECT_NEAR((polar(j) - polar(j + 1)) / (polar(j - 1) - polar(j)), std::pow(8, 0.25), 1e-12);
  const auto angle = [&](int i) { return std::atan2(mesh.vertices[5 * i].y(), mesh.vertices[5 * i].x()); };
  EXPECT_NEAR((angle(2) - angle(1)) / angle(1), std::pow(0.5, 1.0 / 3), 1e-12);
}

TEST(Shapes, BadNumbersAreRefused)
{
  EXPECT_THROW(disk({.radius = 0}), InputError);
  EXPECT_THROW(disk({.rings = 0}), InputError);
  EXPECT_THROW(disk({.pattern = Pattern::Alternating}), InputError);
  EXPECT_THROW(disk({.frame = {.axis = Vec3::Zero()}}), InputError);
  EXPECT_THROW(disk({.frame = {.start = Vec3::UnitZ()}}), InputError);
  EXPECT_THROW(annulus({.inner_radius = 2, .radius = 1}), InputError);
  EXPECT_THROW(annulus({.divisions = {7, 2}, .pattern = Pattern::Alternating}), InputError);
  EXPECT_THROW(cylinder({.length = -1}), InputError);
  EXPECT_THROW(cylinder({.angle = {0, 400}}), InputError);
  EXPECT_THROW(cylinder({.angle = {90, 0}}), InputError);
  EXPECT_THROW(cylinder({.divisions = {2, 1}}), InputError);
  EXPECT_THROW(cylinder({.grading = {2, 1}}), InputError);  // around the whole circle
  EXPECT_THROW(cylinder({.grading = {1, 0}}), InputError);
  EXPECT_THROW(cylinder({.grading = {1, 2}, .pattern = Pattern::Delaunay}), InputError);
  EXPECT_THROW(cylinder({.divisions = {100000, 100000}}), InputError);
  EXPECT_THROW(sphere_cap({.polar = {20, 200}}), InputError);
  EXPECT_THROW(sphere_cap({.polar = {20, 90}, .grading = {2, 1}}), InputError);  // around the whole circle
  EXPECT_THROW(sphere_cap({.polar = {0, 180}, .rings = 1}), InputError);
}

}  // namespace
}  // namespace luff::surface
