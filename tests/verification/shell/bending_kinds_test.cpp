// SPDX-License-Identifier: BSD-3-Clause
// The three bending operators side by side: who is exact on quadratics, who is in equilibrium, where they agree.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shell/bending_operator.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::surface::Pattern;

constexpr int n = 16, rim = 4;

BendingOperator operator_on(const surface::TriangleMesh& mesh, BendingKind kind)
{
  Mat3 moduli;
  moduli << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  return bending_operator(kind, mesh, surface::topology(mesh), {}, moduli, "plate");
}

/// Away from the free edges, whose natural condition no constant curvature meets.
bool is_inner(const Vec3& X)
{
  const double margin = (rim - 0.5) / n;
  return X.head<2>().minCoeff() > margin && X.head<2>().maxCoeff() < 1 - margin;
}

/// Second derivatives in Voigt order (11, 22, 2.12) in the frame of a flat triangle.
Vec3 in_frame(const surface::TriangleMesh& mesh, int triangle, const Eigen::Matrix2d& second)
{
  const auto& corner = mesh.triangles[triangle];
  const Vec3 e1 = (mesh.vertices[corner[1]] - mesh.vertices[corner[0]]).normalized();
  Eigen::Matrix2d Q;
  Q << e1.x(), e1.y(), -e1.y(), e1.x();
  const Eigen::Matrix2d turned = Q * second * Q.transpose();
  return {turned(0, 0), turned(1, 1), 2 * turned(0, 1)};
}

/// Largest error of the inner curvatures of w = x' second x / 2, over the norm of `second`.
double curvature_error(const surface::TriangleMesh& mesh, BendingKind kind)
{
  const Eigen::Matrix2d second{{1, 0.3}, {0.3, -0.4}};
  const BendingOperator bending = operator_on(mesh, kind);
  double worst = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    if (!is_inner(surface::centroid(mesh, t)))
      continue;
    Vec3 kappa = Vec3::Zero();
    for (const StencilEntry& entry : bending.stencils[t]) {
      const Eigen::Vector2d X = mesh.vertices[entry.vertex].head<2>();
      kappa += entry.H * 0.5 * X.dot(second * X);
    }
    worst = std::max(worst, (kappa - in_frame(mesh, t, second)).norm() / second.norm());
  }
  return worst;
}

/// Largest force of constant moments M on inner vertices, sum over triangles of A H . M, over that on the others.
double unbalance(const surface::TriangleMesh& mesh, BendingKind kind)
{
  const Eigen::Matrix2d moments{{1, 0.3}, {0.3, -0.4}};
  const BendingOperator bending = operator_on(mesh, kind);
  std::vector<double> force(mesh.vertices.size(), 0);
  for (int t = 0; t < mesh.n_triangles(); ++t) {
    Vec3 M = in_frame(mesh, t, moments);
    M[2] /= 2;  // stresses have no factor two on the shear
    for (const StencilEntry& entry : bending.stencils[t])
      force[entry.vertex] += surface::area(mesh, t) * entry.H.dot(M);
  }
  double inner = 0, outer = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    double& largest = is_inner(mesh.vertices[v]) ? inner : outer;
    largest = std::max(largest, std::abs(force[v]));
  }
  return inner / outer;
}

surface::TriangleMesh irregular()
{
  return surface::rectangle({.divisions = {n, n}, .pattern = Pattern::Irregular, .displacement = 0.35, .seed = 5});
}

TEST(BendingKinds, AveragedQuadraticsAreExactOnQuadraticsAndInEquilibrium)
{
  EXPECT_LT(curvature_error(irregular(), BendingKind::AveragedQuadratics), 1e-11);
  EXPECT_LT(unbalance(irregular(), BendingKind::AveragedQuadratics), 1e-11);
}

TEST(BendingKinds, PatchQuadraticIsExactOnQuadraticsButOutOfEquilibrium)
{
  EXPECT_LT(curvature_error(irregular(), BendingKind::PatchQuadratic), 1e-11);
  EXPECT_GT(unbalance(irregular(), BendingKind::PatchQuadratic), 0.1);
}

TEST(BendingKinds, HingesAreInEquilibriumButNotExactOnQuadratics)
{
  EXPECT_GT(curvature_error(irregular(), BendingKind::Hinge), 0.1);
  EXPECT_LT(unbalance(irregular(), BendingKind::Hinge), 1e-11);
}

TEST(BendingKinds, AllAreExactAndInEquilibriumOnMeshesOfOneDiagonal)
{
  const surface::TriangleMesh mesh = surface::rectangle({.divisions = {n, n}, .pattern = Pattern::Diagonal});
  for (const BendingKind kind : {BendingKind::AveragedQuadratics, BendingKind::PatchQuadratic, BendingKind::Hinge}) {
    EXPECT_LT(curvature_error(mesh, kind), 1e-11) << static_cast<int>(kind);
    EXPECT_LT(unbalance(mesh, kind), 1e-11) << static_cast<int>(kind);
  }
}

TEST(BendingKinds, NarrowOperatorsSeeSixVerticesAtMost)
{
  for (const BendingKind kind : {BendingKind::PatchQuadratic, BendingKind::Hinge}) {
    std::size_t most = 0;
    for (const auto& stencil : operator_on(irregular(), kind).stencils)
      most = std::max(most, stencil.size());
    EXPECT_EQ(most, 6u);
  }
}

TEST(BendingKinds, WeightsVanishOnAffineMapsOfAFlatSheet)
{
  const surface::TriangleMesh mesh = irregular();
  for (const BendingKind kind : {BendingKind::PatchQuadratic, BendingKind::Hinge})
    for (const auto& stencil : operator_on(mesh, kind).stencils) {
      Vec3 sum = Vec3::Zero();
      Mat3 first = Mat3::Zero();
      double scale = 0;
      for (const StencilEntry& entry : stencil) {
        sum += entry.H;
        first += entry.H * mesh.vertices[entry.vertex].transpose();
        scale += entry.H.norm();
      }
      EXPECT_LT(sum.norm(), 1e-12 * scale);
      EXPECT_LT(first.norm(), 1e-12 * scale);
    }
}

}  // namespace
}  // namespace luff::shell
