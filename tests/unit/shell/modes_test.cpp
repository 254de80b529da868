// SPDX-License-Identifier: BSD-3-Clause
// The sparse eigensolver: against a dense one, on free shells, on multiple eigenvalues, and what it refuses.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "shell/modes.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties thin{.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1e6, 0.3}};

std::vector<Support> clamped_start(const surface::TriangleMesh& mesh)
{
  return {{.kind = SupportKind::Clamped, .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}};
}

/// |K phi - omega^2 M phi| on the free displacements, relative to |omega^2 M phi|.
double residual(const Shell& shell, const Modes& modes, int k)
{
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  const Eigen::VectorXd M_phi = modes.omega_squared[k] * shell.mass_times(modes.shapes.col(k));
  Eigen::VectorXd r = K * Eigen::VectorXd(modes.shapes.col(k)) - M_phi;
  shell.clear_held(r);
  return r.norm() / M_phi.norm();
}

TEST(Modes, AgreeWithADenseSolver)
{
  const surface::TriangleMesh mesh = test::curved_sheet(10, 9);
  const Shell shell(mesh, thin, clamped_start(mesh));
  const Modes modes = natural_modes(shell, 12);
  const Eigen::VectorXd dense = test::natural_frequencies(shell);
  for (int k = 0; k < modes.count(); ++k) {
    EXPECT_NEAR(modes.angular_frequency(k) / dense[k], 1, 1e-9) << "mode " << k + 1;
    EXPECT_LT(residual(shell, modes, k), 1e-6) << "mode " << k + 1;
  }
}

TEST(Modes, AreOrthonormalInTheMassAndZeroWhereHeld)
{
  const surface::TriangleMesh mesh = test::curved_sheet(10, 9);
  const Shell shell(mesh, thin, clamped_start(mesh));
  const Modes modes = natural_modes(shell, 12);
  for (int j = 0; j < modes.count(); ++j) {
    const Eigen::VectorXd M_phi = shell.mass_times(modes.shapes.col(j));
    for (int k = 0; k < modes.count(); ++k)
      EXPECT_NEAR(modes.shapes.col(k).dot(M_phi), j == k ? 1 : 0, 1e-9);
  }
  for (int i = 0; i < 3 * shell.n_vertices(); ++i) {
    if (shell.held()[i]) {
      EXPECT_EQ(modes.shapes.row(i).norm(), 0);
    }
  }
}

// Very thin, thin and thick; the rigid motions are one sixfold eigenvalue. Zero: round-off of the membrane's stiffness.
TEST(Modes, AFreeShellHasSixOfFrequencyZero)
{
  for (const double thickness : {1e-4, 1e-2, 0.2}) {
    Properties properties = thin;
    properties.thickness = thickness;
    const Shell shell(test::curved_sheet(12, 11), properties, {});
    const Modes modes = natural_modes(shell, 10);
    const Eigen::VectorXd dense = test::natural_frequencies(shell);
    const double rigid = std::sqrt(modes.omega_squared.head(6).cwiseAbs().maxCoeff());
    std::printf("  thickness %g: |omega_1..6| up to %.1e of omega_7, %.1e of the largest\n", thickness,
                rigid / modes.angular_frequency(6), rigid / dense.tail<1>()[0]);
    for (int k = 0; k < 6; ++k)
      EXPECT_LT(std::abs(modes.angular_frequency(k)), 1e-7 * dense.tail<1>()[0]);
    for (int k = 6; k < 10; ++k)
      EXPECT_NEAR(modes.angular_frequency(k) / dense[k], 1, 1e-6) << "mode " << k + 1;
  }
}

// A plate and its image under a quarter turn are the same: its second and third frequency, and others, coincide.
TEST(Modes, CopiesOfMultipleFrequenciesAreFound)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 10, 10, surface::Pattern::Alternating);
  const Shell plate(mesh, thin, {{.kind = SupportKind::Clamped, .vertices = test::outline(mesh, 1, 1)}});
  const Modes modes = natural_modes(plate, 9);
  const Eigen::VectorXd dense = test::natural_frequencies(plate);
  EXPECT_NEAR(dense[1] / dense[2], 1, 1e-9);
  for (int k = 0; k < modes.count(); ++k)
    EXPECT_NEAR(modes.angular_frequency(k) / dense[k], 1, 1e-9) << "mode " << k + 1;
}

TEST(Modes, MassSharesOfAllModesSumToTheMassThatMoves)
{
  const Shell shell(test::sheet(1, 0.5, 4, 3), thin, {});
  const Modes modes = natural_modes(shell, 3 * shell.n_vertices());
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < modes.count(); ++k)
    sum += modes.mass_share(shell, k);
  EXPECT_LT((sum - Vec3::Ones()).norm(), 1e-9);
}

TEST(Modes, DontDependOnUnits)
{
  const surface::TriangleMesh metres = test::curved_sheet(8, 7);
  surface::TriangleMesh micrometres = metres;
  for (Vec3& X : micrometres.vertices)
    X *= 1e6;
  const Properties small{.thickness = 1e4, .density = 1e-18, .material = SaintVenantKirchhoff{1e-6 * 1e6, 0.3}};
  const Modes a = natural_modes(Shell(metres, thin, {}), 9);
  const Modes b = natural_modes(Shell(micrometres, small, {}), 9);
  for (int k = 6; k < 9; ++k)
    EXPECT_NEAR(b.angular_frequency(k) / a.angular_frequency(k), 1, 1e-8);
}

// A strut pressed along by more than Euler's load has one direction in which it leaves its equilibrium.
TEST(Modes, TellAnUnstableStateByANegativeSquare)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.2, 20, 4);
  const Shell strut(mesh, thin, clamped_start(mesh));
  Eigen::VectorXd x = strut.reference_positions();
  const double pi = 3.14159265358979323846;
  const double euler_strain = std::pow(pi * thin.thickness / 2, 2) / 12;
  for (const double part : {0.5, 2.0}) {
    for (int v = 0; v < mesh.n_vertices(); ++v)
      x[3 * v] = (1 - part * euler_strain) * mesh.vertices[v].x();
    BlockMatrix K(strut.pattern());
    strut.add_tangent(x, K);
    const Modes modes = natural_modes(strut, K, 3);
    EXPECT_EQ(modes.omega_squared[0]<0, part> 1);
    EXPECT_GT(modes.omega_squared[1], 0);
  }
}

TEST(Modes, MoreThanThereAreUnknownsAreRefused)
{
  const surface::TriangleMesh mesh = test::sheet(1, 1, 2, 2);
  const Shell plate(mesh, thin, clamped_start(mesh), "plate");
  try {
    natural_modes(plate, 19);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "shell 'plate': modes = 19 must be from 1 to 18, the number of its free displacements");
  }
  EXPECT_EQ(natural_modes(plate, 18).count(), 18);
}

TEST(Modes, AShellWithoutMassIsRefused)
{
  Properties weightless = thin;
  weightless.density = 0;
  EXPECT_THROW(natural_modes(Shell(test::sheet(1, 1, 2, 2), weightless, {}), 1), InputError);
}

}  // namespace
}  // namespace luff::shell
