// SPDX-License-Identifier: BSD-3-Clause
// Loads add up to what they should, and their stiffness is their derivative.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/edge_turn.hpp"
#include "shell/edges.hpp"
#include "shell/loads.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties properties{
    .thickness = 0.1, .density = 3, .material = SaintVenantKirchhoff{1e3, 0.3}, .gravity = Vec3(0, 0, -2)};

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

// q = (1 + y, 2, 3 y) along an edge of length 1.1, in vertices at irregular distances.
TEST(Loads, LinearForcePerLengthGivesItsExactResultantAndMoment)
{
  surface::TriangleMesh mesh = test::sheet(1.2, 1.1, 5, 4);
  mesh.vertices[1].y() += 0.1;
  const std::vector<int> edge = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; });
  Properties weightless = properties;
  weightless.gravity.setZero();
  const Shell shell(mesh, weightless, {});
  const Loads loads(shell,
                    {EdgeForce{edge, [](const Vec3& X, double t) { return Vec3(t * Vec3(1 + X.y(), 2, 3 * X.y())); }}});
  const Eigen::VectorXd f = loads.at(2).force(shell.reference_positions());
  const double l = 1.1;
  EXPECT_LT((total(f) - 2 * Vec3(l + l * l / 2, 2 * l, 3 * l * l / 2)).norm(), 1e-14);
  double moment = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    moment += mesh.vertices[v].y() * f[3 * v + 2];
  EXPECT_NEAR(moment, 2 * l * l * l, 1e-14);
}

// Turned by 150 degrees and stretched, where atan2 is far from linear.
TEST(Loads, EdgeMomentHasTheTurnForPotentialAndItsExactStiffness)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const std::vector<int> edge = test::vertices_where(mesh, [](auto& X) { return X.y() == 0; });
  Properties weightless = properties;
  weightless.gravity.setZero();
  const Shell shell(mesh, weightless, {});
  const auto moment = [](const Vec3& X, double t) { return t * (2 + X.x()); };
  const LoadsAtTime loads = Loads(shell, {EdgeMoment{edge, moment}}).at(3);
  Eigen::VectorXd x = shell.reference_positions() + 0.03 * test::random_vector(3 * shell.n_vertices(), 1);
  const Mat3 turn = Eigen::AngleAxisd(150 * M_PI / 180, Vec3::UnitX()).toRotationMatrix();
  for (int v = 0; v < shell.n_vertices(); ++v)
    x.segment<3>(3 * v) = turn * Vec3(x.segment<3>(3 * v));
  const auto potential = [&](const Eigen::VectorXd& y) {
    double sum = 0;
    for (const surface::TriangleEdge side : boundary_edges(mesh, shell.topology(), edge)) {
      const EdgeTurn angle(mesh, side);
      const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
      sum += angle.length() * moment(0.5 * (mesh.vertices[a] + mesh.vertices[b]), 3) * angle.angle(y);
    }
    return sum;
  };
  const Eigen::VectorXd d = test::random_vector(x.size(), 2);
  const double step = 2e-6;
  const Eigen::VectorXd f = loads.force(x);
  EXPECT_NEAR((potential(x + step * d) - potential(x - step * d)) / (2 * step), f.dot(d), 1e-9 * f.norm() * d.norm());
  BlockMatrix K(shell.pattern());
  loads.subtract_stiffness(x, 1, K);
  const Eigen::VectorXd slope = (loads.force(x + step * d) - loads.force(x - step * d)) / (2 * step);
  EXPECT_LT((slope + K * d).norm(), 1e-9 * slope.norm());
  EXPECT_LT(total(f).norm(), 1e-14 * f.norm());
  EXPECT_EQ((K.dense() - K.dense().transpose()).norm(), 0);
}

// On a sheet with free edges the derivative of the pressure's force isn't symmetric; its symmetric part is what is
// kept.
TEST(Loads, PressureStiffnessIsTheSymmetricPartOfTheDerivative)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const Shell shell(mesh, properties, {});
  const LoadsAtTime loads =
      Loads(shell, {Pressure{{}, [](const Vec3& X, double t) { return t * (2.5 + X.x()); }}}).at(2);
  const Eigen::VectorXd x = shell.reference_positions() + 0.05 * test::random_vector(3 * shell.n_vertices(), 1);
  Eigen::MatrixXd derivative(x.size(), x.size());
  const double step = 1e-3;  // the force is quadratic in the positions: central differences are exact
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd d = step * Eigen::VectorXd::Unit(x.size(), i);
    derivative.col(i) = (loads.force(x + d) - loads.force(x - d)) / (2 * step);
  }
  BlockMatrix K(shell.pattern());
  loads.subtract_stiffness(x, 1, K);
  EXPECT_LT((K.dense() + 0.5 * (derivative + derivative.transpose())).norm(), 1e-11 * derivative.norm());
  EXPECT_GT((derivative - derivative.transpose()).norm(), 0.1 * derivative.norm());
  const Eigen::VectorXd v = test::random_vector(x.size(), 2);
  EXPECT_LT((loads.skew_stiffness_times(x, v) - 0.5 * (derivative - derivative.transpose()) * v).norm(),
            1e-11 * (derivative * v).norm());
}

TEST(Loads, NumbersOutOfRangeAreRefused)
{
  const Shell shell(test::sheet(1, 1, 2, 2), properties, {}, "flag");
  const VectorFunction up = [](const Vec3&, double) { return Vec3(0, 0, 1); };
  EXPECT_THROW(Loads(shell, {PointForce{{}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {PointForce{{9}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {Traction{{8}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {EdgeForce{{4}, up}}), InputError);
  EXPECT_THROW(Loads(shell, {EdgeMoment{{4, 5}, [](const Vec3&, double) { return 1.0; }}}), InputError);
}

}  // namespace
}  // namespace luff::shell
