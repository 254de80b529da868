// SPDX-License-Identifier: BSD-3-Clause
// A closed neo-Hookean balloon under a pressure that follows it, against the theory of thin membranes.
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "shell/statics.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

constexpr double mu = 100;
constexpr double thickness = 0.01;

/// An octahedron whose triangles are cut into four `levels` times, the vertices put on the unit sphere.
surface::TriangleMesh octasphere(int levels)
{
  surface::TriangleMesh mesh{
      {Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ()},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), mesh.n_vertices());
      if (is_new)
        mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// Vertices moved at random by up to a quarter of the mesh's spacing, all but the first six, which supports hold.
surface::TriangleMesh shuffled(surface::TriangleMesh mesh)
{
  const double spacing = std::sqrt(4 * std::numbers::pi / mesh.n_vertices());
  const Eigen::VectorXd moves = test::random_vector(3 * mesh.n_vertices(), 11);
  for (int v = 6; v < mesh.n_vertices(); ++v)
    mesh.vertices[v] = (mesh.vertices[v] + 0.25 * spacing * Vec3(moves.segment<3>(3 * v))).normalized();
  return mesh;
}

double volume(const surface::TriangleMesh& mesh, const Eigen::VectorXd& x)
{
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += Vec3(x.segment<3>(3 * a)).dot(Vec3(x.segment<3>(3 * b)).cross(Vec3(x.segment<3>(3 * c)))) / 6;
  return sum;
}

/// The six rigid motions held by what symmetry keeps at rest anyway: the poles stay on the z axis, a vertex of the
/// equator on the x axis.
std::vector<Support> no_rigid_motion()
{
  return {{.kind = SupportKind::Fixed, .vertices = {4, 5}, .components = {true, true, false}},
          {.kind = SupportKind::Fixed, .vertices = {0}, .components = {false, true, true}}};
}

/// Stretch (volume ratio)^(1/3) under p = 2 mu h/R (1/lambda - 1/lambda^7), with what Newton's iterations did.
struct Inflated {
  double stretch;
  NewtonReport report;
};

Inflated inflate(const surface::TriangleMesh& mesh, double lambda)
{
  const Shell shell(mesh, {.thickness = thickness, .density = 1, .material = NeoHookean{.shear_modulus = mu}},
                    no_rigid_motion());
  const double pressure = 2 * mu * thickness * (1 / lambda - std::pow(lambda, -7));
  const StaticStep last =
      solve_static(shell, {Pressure{{}, [=](const Vec3&, double) { return pressure; }}}, {.steps = 2});
  return {std::cbrt(volume(mesh, last.positions) / volume(mesh, shell.reference_positions())), last.report};
}

TEST(Balloon, InflatesAsMembraneTheorySays)
{
  const double coarse = inflate(octasphere(3), 1.1).stretch, fine = inflate(octasphere(4), 1.1).stretch;
  std::printf("  lambda = 1.1: %.5f (512 triangles), %.5f (2048)\n", coarse, fine);
  EXPECT_NEAR(fine, 1.1, 5e-4);
  EXPECT_GT(std::log2((coarse - 1.1) / (fine - 1.1)), 1.8) << "second order";
}

TEST(Balloon, InflatesCloseToTheLimitPoint)
{
  const double coarse = inflate(octasphere(3), 1.3).stretch, fine = inflate(octasphere(4), 1.3).stretch;
  std::printf("  lambda = 1.3: %.5f (512 triangles), %.5f (2048)\n", coarse, fine);
  EXPECT_NEAR(fine, 1.3, 0.006);
  EXPECT_GT(std::log2((coarse - 1.3) / (fine - 1.3)), 1.7);
}

TEST(Balloon, OfAnIrregularMeshInflatesAsWell)
{
  for (const double lambda : {1.1, 1.3}) {
    const double coarse = inflate(shuffled(octasphere(3)), lambda).stretch;
    const double fine = inflate(shuffled(octasphere(4)), lambda).stretch;
    std::printf("  lambda = %.1f, irregular: %.5f (512 triangles), %.5f (2048)\n", lambda, coarse, fine);
    EXPECT_NEAR(fine, lambda, lambda == 1.1 ? 7e-4 : 0.009);
    EXPECT_GT(std::log2((coarse - lambda) / (fine - lambda)), 1.7);
  }
}

}  // namespace
}  // namespace luff::shell
