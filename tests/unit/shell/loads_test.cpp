// SPDX-License-Identifier: BSD-3-Clause
// Loads add up to what they should, and their stiffness is their derivative.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/loads.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties properties{.thickness = 0.1, .density = 3, .young = 1e3, .poisson = 0.3, .gravity = Vec3(0, 0, -2)};

Vec3 total(const Eigen::VectorXd& nodal)
{
  return nodal.reshaped(3, nodal.size() / 3).rowwise().sum();
}

TEST(Loads, WeightTractionAndForceAddUp)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const double area = surface::total_area(mesh);
  const Shell shell(mesh, properties, {});
  const Eigen::VectorXd& X = shell.reference_positions();
  EXPECT_LT((total(Loads(shell, {}).at(0).force(X)) - Vec3(0, 0, -2 * 3 * 0.1 * area)).norm(), 1e-13);
  const Vec3 weight = total(Loads(shell, {}).at(0).force(X));
  const Loads traction(shell, {Traction{{}, [](const Vec3&, double t) { return Vec3(t, 2, 3); }}});
  EXPECT_LT((total(traction.at(5).force(X)) - weight - area * Vec3(5, 2, 3)).norm(), 1e-12);
  const std::vector<int> edge = test::vertices_where(mesh, [](auto& x) { return x.x() == 0; });
  const Loads force(shell, {PointForce{edge, [](const Vec3&, double) { return Vec3(1, 2, 3); }}});
  EXPECT_LT((total(force.at(0).force(X)) - weight - Vec3(1, 2, 3)).norm(), 1e-13);
}

TEST(Loads, EdgeForceIsSharedByLength)
{
  surface::TriangleMesh mesh = test::sheet(1, 1, 2, 2, surface::Pattern::Diagonal);
  mesh.vertices[1].y() = 0.25;  // on the edge x = 0 between y = 0 and 1
  Properties weightless = properties;
  weightless.gravity.setZero();
  const Shell shell(mesh, weightless, {});
  const Loads loads(shell, {PointForce{{0, 1, 2}, [](const Vec3&, double) { return Vec3(0, 0, 8); }}});
  const Eigen::VectorXd f = loads.at(0).force(shell.reference_positions());
  EXPECT_DOUBLE_EQ(f[2], 1);
  EXPECT_DOUBLE_EQ(f[5], 4);
  EXPECT_DOUBLE_EQ(f[8], 3);
}

// On a closed surface a uniform pressure has a potential, so that its stiffness is symmetric and complete.
TEST(Loads, PressureStiffnessOfAClosedSurfaceIsTheDerivativeOfItsForce)
{
  surface::TriangleMesh octahedron;
  for (const double sign : {1.0, -1.0})
    for (int axis = 0; axis < 3; ++axis)
      octahedron.vertices.emplace_back(sign * Vec3::Unit(axis));
  octahedron.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  // Twice refined towards a sphere, so that neighbouring triangles meet at small angles.
  for (int level = 0; level < 2; ++level) {
    surface::TriangleMesh fine{octahedron.vertices, {}};
    std::map<surface::EdgeKey, int> middle;
    for (const auto& [key, sides] : surface::edge_map(octahedron)) {
      middle[key] = fine.n_vertices();
      fine.vertices.push_back((fine.vertices[key.first] + fine.vertices[key.second]).normalized());
    }
    for (const auto& [a, b, c] : octahedron.triangles) {
      const int ab = middle[surface::edge_key(a, b)], bc = middle[surface::edge_key(b, c)],
                ca = middle[surface::edge_key(c, a)];
      for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        fine.triangles.push_back(t);
    }
    octahedron = fine;
  }
  Properties weightless = properties;
  weightless.gravity.setZero();
  const Shell balloon(octahedron, weightless, {});
  const Loads loads(balloon, {Pressure{{}, [](const Vec3&, double) { return 2.5; }}});
  const Eigen::VectorXd x = balloon.reference_positions() + 0.05 * test::random_vector(3 * balloon.n_vertices(), 1);
  const Eigen::VectorXd d = test::random_vector(x.size(), 2);
  BlockMatrix K(balloon.pattern());
  loads.at(0).subtract_stiffness(x, 1, K);
  const double step = 1e-6;
  const Eigen::VectorXd slope = (loads.at(0).force(x + step * d) - loads.at(0).force(x - step * d)) / (2 * step);
  EXPECT_LT((slope + K * d).norm(), 1e-9 * slope.norm());
  EXPECT_LT(total(loads.at(0).force(x)).norm(), 1e-12 * loads.at(0).force(x).norm());
}

TEST(Loads, NumbersOutOfRangeAreRefused)
{
  const Shell shell(test::sheet(1, 1, 2, 2), properties, {}, "flag");
  const VectorFunction up = [](const Vec3&, double) { return Vec3(0, 0, 1); };
  EXPECT_THROW(Loads(shell, {PointForce{{}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {PointForce{{9}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {Traction{{8}, up}}), InputError);
}

}  // namespace
}  // namespace luff::shell
