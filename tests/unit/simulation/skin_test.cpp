// SPDX-License-Identifier: BSD-3-Clause
// The skin of a shell: where it is, how it moves, what its forces do.
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/skin.hpp"
#include "surface/generators.hpp"
#include "surface/solid.hpp"
#include "surface/topology.hpp"

namespace luff::simulation {
namespace {

surface::MarkedMesh strip()
{
  return {surface::rectangle({.a = Vec3(2, 0, 0), .b = Vec3(0, 0.5, 0), .divisions = {6, 2}}),
          {.sets = {.vertices = {{"corner", {0}}}, .triangles = {{"first", {0}}}}}};
}

/// Some field of vectors, the same in every run.
std::vector<Vec3> waves(std::size_t count, double size, double phase)
{
  std::vector<Vec3> field;
  for (std::size_t n = 0; n < count; ++n)
    field.emplace_back(size * std::sin(1.7 * n + phase), size * std::cos(2.3 * n - phase), size * std::sin(3.1 * n));
  return field;
}

std::vector<Vec3> moved(std::vector<Vec3> x, const std::vector<Vec3>& v, double t)
{
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] += t * v[n];
  return x;
}

double power(const std::vector<Vec3>& force, const std::vector<Vec3>& velocity)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n)
    sum += force[n].dot(velocity[n]);
  return sum;
}

TEST(ASkin, EnclosesTheMaterialAndHasNoEdges)
{
  const Skin skin(strip(), 0.1, {});
  EXPECT_NEAR(surface::solid(skin.reference()).volume, 2 * 0.5 * 0.1, 1e-15);
  std::map<std::pair<int, int>, int> passes;
  for (const auto& t : skin.reference().triangles)
    for (int k = 0; k < 3; ++k)
      ++passes[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : passes) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(passes.count({edge.second, edge.first}), 1U);
  }
}

TEST(ASkin, KeepsTheThicknessOfAnArc)
{
  const double radius = 3.0;
  std::vector<Vec3> arc = strip().mesh.vertices;
  for (Vec3& x : arc)
    x = Vec3(radius * std::sin(x.x() / radius), x.y(), radius * (1 - std::cos(x.x() / radius)));
  const Skin skin(strip(), 0.1, {});
  const std::vector<Vec3> at = skin.positions(arc);
  const Vec3 centre(0, 0, radius);
  // Away from its ends, where the triangles beside a vertex lie on one side of it.
  for (int v = 0; v < skin.n_middle(); ++v) {
    const double x = strip().mesh.vertices[v].x();
    if (x < 0.1 || x > 1.9)
      continue;
    const auto distance = [&](const Vec3& p) { return std::hypot(p.x() - centre.x(), p.z() - centre.z()); };
    EXPECT_NEAR(distance(at[v]), radius - 0.05, 2e-4);
    EXPECT_NEAR(distance(at[skin.n_middle() + v]), radius + 0.05, 2e-4);
  }
}

TEST(ASkin, MovesAsItsPlaceChanges)
{
  const surface::MarkedMesh middle = strip();
  const Skin skin(middle, 0.1, {});
  const std::vector<Vec3> x = moved(middle.mesh.vertices, waves(middle.mesh.vertices.size(), 0.05, 0.3), 1.0);
  const std::vector<Vec3> v = waves(x.size(), 1.0, 1.1);
  const std::vector<Vec3> rates = skin.rates(x, v);
  const double dt = 1e-5;
  const std::vector<Vec3> before = skin.positions(moved(x, v, -dt));
  const std::vector<Vec3> after = skin.positions(moved(x, v, dt));
  for (std::size_t n = 0; n < rates.size(); ++n)
    EXPECT_LT((rates[n] - (after[n] - before[n]) / (2 * dt)).norm(), 1e-8) << n;
}

TEST(ASkin, ForcesDoTheSameWorkOnTheMiddleSurface)
{
  const surface::MarkedMesh middle = strip();
  const Skin skin(
      middle, 0.1,
      {{.vertex = 0, .plane = 0, .normal = Vec3(1, 0, 0)}, {.vertex = 1, .plane = 1, .normal = Vec3(0, 1, 0)}});
  const std::vector<Vec3> x = moved(middle.mesh.vertices, waves(middle.mesh.vertices.size(), 0.05, 0.3), 1.0);
  const std::vector<Vec3> on_skin = waves(skin.reference().vertices.size(), 2.0, 0.7);
  const std::vector<Vec3> on_middle = skin.forces(x, on_skin);
  for (const double phase : {0.0, 1.0, 2.0}) {
    const std::vector<Vec3> v = waves(x.size(), 1.0, phase);
    EXPECT_NEAR(power(on_middle, v), power(on_skin, skin.rates(x, v)), 1e-12);
  }
}

/// So that force and moment arrive whole, that of shear half a thickness off the middle included.
TEST(ASkin, TurnsAsARigidBodyWithItsMiddleSurface)
{
  const surface::MarkedMesh middle = strip();
  const Skin skin(middle, 0.1, {});
  const std::vector<Vec3> x = moved(middle.mesh.vertices, waves(middle.mesh.vertices.size(), 0.05, 0.3), 1.0);
  const Vec3 spin(0.3, -0.7, 0.5);
  std::vector<Vec3> v;
  for (const Vec3& place : x)
    v.push_back(spin.cross(place) + Vec3(1, 2, 3));
  const std::vector<Vec3> at = skin.positions(x);
  const std::vector<Vec3> rates = skin.rates(x, v);
  for (std::size_t n = 0; n < at.size(); ++n)
    EXPECT_LT((rates[n] - spin.cross(at[n]) - Vec3(1, 2, 3)).norm(), 1e-13);
}

TEST(ASkin, StaysOnAPlaneOfSymmetry)
{
  const surface::MarkedMesh middle = strip();
  std::vector<HeldNormal> held;
  std::vector<Vec3> x = middle.mesh.vertices;
  std::vector<Vec3> v = waves(x.size(), 1.0, 0.2);
  for (int n = 0; n < middle.mesh.n_vertices(); ++n) {
    x[n].z() += 0.2 * x[n].y() + 0.1 * x[n].x() * x[n].x();
    if (middle.mesh.vertices[n].y() == 0.0) {
      held.push_back({n, 0, Vec3(0, 1, 0)});
      v[n].y() = 0.0;
    }
  }
  const Skin skin(middle, 0.1, held);
  const std::vector<Vec3> at = skin.positions(x);
  const std::vector<Vec3> rates = skin.rates(x, v);
  for (const auto& [n, plane, normal] : held)
    for (const int face : {0, skin.n_middle()}) {
      EXPECT_NEAR(at[face + n].y(), 0.0, 1e-16);
      EXPECT_NEAR(rates[face + n].y(), 0.0, 1e-15);
      EXPECT_NEAR((at[face + n] - x[n]).norm(), 0.05, 1e-15);
    }
}

TEST(ASkin, IsOpenOnlyWhereItMeetsItsPlanesOfSymmetry)
{
  const surface::MarkedMesh slab{surface::rectangle({.a = Vec3(2, 0, 0), .b = Vec3(0, 0.5, 0), .divisions = {6, 1}}),
                                 {}};
  std::vector<HeldNormal> held;
  for (int n = 0; n < slab.mesh.n_vertices(); ++n)
    held.push_back({n, slab.mesh.vertices[n].y() > 0.25 ? 1 : 0, Vec3(0, 1, 0)});
  const surface::TriangleMesh skin = Skin(slab, 0.1, held).reference();
  const auto open = surface::topology(skin).boundary;
  EXPECT_EQ(open.size(), 2U * (2 * 6 + 2 * 2));  // both faces and the rims of both ends, on each plane
  for (const auto& [triangle, edge] : open) {
    const auto [a, b] = surface::edge_vertices(skin.triangles[triangle], edge);
    EXPECT_EQ(skin.vertices[a].y(), skin.vertices[b].y());
    EXPECT_TRUE(skin.vertices[a].y() == 0.0 || skin.vertices[a].y() == 0.5);
  }
}

TEST(ASkin, CarriesTheNamedPlacesOfItsMiddleSurface)
{
  const surface::MarkedMesh middle = strip();
  const Skin skin(middle, 0.1, {});
  const int faces = middle.mesh.n_triangles();
  const int n = skin.n_middle();
  EXPECT_EQ(skin.marks().sets.vertices.at("corner"), (std::vector<int>{0, n, 2 * n}));
  EXPECT_EQ(skin.marks().sets.triangles.at("first"), (std::vector<int>{0, faces}));
}

}  // namespace
}  // namespace luff::simulation
