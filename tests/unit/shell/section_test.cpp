// SPDX-License-Identifier: BSD-3-Clause
// Integration through the thickness.
#include <gtest/gtest.h>

#include "shell/material/material.hpp"
#include "shell/section.hpp"

namespace luff::shell {
namespace {

const Fibre along(1, 0);

TEST(Section, SaintVenantKirchhoffIntegratedEqualsTheClosedForm)
{
  const SaintVenantKirchhoff law{.young = 1.3, .poisson = 0.3};
  const double h = 0.7;
  const LinearSection closed(law.reference_moduli(), h);
  const Vec3 Em(0.02, -0.01, 0.03), Eb(0.1, 0.2, -0.3);
  const auto [resultants, stiffness] = closed.response(Em, Eb, along);
  for (int points = 2; points <= max_thickness_points; ++points) {
    const IntegratedSection integrated(law, h, points);
    const auto [same_resultants, same_stiffness] = integrated.response(Em, Eb, along);
    EXPECT_LT((same_resultants.N - resultants.N).norm(), 1e-14 * resultants.N.norm());
    EXPECT_LT((same_resultants.M - resultants.M).norm(), 1e-14 * resultants.M.norm());
    EXPECT_LT((same_stiffness.membrane - stiffness.membrane).norm(), 1e-14 * stiffness.membrane.norm());
    EXPECT_LT(same_stiffness.coupling.norm(), 1e-14 * h * stiffness.membrane.norm());
    EXPECT_LT((same_stiffness.bending - stiffness.bending).norm(), 1e-14 * stiffness.bending.norm());
    EXPECT_NEAR(integrated.energy(Em, Eb, along) / closed.energy(Em, Eb, along), 1, 1e-14);
  }
}

TEST(Section, GaussRulesAreExactForPolynomialsOfTheirDegree)
{
  for (int points = 1; points <= max_thickness_points; ++points)
    for (int power = 0; power < 2 * points; ++power) {
      double sum = 0;
      for (int g = 0; g < points; ++g)
        sum += gauss_rule(points).weight[g] * std::pow(gauss_rule(points).abscissa[g], power);
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-15) << points << " points, power " << power;
    }
}

}  // namespace
}  // namespace luff::shell
