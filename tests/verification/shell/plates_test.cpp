// SPDX-License-Identifier: BSD-3-Clause
// Small deflections of plates: constant curvature, simply supported under uniform load, vibrations.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shell/shell.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::surface::Pattern;
using std::numbers::pi;

const Properties thin{.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1e6, 0.3}};

double bending_stiffness(const Properties& p)
{
  return reference_moduli(p.material)(0, 0) * std::pow(p.thickness, 3) / 12;
}

std::vector<int> all_vertices(const surface::TriangleMesh& mesh)
{
  return test::vertices_where(mesh, [](const Vec3&) { return true; });
}

/// Unit square, only vertical displacements, zero on the outline.
Shell simply_supported(const surface::TriangleMesh& mesh)
{
  return Shell(
      mesh, thin,
      {{.kind = SupportKind::Fixed, .vertices = all_vertices(mesh), .components = {true, true, false}},
       {.kind = SupportKind::Fixed, .vertices = test::outline(mesh, 1, 1), .components = {false, false, true}}});
}

/// Navier's series for the integral of the deflection times D/q [timoshenko_1959_theory], section 30.
double exact_volume()
{
  double sum = 0;
  for (int m = 199; m >= 1; m -= 2)
    for (int n = 199; n >= 1; n -= 2)
      sum += 64 / (std::pow(pi, 8) * m * m * n * n * std::pow(m * m + n * n, 2));
  return sum;
}

/// Relative error of the volume under a uniformly loaded simply supported plate.
double volume_error(Pattern pattern, int n, unsigned seed = 7)
{
  const Shell plate = simply_supported(test::sheet(1, 1, n, n, pattern, seed));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * plate.n_vertices());
  for (const Element& e : plate.elements())
    for (int i = 0; i < 3; ++i)
      f[3 * e.vertex[i] + 2] += e.area / 3;
  const double volume = f.dot(test::linear_displacement(plate, f)) * bending_stiffness(thin);
  return volume / exact_volume() - 1;
}

// The union-jack pattern is the worst case of curvature from patches: operators without both consistency and
// equilibrium stay 30 to 70 % wrong on it however fine it is.
TEST(Plates, SimplySupportedPlateOfAlternatingTrianglesIsRight)
{
  const double error = volume_error(Pattern::Alternating, 16);
  std::printf("  alternating, n = 16: %+.3f %%\n", 100 * error);
  EXPECT_LT(std::abs(error), 0.005);
}

TEST(Plates, SimplySupportedPlateOfIrregularTrianglesIsRight)
{
  for (const unsigned seed : {1u, 2u, 7u}) {
    const double error = volume_error(Pattern::Irregular, 32, seed);
    std::printf("  irregular, n = 32, seed %u: %+.3f %%\n", seed, 100 * error);
    EXPECT_LT(std::abs(error), 0.003);
  }
}

// Between 8 and 64 divisions; from one mesh to the next the order moves between 1.86 and 2.3 because errors of both
// signs cancel in part.
TEST(Plates, DeflectionConvergesWithSecondOrder)
{
  for (const Pattern pattern : {Pattern::Diagonal, Pattern::Alternating}) {
    const double coarse = volume_error(pattern, 8), fine = volume_error(pattern, 64);
    const double order = test::observed_order(coarse, fine) / 3;
    std::printf("  pattern %d: errors %+.4f %% and %+.4f %%, order %.2f\n", static_cast<int>(pattern), 100 * coarse,
                100 * fine, order);
    EXPECT_GT(order, 1.9);
  }
}

// Root mean square over three meshes. Measured 1.88 and 1.81; it was 0.9 while the twist was spoilt at the edges.
TEST(Plates, DeflectionConvergesWithSecondOrderOnRandomMeshes)
{
  for (const Pattern pattern : {Pattern::Irregular, Pattern::Delaunay}) {
    const auto error = [&](int n) {
      double sum = 0;
      for (const unsigned seed : {1u, 2u, 3u})
        sum += std::pow(volume_error(pattern, n, seed), 2);
      return std::sqrt(sum / 3);
    };
    const double coarse = error(8), fine = error(32), order = test::observed_order(coarse, fine) / 2;
    std::printf("  pattern %d: errors %.4f %% and %.4f %%, order %.2f\n", static_cast<int>(pattern), 100 * coarse,
                100 * fine, order);
    EXPECT_GT(order, 1.7);
    EXPECT_LT(fine, 0.001);
  }
}

// The deflection of a quadratic w on an irregular mesh: every curvature is exact away from the boundary, and the forces
// of constant moments cancel there, although no two triangles are alike.
TEST(Plates, PassesTheConstantCurvaturePatchTest)
{
  constexpr int n = 16, rim = 4;
  const surface::TriangleMesh mesh =
      surface::rectangle({.divisions = {n, n}, .pattern = Pattern::Irregular, .displacement = 0.35, .seed = 5});
  const Shell plate(mesh, thin, {});
  // Small enough that the membrane strains, quadratic in w, vanish against the bending.
  constexpr double amplitude = 1e-5;
  Eigen::VectorXd x = plate.reference_positions();
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const Vec3 X = mesh.vertices[v];
    x[3 * v + 2] = amplitude * (0.5 * X.x() * X.x() + 0.3 * X.x() * X.y() - 0.2 * X.y() * X.y());
  }
  const auto inside = [&](const Vec3& X) {
    const double margin = (rim - 0.5) / n;
    return X.head<2>().minCoeff() > margin && X.head<2>().maxCoeff() < 1 - margin;
  };
  double curvature_error = 0;
  for (const Element& e : plate.elements()) {
    if (!inside(mesh.vertices[e.vertex[0]]))
      continue;
    Vec3 kappa = Vec3::Zero();
    for (int i = 0; i < e.n_nodes; ++i)
      kappa += e.H.col(i) * x[3 * e.vertex[i] + 2] / amplitude;
    const Vec3 e1 = (mesh.vertices[e.vertex[1]] - mesh.vertices[e.vertex[0]]).normalized();
    Eigen::Matrix2d exact, Q;
    exact << 1, 0.3, 0.3, -0.4;
    Q << e1.x(), e1.y(), -e1.y(), e1.x();
    exact = (Q * exact * Q.transpose()).eval();
    curvature_error = std::max(curvature_error, (kappa - Vec3(exact(0, 0), exact(1, 1), 2 * exact(0, 1))).norm());
  }
  const Eigen::VectorXd f = plate.internal_force(x);
  double interior = 0, boundary = 0;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    (inside(mesh.vertices[v]) ? interior : boundary) =
        std::max(inside(mesh.vertices[v]) ? interior : boundary, std::abs(f[3 * v + 2]));
  std::printf("  curvature error %.1e, interior force over boundary force %.1e\n", curvature_error,
              interior / boundary);
  EXPECT_LT(curvature_error, 1e-11);
  EXPECT_LT(interior, 1e-6 * boundary);
}

// w = c x y has no moment across the edges of a square plate, only twist. Kirchhoff's plate holds it by four forces at
// the corners, 2 M_xy = 2 D (1 - nu) c, whatever the mesh: a natural condition that spoils the twist spoils this.
TEST(Plates, UniformTwistIsExactUpToFreeEdgesAndHeldByItsCorners)
{
  for (const Pattern pattern : {Pattern::Irregular, Pattern::Delaunay}) {
    const surface::TriangleMesh mesh = test::sheet(1, 1, 12, 12, pattern);
    const Shell plate(mesh, thin, {});
    constexpr double c = 1e-5;  // small enough that the membrane strains, quadratic in w, vanish against the bending
    Eigen::VectorXd x = plate.reference_positions();
    for (int v = 0; v < mesh.n_vertices(); ++v)
      x[3 * v + 2] = c * mesh.vertices[v].x() * mesh.vertices[v].y();
    double curvature_error = 0;
    for (const Element& e : plate.elements()) {
      Vec3 kappa = Vec3::Zero();
      for (int i = 0; i < e.n_nodes; ++i)
        kappa += e.H.col(i) * x[3 * e.vertex[i] + 2] / c;
      const Vec3 e1 = (mesh.vertices[e.vertex[1]] - mesh.vertices[e.vertex[0]]).normalized();
      const double cos = e1.x(), sin = e1.y();
      const Vec3 exact(2 * cos * sin, -2 * cos * sin, 2 * (cos * cos - sin * sin));
      curvature_error = std::max(curvature_error, (kappa - exact).norm());
    }
    const Eigen::VectorXd f = plate.internal_force(x);
    const double corner = 2 * bending_stiffness(thin) * (1 - 0.3) * c;
    double corner_error = 0, elsewhere = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
      const Vec3& X = mesh.vertices[v];
      const bool at_corner = (X.x() == 0 || X.x() == 1) && (X.y() == 0 || X.y() == 1);
      const double expected = at_corner ? (X.x() == X.y() ? corner : -corner) : 0;
      double& error = at_corner ? corner_error : elsewhere;
      error = std::max(error, std::abs(f[3 * v + 2] - expected) / corner);
    }
    std::printf("  curvature error %.1e; force at corners %.1e, elsewhere %.1e of the corner's\n", curvature_error,
                corner_error, elsewhere);
    EXPECT_LT(curvature_error, 1e-10);
    EXPECT_LT(corner_error, 1e-6);
    EXPECT_LT(elsewhere, 1e-6);
  }
}

TEST(Plates, SimplySupportedPlateVibratesAtTheExactFrequencies)
{
  const Shell plate = simply_supported(test::sheet(1, 1, 14, 14));
  const Eigen::VectorXd omega = test::natural_frequencies(plate);
  const double unit = pi * pi * std::sqrt(bending_stiffness(thin) / thin.mass_per_area());
  const double exact[] = {2, 5, 5, 8};
  for (int mode = 0; mode < 4; ++mode) {
    const double error = omega[mode] / (exact[mode] * unit) - 1;
    std::printf("  mode %d: %+.2f %%\n", mode + 1, 100 * error);
    EXPECT_LT(std::abs(error), 0.006);
  }
}

TEST(Plates, CantileverVibratesAtEulerBernoullisFrequency)
{
  Properties strip = thin;
  strip.material = SaintVenantKirchhoff{1e6, 0};
  const surface::TriangleMesh mesh = test::sheet(1, 0.2, 14, 2);
  const Shell cantilever(
      mesh, strip,
      {{.kind = SupportKind::Clamped, .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}});
  const double beta = 1.8751040687;
  const double exact = beta * beta * std::sqrt(bending_stiffness(strip) / strip.mass_per_area());
  const double error = test::natural_frequencies(cantilever)[0] / exact - 1;
  std::printf("  first bending frequency: %+.3f %%\n", 100 * error);
  EXPECT_LT(std::abs(error), 0.005);
}

}  // namespace
}  // namespace luff::shell
