// SPDX-License-Identifier: BSD-3-Clause
// Shells of nonlinear and fibrous materials: derivatives, frames of the triangles, a strip pulled along and across.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/bounding_box.hpp"
#include "shell/fibres.hpp"
#include "shell/shell.hpp"
#include "shell/statics.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::test::curved_sheet;
using luff::test::random_vector;
using luff::test::vertices_where;

const Vec3 grain(1, 0.4, 0.1);
const MayNewmanYin leaflet{.c0 = 0.399, .c1 = 4.325, .c2 = 1446.5, .c10 = 1};

Properties of(const Material& material, int thickness_points = 0)
{
  return {.thickness = 0.1, .density = 1, .material = material, .thickness_points = thickness_points};
}

Piece curved_piece(const Material& material, int thickness_points = 0)
{
  Piece piece{.reference = curved_sheet(), .properties = of(material, thickness_points)};
  piece.fibres = uniform_directions(piece.reference, grain);
  return piece;
}

Piece piece_with_every_edge(const Material& material, int thickness_points)
{
  Piece piece = curved_piece(material, thickness_points);
  const surface::TriangleMesh& mesh = piece.reference;
  const double end = bounding_box(mesh.vertices).high.x();
  piece.supports = {
      {.kind = SupportKind::Clamped, .vertices = vertices_where(mesh, [](auto& X) { return X.x() == 0; })},
      {.kind = SupportKind::Symmetry,
       .vertices = vertices_where(mesh, [](auto& X) { return X.y() == 0; }),
       .normal = Vec3::UnitY()},
      {.kind = SupportKind::Hinged,
       .vertices = vertices_where(mesh, [=](auto& X) { return X.x() == end && X.y() > 0.5; })}};
  return piece;
}

Eigen::VectorXd deformed(const Shell& shell)
{
  return shell.reference_positions() + 0.02 * random_vector(3 * shell.n_vertices(), 1);
}

const std::vector<Material>& materials()
{
  static const std::vector<Material> all{
      NeoHookean{.shear_modulus = 100}, leaflet, LeeSacks{.c0 = 10, .c1 = 2, .c2 = 9, .c3 = 9, .weight = 0.5},
      Fung{.c = 10, .A = Vec3(10, 8, 1.5).asDiagonal()},
      HolzapfelGasserOgden{.shear_modulus = 3, .k1 = 2.3, .k2 = 0.84, .dispersion = 0.1, .angle = 0.5}};
  return all;
}

TEST(ShellOfTissue, ForceAndTangentAreDerivativesOfTheEnergyForEveryLaw)
{
  for (const Material& material : materials()) {
    const Shell shell({piece_with_every_edge(material, 3)});
    const Eigen::VectorXd x = deformed(shell), d = random_vector(x.size(), 2);
    const double step = 1e-6;  // the exponentials' third derivatives are large
    const double slope = (shell.elastic_energy(x + step * d) - shell.elastic_energy(x - step * d)) / (2 * step);
    const double force_error = std::abs(slope / shell.internal_force(x).dot(d) - 1);
    BlockMatrix K(shell.pattern());
    shell.add_tangent(x, K);
    const Eigen::VectorXd slopes =
        (shell.internal_force(x + step * d) - shell.internal_force(x - step * d)) / (2 * step);
    const double tangent_error = (slopes - K * d).norm() / slopes.norm();
    const Eigen::MatrixXd full = K.dense();
    const double asymmetry = (full - full.transpose()).norm() / full.norm();
    EXPECT_LT(force_error, 1e-6) << material.index();
    EXPECT_LT(tangent_error, 1e-6) << material.index();
    EXPECT_LT(asymmetry, 1e-13) << material.index();
    std::printf("  law %zu: force %.1e, tangent %.1e, asymmetry %.1e\n", material.index(), force_error, tangent_error,
                asymmetry);
  }
}

TEST(ShellOfTissue, FirstCornerOfATriangleDoesNotMatter)
{
  const Piece piece = curved_piece(leaflet);
  Piece turned = piece;
  for (auto& corners : turned.reference.triangles)
    corners = {corners[1], corners[2], corners[0]};
  const Shell shell({piece}), same({turned});
  const Eigen::VectorXd x = deformed(shell);
  EXPECT_NEAR(same.elastic_energy(x) / shell.elastic_energy(x), 1, 1e-12);
  Piece without = turned;
  without.fibres.clear();
  EXPECT_GT(std::abs(Shell({without}).elastic_energy(x) / shell.elastic_energy(x) - 1), 1e-3);
}

TEST(ShellOfTissue, FibresTurnWithTheShell)
{
  const Piece piece = curved_piece(leaflet);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  Piece turned = piece;
  for (Vec3& X : turned.reference.vertices)
    X = R * X;
  turned.fibres = uniform_directions(turned.reference, R * grain);
  const Shell shell({piece}), same({turned});
  const Eigen::VectorXd x = deformed(shell);
  Eigen::VectorXd x_turned(x.size());
  for (int v = 0; v < shell.n_vertices(); ++v)
    x_turned.segment<3>(3 * v) = R * Vec3(x.segment<3>(3 * v));
  EXPECT_NEAR(same.elastic_energy(x_turned) / shell.elastic_energy(x), 1, 1e-12);
}

/// A square pulled along x by `pull` per width and thickness, free to narrow; in its plane.
struct Strip {
  explicit Strip(const Vec3& fibre)
  {
    Piece piece{.reference = test::sheet(1, 1, 6, 6), .properties = of(leaflet)};
    const surface::TriangleMesh& mesh = piece.reference;
    piece.fibres = uniform_directions(mesh, fibre);
    const auto everywhere = vertices_where(mesh, [](auto&) { return true; });
    const auto left = vertices_where(mesh, [](auto& X) { return X.x() == 0; });
    const auto below = vertices_where(mesh, [](auto& X) { return X.y() == 0; });
    const auto right = vertices_where(mesh, [](auto& X) { return X.x() == 1; });
    piece.supports = {
        {.kind = SupportKind::Fixed, .vertices = everywhere, .components = {false, false, true}},
        {.kind = SupportKind::Fixed, .vertices = left, .components = {true, false, false}},
        {.kind = SupportKind::Fixed, .vertices = below, .components = {false, true, false}},
    };
    const Shell shell({piece});
    const double force = pull * piece.properties.thickness;
    const Eigen::VectorXd x =
        solve_static(shell, {PointForce{right, [=](auto&, double) { return Vec3(force, 0, 0); }}}, {.steps = 5})
            .positions;
    const Eigen::Map<const Eigen::Matrix3Xd> points(x.data(), 3, shell.n_vertices());
    length = points.row(0).maxCoeff();
    width = points.row(1).maxCoeff();
  }

  static constexpr double pull = 4;
  double length = 0;
  double width = 0;
};

TEST(ShellOfTissue, StripPulledAlongOrAcrossItsFibresCarriesTheLawsStress)
{
  for (const Vec3& fibre : std::vector<Vec3>{Vec3::UnitX(), Vec3::UnitY()}) {
    const Strip strip(fibre);
    const Vec3 E((strip.length * strip.length - 1) / 2, (strip.width * strip.width - 1) / 2, 0);
    const Vec3 S = leaflet.stress(E, fibre.head<2>());
    EXPECT_NEAR(strip.length * S[0] / Strip::pull, 1, 1e-9);
    EXPECT_NEAR(S[1] / Strip::pull, 0, 1e-9);
  }
  const Strip along(Vec3::UnitX()), across(Vec3::UnitY());
  EXPECT_LT(along.length - 1, 0.5 * (across.length - 1));
  std::printf("  stretch along the fibre %.4f, across %.4f\n", along.length, across.length);
}

}  // namespace
}  // namespace luff::shell
