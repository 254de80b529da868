// SPDX-License-Identifier: BSD-3-Clause
// The curvature operator: zero on planes, few nodes, sound on degenerate patches, clear about hopeless ones.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "core/error.hpp"
#include "shell/shell.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties properties{.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1e6, 0.3}};

TEST(BendingOperator, WeightsVanishOnAffineMaps)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 6, 5);
  const Shell shell(mesh, properties, {});
  for (const Element& e : shell.elements()) {
    Vec3 sum = Vec3::Zero();
    Mat3 first = Mat3::Zero();
    for (int i = 0; i < e.n_nodes; ++i) {
      sum += e.H.col(i);
      first += e.H.col(i) * mesh.vertices[e.vertex[i]].transpose();
    }
    EXPECT_LT(sum.norm(), 1e-12 * e.H.norm());
    EXPECT_LT(first.norm(), 1e-12 * e.H.norm());
  }
}

/// A triangle and the three around it, its six vertices on a circle; a ring of eight more triangles around them.
surface::TriangleMesh hexagon_on_a_circle()
{
  surface::TriangleMesh mesh;
  for (const double radius : {1.0, 2.0})
    for (int i = 0; i < 6; ++i)
      mesh.vertices.emplace_back(radius * std::cos(i * M_PI / 3), radius * std::sin(i * M_PI / 3), 0);
  mesh.triangles = {{0, 2, 4}, {0, 1, 2}, {2, 3, 4}, {4, 5, 0}};
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, i + 6, j + 6});
    mesh.triangles.push_back({i, j + 6, j});
  }
  return mesh;
}

/// A triangle cut in three around a vertex in its middle, and a ring of six more triangles around it.
surface::TriangleMesh vertex_of_three_triangles()
{
  surface::TriangleMesh mesh;
  mesh.vertices.emplace_back(0.1, 0.2, 0);
  for (const double radius : {1.0, -3.0})
    for (int i = 0; i < 3; ++i)
      mesh.vertices.emplace_back(radius * std::cos(i * 2 * M_PI / 3), radius * std::sin(i * 2 * M_PI / 3), 0);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 6}, {3, 2, 4}, {1, 3, 5}, {1, 5, 6}, {2, 6, 4}, {3, 4, 5}};
  return mesh;
}

/// Energy for every deformation, none for rigid motions.
void expect_sound(const Shell& shell)
{
  const int n = shell.n_vertices();
  const Eigen::VectorXd moved = 0.1 * test::random_vector(3 * n, 3) + shell.reference_positions();
  EXPECT_GT(shell.elastic_energy(moved), 0);
  EXPECT_LT(shell.internal_force(shell.reference_positions()).norm(), 1e-13 * shell.internal_force(moved).norm());
  Eigen::VectorXd tilted = shell.reference_positions();
  for (int v = 0; v < n; ++v)
    tilted.segment<3>(3 * v) = Eigen::AngleAxisd(1.0, Vec3::UnitY()) * shell.reference().vertices[v];
  EXPECT_LT(shell.elastic_energy(tilted), 1e-24 * shell.elastic_energy(moved));
  const Eigen::VectorXd omega = test::natural_frequencies(shell);
  // Round-off of the eigenvalues is relative to the largest of them.
  EXPECT_LT(omega[5], 1e-7 * omega[omega.size() - 1]);
}

// Six vertices of one patch on a circle leave its quadratic undetermined.
TEST(BendingOperator, PatchOnAConicIsCountedAndStaysSound)
{
  const Shell shell(hexagon_on_a_circle(), properties, {});
  EXPECT_GT(shell.worst_conic(), 1e12);
  EXPECT_EQ(shell.worst_conic_triangle(), 0);
  EXPECT_EQ(shell.n_hinge_patches(), 1);
  expect_sound(shell);
}

TEST(BendingOperator, PatchOnAConicTakesItsNeighboursSlopesAndIsExactOnQuadratics)
{
  const surface::TriangleMesh mesh = hexagon_on_a_circle();
  const BendingOperator bending =
      bending_operator(BendingKind::AveragedQuadratics, mesh, surface::topology(mesh), {}, Mat3::Identity(), "shell");
  ASSERT_EQ(bending.n_replaced, 1);
  Vec3 kappa = Vec3::Zero();
  for (const StencilEntry& entry : bending.stencils[0]) {
    const Vec3 X = mesh.vertices[entry.vertex];
    kappa += entry.H * (0.5 * X.x() * X.x() - X.y() * X.y());
  }
  EXPECT_NEAR(kappa[0] + kappa[1], 1 - 2, 1e-12);                            // the trace
  EXPECT_NEAR(kappa[0] * kappa[1] - 0.25 * kappa[2] * kappa[2], -2, 1e-12);  // the determinant
}

TEST(BendingOperator, VertexOfThreeTrianglesIsCountedAndStaysSound)
{
  const Shell shell(vertex_of_three_triangles(), properties, {});
  EXPECT_GT(shell.worst_conic(), 1e12);
  EXPECT_EQ(shell.n_hinge_patches(), 3);
  expect_sound(shell);
}

TEST(BendingOperator, ReferenceFoldedByMoreThanARightAngleIsRefused)
{
  surface::TriangleMesh mesh = test::sheet(2, 1, 2, 1, surface::Pattern::Diagonal);
  for (Vec3& X : mesh.vertices)
    if (X.x() > 1)
      X = Vec3(0.5, X.y(), 0.8);
  try {
    const Shell shell(mesh, properties, {}, "flag");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 90 degrees"), std::string::npos) << error.what();
  }
}

TEST(BendingOperator, StencilReachesTheNeighboursOfTheNeighbours)
{
  const Shell shell(test::sheet(1, 1, 8, 8), properties, {});
  int full = 0;
  for (const Element& e : shell.elements()) {
    EXPECT_LE(e.n_nodes, 12);
    full += e.n_nodes == 12;
  }
  EXPECT_GT(full, 0);
}

}  // namespace
}  // namespace luff::shell
