// SPDX-License-Identifier: BSD-3-Clause
// The smoothed membrane strain against the constant one.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shell/shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

Properties properties(MembraneKind membrane)
{
  return {.thickness = 0.1, .density = 1, .material = SaintVenantKirchhoff{1e3, 0.3}, .membrane = membrane};
}

TEST(SmoothedMembrane, IsInEquilibriumUnderUniformFiniteStrainOnAnIrregularMesh)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 8, 8);
  const Shell shell(mesh, properties(MembraneKind::Smoothed), {});
  Mat3 F;
  F << 1.3, 0.2, 0, -0.1, 0.9, 0, 0, 0, 1;
  Eigen::VectorXd x = shell.reference_positions();
  for (int v = 0; v < mesh.n_vertices(); ++v)
    x.segment<3>(3 * v) = F * mesh.vertices[v];
  const Eigen::VectorXd f = shell.internal_force(x);
  const std::vector<int> rim = test::outline(mesh, 1, 1);
  double inner = 0, outer = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    double& largest = std::count(rim.begin(), rim.end(), v) > 0 ? outer : inner;
    largest = std::max(largest, f.segment<3>(3 * v).norm());
  }
  EXPECT_LT(inner, 1e-13 * outer);
}

TEST(SmoothedMembrane, StoresNoMoreThanTheConstantStrain)
{
  const surface::TriangleMesh mesh = test::curved_sheet();
  const Shell smoothed(mesh, properties(MembraneKind::Smoothed), {});
  const Shell constant(mesh, properties(MembraneKind::ConstantStrain), {});
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Eigen::VectorXd x = constant.reference_positions() + 0.05 * test::random_vector(3 * mesh.n_vertices(), seed);
    EXPECT_LT(smoothed.elastic_energy(x), constant.elastic_energy(x));
    EXPECT_GT(smoothed.elastic_energy(x), 0.3 * constant.elastic_energy(x));
  }
}

// Two triangles folded about their common edge: there the smoothed strain knows no bending.
TEST(SmoothedMembrane, IgnoresFoldsOfTheReferenceAndOfTheShell)
{
  surface::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0.1, 0}, {0.4, 0.8, 0.2}, {0.5, -0.7, 0.4}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  Properties membrane_only = properties(MembraneKind::Smoothed);
  membrane_only.thickness = 1e-8;
  const Shell shell(mesh, membrane_only, {});
  const Vec3 along = (mesh.vertices[1] - mesh.vertices[0]).normalized();
  Eigen::VectorXd folded = shell.reference_positions(), stretched = folded;
  folded.segment<3>(9) = Eigen::AngleAxisd(0.7, along) * mesh.vertices[3];
  stretched.segment<3>(9) = 1.01 * mesh.vertices[3];
  EXPECT_LT(shell.elastic_energy(folded), 1e-9 * shell.elastic_energy(stretched));
}

}  // namespace
}  // namespace luff::shell
