// SPDX-License-Identifier: BSD-3-Clause
// Integration through the thickness.
#include <gtest/gtest.h>

#include "shell/material/material.hpp"
#include "shell/section.hpp"

namespace luff::shell {
namespace {

const Fibre along(1, 0);
const Fibre oblique(std::cos(0.4), std::sin(0.4));

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

/// Rolled up without stretch of the middle surface, with C11 = 1 + 2 kappa z, C22 = 1 and k = kappa h:
///
///   M11 = int mu (1 - 1/C11^2) z dz = mu/(2 kappa^2) (k/(1 - k^2) - atanh k)
TEST(Section, ThreePointsGiveTheMomentOfABentNeoHookeanSheet)
{
  const double mu = 2, h = 0.4, k = 0.16, kappa = k / h;
  const double exact = mu / (2 * kappa * kappa) * (k / (1 - k * k) - std::atanh(k));
  const IntegratedSection section(NeoHookean{.shear_modulus = mu}, h, 3);
  const double M = section.resultants(Vec3::Zero(), Vec3(kappa, 0, 0), along).M[0];
  EXPECT_NEAR(M / exact, 1, 2e-4);
  std::printf("  moment with 3 points: %+.1e of the exact one\n", M / exact - 1);
}

TEST(Section, FivePointsAgreeWithThreeOnTheMomentOfALeaflet)
{
  const Vec3 Em(0.06, 0.03, 0), Eb(0.16, 0, 0);
  const MayNewmanYin anterior{.c0 = 0.399, .c1 = 4.325, .c2 = 1446.5}, posterior{.c0 = 0.414, .c1 = 4.848, .c2 = 305.4};
  for (const MayNewmanYin& law : {anterior, posterior}) {
    const double three = IntegratedSection(law, 1, 3).resultants(Em, Eb, oblique).M[0];
    const double five = IntegratedSection(law, 1, 5).resultants(Em, Eb, oblique).M[0];
    EXPECT_NEAR(three / five, 1, 0.015);
    EXPECT_GT(std::abs(IntegratedSection(law, 1, 2).resultants(Em, Eb, oblique).M[0] / five - 1), 0.015);
    std::printf("  moment with 3 points: %+.2f %% of that with 5\n", 100 * (three / five - 1));
  }
}

TEST(Section, StiffnessIsTheDerivativeOfTheResultantsAndTheseOfTheEnergy)
{
  const IntegratedSection section(MayNewmanYin{.c0 = 0.4, .c1 = 4.3, .c2 = 300, .c10 = 1}, 0.5, 5);
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  const auto energy = [&](const Vec6& E) { return section.energy(E.head<3>(), E.tail<3>(), oblique); };
  const auto resultants = [&](const Vec6& E) -> Vec6 {
    const Resultants r = section.resultants(E.head<3>(), E.tail<3>(), oblique);
    return (Vec6() << r.N, r.M).finished();
  };
  const Vec6 E = (Vec6() << 0.06, -0.03, 0.05, 0.2, -0.1, 0.15).finished();
  const auto [r, D] = section.response(E.head<3>(), E.tail<3>(), oblique);
  Eigen::Matrix<double, 6, 6> K;
  K << D.membrane, D.coupling, D.coupling, D.bending;
  const double step = 1e-5;
  for (int i = 0; i < 6; ++i) {
    const Vec6 d = step * Vec6::Unit(i);
    EXPECT_NEAR((energy(E + d) - energy(E - d)) / (2 * step), resultants(E)[i], 1e-8 * resultants(E).norm());
    EXPECT_LT(((resultants(E + d) - resultants(E - d)) / (2 * step) - K.col(i)).norm(), 1e-7 * K.norm());
  }
  EXPECT_EQ(r.N, resultants(E).head<3>());
  EXPECT_EQ(section.stiffness(E.head<3>(), E.tail<3>(), oblique).coupling, D.coupling);
}

TEST(Section, MaterialsGetTheSectionAndThePointsTheyNeed)
{
  const SaintVenantKirchhoff linear{.young = 1, .poisson = 0.3};
  EXPECT_TRUE(std::holds_alternative<LinearSection>(make_section(linear, 0.1, 0)));
  const MayNewmanYin leaflet{.c0 = 0.4, .c1 = 4.3, .c2 = 300};
  const Vec3 Em(0.06, -0.03, 0.05), Eb(2, -1, 1.5);
  const Section section = make_section(leaflet, 0.1, 0);
  EXPECT_EQ(std::visit([&](const auto& s) { return s.energy(Em, Eb, along); }, section),
            IntegratedSection(leaflet, 0.1, 5).energy(Em, Eb, along));
}

}  // namespace
}  // namespace luff::shell
