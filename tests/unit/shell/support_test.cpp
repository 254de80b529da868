// SPDX-License-Identifier: BSD-3-Clause
// Supports hold what they say, keep slopes where they say, and bad ones are refused.
#include <gtest/gtest.h>

#include <string>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "shell/statics.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

const Properties strip_properties{.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1e6, 0}};

std::vector<int> at_x(const surface::TriangleMesh& mesh, double x)
{
  return test::vertices_where(mesh, [=](const Vec3& X) { return X.x() == x; });
}

/// Deflection at the far end of a strip of unit length under an end force that would bend a cantilever by one.
double end_deflection(const std::vector<Support>& supports, const surface::TriangleMesh& mesh)
{
  const Shell strip(mesh, strip_properties, supports);
  const double width = bounding_box(mesh.vertices).extent().y();
  const double EI = 1e6 * 1e-6 / 12 * width;
  const std::vector<int> end = at_x(mesh, 1);
  const Loads loads(strip, {PointForce{end, [=](const Vec3&, double) { return Vec3(0, 0, 3 * EI); }}});
  return test::linear_displacement(strip, loads.at(0).force(strip.reference_positions()))[3 * end.front() + 2];
}

TEST(Support, ClampedStripBendsLikeACantilever)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.1, 32, 3, surface::Pattern::Alternating);
  EXPECT_NEAR(end_deflection({{.kind = SupportKind::Clamped, .vertices = at_x(mesh, 0)}}, mesh), 1, 0.005);
}

TEST(Support, HingedStripTurnsWithoutResistanceUntilItsSecondSupport)
{
  // Hinged at 0, propped at 1/2, loaded at 1: w = F a b^2 (1 + b/a)/(3 EI) with a = b = 1/2, a quarter of a
  // cantilever's.
  const surface::TriangleMesh mesh = test::sheet(1, 0.1, 32, 2, surface::Pattern::Alternating);
  const std::vector<Support> supports{
      {.kind = SupportKind::Hinged, .vertices = at_x(mesh, 0)},
      {.kind = SupportKind::Fixed, .vertices = at_x(mesh, 0.5), .components = {false, false, true}}};
  EXPECT_NEAR(end_deflection(supports, mesh), 0.25, 0.005);
}

TEST(Support, SymmetryGivesHalfOfTheWholePlate)
{
  // A strip clamped at both ends and its left half with a symmetry plane in the middle.
  const auto middle_deflection = [](double length, int n, const std::vector<Support>& supports) {
    const surface::TriangleMesh mesh = test::sheet(length, 0.25, n, 4, surface::Pattern::Alternating);
    const Shell strip(mesh, strip_properties, supports);
    const Loads loads(strip, {Traction{{}, [](const Vec3&, double) { return Vec3(0, 0, 1e-4); }}});
    const auto u = test::linear_displacement(strip, loads.at(0).force(strip.reference_positions()));
    return u[3 * at_x(mesh, 1)[2] + 2];
  };
  const surface::TriangleMesh whole = test::sheet(2, 0.25, 32, 4, surface::Pattern::Alternating);
  const surface::TriangleMesh half = test::sheet(1, 0.25, 16, 4, surface::Pattern::Alternating);
  const double a = middle_deflection(2, 32,
                                     {{.kind = SupportKind::Clamped, .vertices = at_x(whole, 0)},
                                      {.kind = SupportKind::Clamped, .vertices = at_x(whole, 2)}});
  const double b = middle_deflection(1, 16,
                                     {{.kind = SupportKind::Clamped, .vertices = at_x(half, 0)},
                                      {.kind = SupportKind::Symmetry, .vertices = at_x(half, 1)}});
  EXPECT_NEAR(b / a, 1, 1e-2);
  std::printf("  half over whole: %.6f\n", b / a);
}

std::string refusal(const std::vector<Support>& supports)
{
  try {
    const Shell shell(test::sheet(1, 1, 4, 4), strip_properties, supports, "flag");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Support, BadSupportsAreRefusedByNameAndNumber)
{
  EXPECT_NE(refusal({{.kind = SupportKind::Hinged, .vertices = {0}}, {.kind = SupportKind::Hinged}})
                .find("shell 'flag', support 2 (hinged): it selects no vertex"),
            std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Fixed, .vertices = {25}}}).find("vertex 25 is not in 0..24"),
            std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Clamped, .vertices = {7}}}).find("no slope to keep"), std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Symmetry, .vertices = {0, 1}, .normal = Vec3(1, 1, 0)}})
                .find("away from the plane through vertex 0 with normal [0.707107, 0.707107, 0]"),
            std::string::npos);
  EXPECT_NE(refusal({{.kind = SupportKind::Symmetry, .vertices = {0, 1, 12}}})
                .find("the edges selected are not in one plane"),
            std::string::npos);
}

TEST(Support, BadPropertiesAreRefusedWithTheirRange)
{
  const auto message = [](const Properties& p) -> std::string {
    try {
      const Shell shell(test::sheet(1, 1, 2, 2), p, {}, "flag");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  Properties p = strip_properties;
  p.thickness = -0.01;
  EXPECT_EQ(message(p), "shell 'flag': thickness = -0.01 must be greater than 0");
  p = strip_properties;
  p.material = SaintVenantKirchhoff{1e6, 0.7};
  EXPECT_EQ(message(p), "shell 'flag': material.poisson = 0.7 must be greater than -1 and at most 0.5");
}

}  // namespace
}  // namespace luff::shell
