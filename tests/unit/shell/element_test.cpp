// SPDX-License-Identifier: BSD-3-Clause
// Energy, force and tangent of the shell against each other and under rigid motions.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/bounding_box.hpp"
#include "shell/shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::test::curved_sheet;
using luff::test::random_vector;
using luff::test::vertices_where;

/// A section, a bending operator and a membrane strain.
struct Make {
  const char* name;
  Properties properties;
};

Properties soft(const Material& material, BendingKind bending, MembraneKind membrane)
{
  return {.thickness = 0.1, .density = 1, .material = material, .bending = bending, .membrane = membrane};
}

const SaintVenantKirchhoff linear{1e3, 0.3};
const NeoHookean rubber{400};
const Make makes[] = {
    {"AveragedQuadratics", soft(linear, BendingKind::AveragedQuadratics, MembraneKind::ConstantStrain)},
    {"PatchQuadratic", soft(linear, BendingKind::PatchQuadratic, MembraneKind::ConstantStrain)},
    {"Hinge", soft(linear, BendingKind::Hinge, MembraneKind::ConstantStrain)},
    {"Smoothed", soft(linear, BendingKind::AveragedQuadratics, MembraneKind::Smoothed)},
    {"SmoothedPatchQuadratic", soft(linear, BendingKind::PatchQuadratic, MembraneKind::Smoothed)},
    {"Hencky", soft(Hencky{1e3, 0.3}, BendingKind::AveragedQuadratics, MembraneKind::ConstantStrain)},
    {"NeoHookean", soft(rubber, BendingKind::AveragedQuadratics, MembraneKind::ConstantStrain)},
    {"SmoothedNeoHookean", soft(rubber, BendingKind::AveragedQuadratics, MembraneKind::Smoothed)},
};

class ShellElement : public testing::TestWithParam<Make> {};
INSTANTIATE_TEST_SUITE_P(OfAnyMake, ShellElement, testing::ValuesIn(makes),
                         [](const auto& test) { return test.param.name; });

/// Clamped at x = 0, symmetric at y = 0, hinged along part of x = max, free elsewhere: every kind of edge, and corners
/// where two of them meet.
Shell shell_with_every_edge(const Properties& properties)
{
  const surface::TriangleMesh mesh = curved_sheet();
  const double end = bounding_box(mesh.vertices).high.x();
  return Shell(mesh, properties,
               {{.kind = SupportKind::Clamped, .vertices = vertices_where(mesh, [](auto& X) { return X.x() == 0; })},
                {.kind = SupportKind::Symmetry,
                 .vertices = vertices_where(mesh, [](auto& X) { return X.y() == 0; }),
                 .normal = Vec3::UnitY()},
                {.kind = SupportKind::Hinged,
                 .vertices = vertices_where(mesh, [=](auto& X) { return X.x() == end && X.y() > 0.5; })}});
}

Eigen::VectorXd deformed(const Shell& shell)
{
  return shell.reference_positions() + 0.05 * random_vector(3 * shell.n_vertices(), 1);
}

TEST_P(ShellElement, ReferenceIsFreeOfForce)
{
  const Shell shell = shell_with_every_edge(GetParam().properties);
  const Eigen::VectorXd scale = shell.internal_force(deformed(shell));
  EXPECT_LT(shell.internal_force(shell.reference_positions()).norm(), 1e-13 * scale.norm());
}

TEST_P(ShellElement, ForceIsTheGradientOfTheEnergy)
{
  const Shell shell = shell_with_every_edge(GetParam().properties);
  const Eigen::VectorXd x = deformed(shell), d = random_vector(x.size(), 2);
  const double step = 1e-5;
  const double slope = (shell.elastic_energy(x + step * d) - shell.elastic_energy(x - step * d)) / (2 * step);
  const double error = std::abs(slope / shell.internal_force(x).dot(d) - 1);
  RecordProperty("relative_error", std::to_string(error));
  EXPECT_LT(error, 1e-6);
}

TEST_P(ShellElement, TangentIsTheGradientOfTheForce)
{
  const Shell shell = shell_with_every_edge(GetParam().properties);
  const Eigen::VectorXd x = deformed(shell), d = random_vector(x.size(), 2);
  BlockMatrix K(shell.pattern());
  shell.add_tangent(x, K);
  const double step = 1e-5;
  const Eigen::VectorXd slope = (shell.internal_force(x + step * d) - shell.internal_force(x - step * d)) / (2 * step);
  EXPECT_LT((slope - K * d).norm(), 1e-6 * slope.norm());
  std::printf("  tangent against differences: %.1e\n", (slope - K * d).norm() / slope.norm());
}

TEST_P(ShellElement, TangentIsSymmetric)
{
  const Shell shell = shell_with_every_edge(GetParam().properties);
  BlockMatrix K(shell.pattern());
  shell.add_tangent(deformed(shell), K);
  const Eigen::MatrixXd full = K.dense();
  EXPECT_LT((full - full.transpose()).norm(), 1e-13 * full.norm());
  std::printf("  asymmetry: %.1e\n", (full - full.transpose()).norm() / full.norm());
}

TEST_P(ShellElement, EnergyAndForceTurnWithTheShell)
{
  const Shell shell(curved_sheet(), GetParam().properties, {});
  const Eigen::VectorXd x = deformed(shell);
  const Eigen::AngleAxisd R(1.234, Vec3(1, 2, -0.5).normalized());
  const auto moved = [&](const Eigen::VectorXd& y) {
    Eigen::VectorXd z(y.size());
    for (int v = 0; v < shell.n_vertices(); ++v)
      z.segment<3>(3 * v) = R * Vec3(y.segment<3>(3 * v)) + Vec3(3, -2, 5);
    return z;
  };
  const Eigen::VectorXd f = shell.internal_force(x), f_moved = shell.internal_force(moved(x));
  double difference = 0;
  Vec3 total = Vec3::Zero(), moment = Vec3::Zero();
  for (int v = 0; v < shell.n_vertices(); ++v) {
    const Vec3 fv = f.segment<3>(3 * v);
    difference = std::max(difference, (f_moved.segment<3>(3 * v) - R * fv).norm());
    total += fv;
    moment += Vec3(x.segment<3>(3 * v)).cross(fv);
  }
  EXPECT_LT(std::abs(shell.elastic_energy(moved(x)) / shell.elastic_energy(x) - 1), 1e-12);
  EXPECT_LT(difference, 1e-12 * f.norm());
  EXPECT_LT(total.norm(), 1e-12 * f.norm());
  EXPECT_LT(moment.norm(), 1e-12 * f.norm());
  EXPECT_LT(shell.elastic_energy(moved(shell.reference_positions())), 1e-24 * shell.elastic_energy(x));
}

TEST_P(ShellElement, FreeCurvedShellHasExactlySixZeroModes)
{
  const Shell shell(curved_sheet(), GetParam().properties, {});
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K.dense()).eigenvalues();
  const double largest = eigenvalues[eigenvalues.size() - 1];
  EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-12 * largest);
  EXPECT_GT(eigenvalues[6], 1e-6 * largest);
}

TEST_P(ShellElement, MaterialStiffnessIsSemiDefiniteAndIgnoresRigidMotions)
{
  const Shell shell(curved_sheet(), GetParam().properties, {});
  const Eigen::VectorXd x = deformed(shell);
  BlockMatrix K(shell.pattern());
  shell.add_material_stiffness(x, K);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K.dense()).eigenvalues();
  EXPECT_GT(eigenvalues[0], -1e-12 * eigenvalues[eigenvalues.size() - 1]);
  Eigen::VectorXd spin(x.size());
  for (int v = 0; v < shell.n_vertices(); ++v)
    spin.segment<3>(3 * v) = Vec3(0.3, -1, 2).cross(Vec3(x.segment<3>(3 * v))) + Vec3(1, 2, 3);
  EXPECT_LT((K * spin).norm(), 1e-12 * eigenvalues[eigenvalues.size() - 1] * spin.norm());
}

}  // namespace
}  // namespace luff::shell
