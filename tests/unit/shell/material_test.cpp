// SPDX-License-Identifier: BSD-3-Clause
// The laws of plane stress: derivatives, convexity, frames, exact stresses.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "shell/material/material.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

using luff::test::random_vector;

const Fibre oblique(std::cos(0.4), std::sin(0.4));

const MayNewmanYin anterior{.c0 = 0.399, .c1 = 4.325, .c2 = 1446.5};
const MayNewmanYin posterior{.c0 = 0.414, .c1 = 4.848, .c2 = 305.4};

MayNewmanYin with_matrix(MayNewmanYin law, double c10)
{
  law.c10 = c10;
  return law;
}

MayNewmanYin in_tension_only(MayNewmanYin law)
{
  law.tension_only = true;
  return law;
}

Mat3 full_matrix()
{
  Mat3 A;
  A << 10, 2, 0.25, 2, 8, 0.15, 0.25, 0.15, 1.5;
  return A;
}

struct Example {
  const char* name;
  Material material;
};

std::vector<Example> examples()
{
  return {{"St-Venant-Kirchhoff", SaintVenantKirchhoff{.young = 100, .poisson = 0.3}},
          {"Hencky", Hencky{.young = 100, .poisson = 0.3}},
          {"neo-Hookean", NeoHookean{.shear_modulus = 100}},
          {"May-Newman-Yin, anterior", anterior},
          {"May-Newman-Yin, anterior with c10", with_matrix(anterior, 1)},
          {"May-Newman-Yin, posterior", posterior},
          {"May-Newman-Yin, in tension only", in_tension_only(anterior)},
          {"Lee-Sacks, isotropic", LeeSacks{.c0 = 67.6, .c1 = 13.3, .c2 = 38.2}},
          {"Lee-Sacks", LeeSacks{.c0 = 10, .c1 = 0.209, .c2 = 9.046, .c3 = 9.046, .weight = 0.5}},
          {"Lee-Sacks, in tension only",
           LeeSacks{.c0 = 10, .c1 = 0.209, .c2 = 9.046, .c3 = 9.046, .weight = 0.5, .tension_only = true}},
          {"Fung", Fung{.c = 10, .A = full_matrix()}},
          {"Holzapfel-Gasser-Ogden, two families",
           HolzapfelGasserOgden{.shear_modulus = 3, .k1 = 2.3, .k2 = 40, .angle = 0.5}},
          {"Holzapfel-Gasser-Ogden, dispersed",
           HolzapfelGasserOgden{.shear_modulus = 3, .k1 = 20, .k2 = 60, .dispersion = 0.226, .angle = 0.87}},
          {"Holzapfel-Gasser-Ogden, without direction",
           HolzapfelGasserOgden{.shear_modulus = 3, .k1 = 20, .k2 = 60, .dispersion = 1.0 / 3}}};
}

/// The same law with its exponential continued from where the exponent reaches 1/4.
Material guarded_early(Material material)
{
  std::visit(
      [](auto& law) {
        if constexpr (requires { law.largest_exponent; })
          law.largest_exponent = 0.25;
      },
      material);
  return material;
}

double energy(const Material& material, const Vec3& E, const Fibre& a = oblique)
{
  return std::visit([&](const auto& law) { return law.energy(E, a); }, material);
}

Response response(const Material& material, const Vec3& E, const Fibre& a = oblique)
{
  return std::visit([&](const auto& law) { return law.response(E, a); }, material);
}

/// |E11|, |E22| <= size, |2 E12| <= 2/3 size.
std::vector<Vec3> random_strains(double size, int count = 200)
{
  const Eigen::VectorXd u = random_vector(3 * count, 2);
  std::vector<Vec3> strains;
  for (int n = 0; n < count; ++n)
    strains.push_back(size * u.segment<3>(3 * n).cwiseProduct(Vec3(1, 1, 2.0 / 3)));
  return strains;
}

/// Derivative along component i by differences of fourth order.
template <class Function>
auto slope(Function f, const Vec3& E, int i)
{
  const Vec3 step = 2e-5 * Vec3::Unit(i);
  const auto once = (f(E + step) - f(E - step)).eval();
  const auto twice = (f(E + 2 * step) - f(E - 2 * step)).eval();
  return ((8 * once - twice) / (12 * 2e-5)).eval();
}

struct Differences {
  double stress = 0;
  double tangent = 0;
};

/// Largest differences of stress and tangent from numerical derivatives of energy and stress, relative.
Differences differences(const Material& material, double size)
{
  using One = Eigen::Matrix<double, 1, 1>;
  Differences largest;
  for (const Vec3& E : random_strains(size)) {
    const Response r = response(material, E);
    Vec3 stress;
    Mat3 tangent;
    for (int i = 0; i < 3; ++i) {
      stress[i] = slope([&](const Vec3& e) { return One(energy(material, e)); }, E, i)[0];
      tangent.col(i) = slope([&](const Vec3& e) { return response(material, e).stress; }, E, i);
    }
    largest.stress = std::max(largest.stress, (r.stress - stress).norm() / r.stress.norm());
    largest.tangent = std::max(largest.tangent, (r.tangent - tangent).norm() / r.tangent.norm());
  }
  return largest;
}

TEST(Material, StressAndTangentAreDerivativesOfTheEnergy)
{
  for (const auto& [name, material] : examples()) {
    const Differences d = differences(material, 0.12);
    EXPECT_LT(d.stress, 1e-7) << name;
    EXPECT_LT(d.tangent, 1e-7) << name;
    std::printf("  %-42s stress %.1e  tangent %.1e\n", name, d.stress, d.tangent);
  }
}

TEST(Material, StressAndTangentAreDerivativesOfTheEnergyBeyondTheLargestExponent)
{
  for (const auto& [name, material] : examples()) {
    const Material guarded = guarded_early(material);
    const Differences d = differences(guarded, 0.25);
    EXPECT_LT(d.stress, 1e-7) << name;
    EXPECT_LT(d.tangent, 1e-7) << name;
    int beyond = 0;
    for (const Vec3& E : random_strains(0.25))
      beyond += energy(guarded, E) < energy(material, E);
    std::printf("  %-42s stress %.1e  tangent %.1e, %d of 200 beyond\n", name, d.stress, d.tangent, beyond);
    const bool exponential = std::visit(
        [](const auto& law) {
          return requires
          {
            law.largest_exponent;
          };
        },
        material);
    EXPECT_EQ(beyond > 10, exponential) << name;
  }
}

TEST(Material, GuardedExponentialKeepsValueSlopeAndCurvatureWhereItTakesOver)
{
  const double Q = default_largest_exponent, beyond = std::nextafter(Q, 2 * Q);
  const GuardedExponential before(Q, Q), after(beyond, Q);
  EXPECT_NEAR(after.value() / before.value(), 1, 1e-14);
  EXPECT_NEAR(after.slope() / before.slope(), 1, 1e-14);
  EXPECT_NEAR(after.curvature() / before.curvature(), 1, 1e-14);
  EXPECT_NEAR(before.value() / std::expm1(Q), 1, 1e-14);
  EXPECT_LT(GuardedExponential(1e6, Q).value(), 1e12 * std::exp(Q));
}

TEST(Material, EveryLawIsConvexInTheStrain)
{
  for (const auto& [name, material] : examples())
    for (const Material& law : {material, guarded_early(material)})
      for (const Vec3& E : random_strains(0.25)) {
        const Mat3 D = response(law, E).tangent;
        EXPECT_LT((D - D.transpose()).norm(), 1e-15 * D.norm()) << name;
        const Vec3 eigenvalues = Eigen::SelfAdjointEigenSolver<Mat3>(D, Eigen::EigenvaluesOnly).eigenvalues();
        EXPECT_GT(eigenvalues[0], 1e-9 * eigenvalues[2]) << name << " at " << E.transpose();
      }
}

Eigen::Matrix2d strain_tensor(const Vec3& E)
{
  return (Eigen::Matrix2d() << E[0], E[2] / 2, E[2] / 2, E[1]).finished();
}

TEST(Material, FrameOfTheTriangleDoesNotMatter)
{
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(1.234).toRotationMatrix();
  for (const auto& [name, material] : examples())
    for (const Vec3& E : random_strains(0.12, 20)) {
      const Eigen::Matrix2d e = R * strain_tensor(E) * R.transpose();
      const Vec3 E_turned(e(0, 0), e(1, 1), 2 * e(0, 1));
      const Vec3 S = response(material, E).stress, S_turned = response(material, E_turned, R * oblique).stress;
      const Eigen::Matrix2d s = R * (Eigen::Matrix2d() << S[0], S[2], S[2], S[1]).finished() * R.transpose();
      EXPECT_LT((S_turned - Vec3(s(0, 0), s(1, 1), s(0, 1))).norm(), 1e-12 * S.norm()) << name;
      EXPECT_NEAR(energy(material, E_turned, R * oblique) / energy(material, E), 1, 1e-12) << name;
    }
}

TEST(Material, StressVanishesAtRestAndStiffnessThereIsTheReferencesForIsotropicLaws)
{
  for (const auto& [name, material] : examples())
    EXPECT_EQ(response(material, Vec3::Zero()).stress, Vec3::Zero()) << name;
  const std::vector<Material> isotropic{SaintVenantKirchhoff{.young = 100, .poisson = 0.3},
                                        Hencky{.young = 100, .poisson = 0.3}, NeoHookean{.shear_modulus = 100},
                                        LeeSacks{.c0 = 67.6, .c1 = 13.3, .c2 = 38.2}};
  for (const Material& material : isotropic) {
    const Mat3 C = reference_moduli(material);
    EXPECT_LT((response(material, Vec3::Zero()).tangent - C).norm(), 1e-14 * C.norm());
  }
}

TEST(Material, MayNewmanYinHasNoStiffnessAtRestWithoutC10AndThatOfItsMatrixWithIt)
{
  EXPECT_EQ(response(anterior, Vec3::Zero()).tangent, Mat3::Zero());
  const Mat3 C = incompressible_plane_stress(2 * 0.7);
  EXPECT_LT((response(with_matrix(anterior, 0.7), Vec3::Zero()).tangent - C).norm(), 1e-14 * C.norm());
}

/// Cauchy stress F S F' of a stretch along the axes; the volume doesn't change.
Vec3 cauchy(const Material& material, double stretch_1, double stretch_2, const Fibre& a)
{
  const Vec3 E((stretch_1 * stretch_1 - 1) / 2, (stretch_2 * stretch_2 - 1) / 2, 0);
  return response(material, E, a)
      .stress.cwiseProduct(Vec3(stretch_1 * stretch_1, stretch_2 * stretch_2, stretch_1 * stretch_2));
}

TEST(Material, MayNewmanYinInEquibiaxialStretchFollowsTheComputedTable)
{
  std::ifstream file(LUFF_SOURCE_DIR "/validation/data/maynewman_yin1998_equibiaxial_computed.csv");
  std::string line, leaflet;
  int rows = 0;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::getline(words, leaflet, ',');
    if (leaflet != "anterior" && leaflet != "posterior")
      continue;
    double stretch, I1, along, across;
    char comma;
    words >> stretch >> comma >> I1 >> comma >> along >> comma >> across;
    MayNewmanYin law = leaflet == "anterior" ? anterior : posterior;
    law.largest_exponent = 50;  // the table goes beyond what tissue bears
    const Vec3 sigma = cauchy(law, stretch, stretch, Fibre::UnitX());
    EXPECT_NEAR(sigma[0], along, 1e-5 * along) << line;
    EXPECT_NEAR(sigma[1], across, 1e-5 * across) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 60);
}

TEST(Material, NeoHookeanStretchedOneWayFollowsTheExactStress)
{
  const double mu = 2.5;
  for (const double stretch : {0.6, 0.9, 1.0, 1.3, 2.0}) {
    const Vec3 sigma = cauchy(NeoHookean{.shear_modulus = mu}, stretch, 1 / std::sqrt(stretch), oblique);
    EXPECT_NEAR(sigma[0], mu * (stretch * stretch - 1 / stretch), 1e-14 * mu);
    EXPECT_NEAR(sigma[1], 0, 1e-14 * mu);
  }
}

/// With Poisson's ratio 0.3 the other stretch is U^-0.3, and the force per reference area U S = E ln U/U.
TEST(Material, HenckyStretchedOneWayFollowsTheExactStress)
{
  const Hencky law{.young = 5, .poisson = 0.3};
  for (const double stretch : {0.1, 0.4, 0.9, 1.0, 1.0001, 1.3, 2.0}) {
    const double across = std::pow(stretch, -0.3);
    const Vec3 E((stretch * stretch - 1) / 2, (across * across - 1) / 2, 0);
    const Vec3 S = law.stress(E, oblique);
    const double exact = 5 * std::log(stretch) / stretch;
    EXPECT_NEAR(stretch * S[0], exact, 1e-14 * 5 / stretch);
    EXPECT_NEAR(S[1], 0, 1e-14 * 5 / stretch);
    const double energy = 2.5 * std::log(stretch) * std::log(stretch);
    EXPECT_NEAR(law.energy(E, oblique), energy, 1e-14 * 5);
  }
}

/// tau = J F S F' of Kirchhoff's principal stresses: E/(1 - nu^2) (ln U1 + nu ln U2), for any turn of the principal
/// axes.
TEST(Material, HenckysKirchhoffStressIsLinearInTheLogarithmicStrain)
{
  const Hencky law{.young = 5, .poisson = 0.3};
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  for (const auto& [U1, U2] : {std::pair{1.6, 0.5}, {0.9, 0.89999}, {1.2, 1.2}, {0.3, 0.2}}) {
    const Eigen::Vector2d U(U1, U2), strain(std::log(U1), std::log(U2));
    const Eigen::Matrix2d E = R * Eigen::Vector2d((U.array().square() - 1) / 2).asDiagonal() * R.transpose();
    const Vec3 S = law.stress({E(0, 0), E(1, 1), 2 * E(0, 1)}, oblique);
    const Eigen::Matrix2d principal = R.transpose() * (Eigen::Matrix2d() << S[0], S[2], S[2], S[1]).finished() * R;
    const Eigen::Matrix2d tau = U.asDiagonal() * principal * U.asDiagonal();
    const Eigen::Vector2d exact = 5 / (1 - 0.09) * (strain + 0.3 * strain.reverse());
    EXPECT_LT((tau - Eigen::Matrix2d(exact.asDiagonal())).norm(), 1e-13 * exact.norm()) << U.transpose();
  }
}

/// With C = c 1 the directions of the principal stretches are undetermined, the tangent is not:
///
///   c^2 D11 = K (1 - 2 ln c) + G,  c^2 D12 = K - G,  c^2 D33 = G - K ln c
TEST(Material, HenckysTangentIsExactAtAndBesideEqualStretches)
{
  const Hencky law{.young = 100, .poisson = 0.3};
  const double K = 100 / 1.4, G = 100 / 2.6;
  for (const double c : {0.25, 1.0, 1.7}) {
    const double normal = K * (1 - 2 * std::log(c)) + G;
    Mat3 exact;
    exact << normal, K - G, 0, K - G, normal, 0, 0, 0, G - K * std::log(c);
    exact /= c * c;
    const Vec3 equal((c - 1) / 2, (c - 1) / 2, 0);
    EXPECT_LT((law.tangent(equal, oblique) - exact).norm(), 1e-14 * exact.norm()) << c;
    for (const double beside : {1e-12, 1e-8, 1e-5, 1e-3})
      EXPECT_LT((law.tangent(equal + beside * Vec3(1, -1, 0.5), oblique) - exact).norm(),
                (1e-14 + 10 * beside / c) * exact.norm())
          << c << ", " << beside;
  }
}

/// sigma_f = 2 k1 F e^{k2 F^2} lambda^2 dF/dE per family along the stretch, and mu (lambda^2 - 1/lambda^4) for lambda_2
/// = lambda.
TEST(Material, HolzapfelGasserOgdenInEquibiaxialStretchFollowsTheExactStress)
{
  const HolzapfelGasserOgden law{.shear_modulus = 3, .k1 = 2.3, .k2 = 4, .dispersion = 0.1};
  const double stretch = 1.15, squared = stretch * stretch, third = 1 / (squared * squared);
  const double F = 0.1 * (2 * squared + third - 3) + 0.7 * (squared - 1);
  const double fibres = 2 * law.k1 * F * std::exp(law.k2 * F * F);  // both families run along the first axis
  const Vec3 sigma = cauchy(law, stretch, stretch, Fibre::UnitX());
  const double matrix = 3 * (squared - third), isotropic = fibres * 0.1 * 2 * (squared - third);
  EXPECT_NEAR(sigma[0], matrix + isotropic + fibres * 0.7 * 2 * squared, 1e-13 * sigma[0]);
  EXPECT_NEAR(sigma[1], matrix + isotropic, 1e-13 * sigma[0]);
}

TEST(Material, LeeSacksInEquibiaxialStretchFollowsTheExactStress)
{
  const LeeSacks law{.c0 = 10, .c1 = 2, .c2 = 9, .c3 = 5, .weight = 0.3};
  const double squared = 1.15 * 1.15, third = 1 / (squared * squared), I = 2 * squared + third - 3, F = squared - 1;
  const double isotropic = 10 + 2 * 0.3 * 2 * 9 * I * std::exp(9 * I * I);
  const Vec3 sigma = cauchy(law, 1.15, 1.15, Fibre::UnitY());
  EXPECT_NEAR(sigma[0], isotropic * (squared - third), 1e-13 * sigma[0]);
  EXPECT_NEAR(sigma[1] - sigma[0], 2 * 0.7 * 2 * 5 * F * std::exp(5 * F * F) * squared, 1e-13 * sigma[1]);
}

TEST(Material, FungSeesTheStrainAlongAndAcrossItsFibre)
{
  const Fung law{.c = 10, .A = full_matrix()};
  const double Q = 8 * 0.1 * 0.1;  // a strain across the fibre, which runs along the second axis
  EXPECT_NEAR(law.energy({0.1, 0, 0}, Fibre::UnitY()), 5 * std::expm1(Q), 1e-14);
  EXPECT_NEAR(law.stress({0.1, 0, 0}, Fibre::UnitY())[0], 10 * std::exp(Q) * 8 * 0.1, 1e-13);
}

TEST(Material, ShortenedFibresCarryNothingInTensionOnly)
{
  const Vec3 shortened(-0.1, 0.02, 0);
  const Fibre along = Fibre::UnitX();
  MayNewmanYin no_fibres = anterior;
  no_fibres.c2 = 0;
  EXPECT_EQ(in_tension_only(anterior).stress(shortened, along), no_fibres.stress(shortened, along));
  EXPECT_LT(anterior.stress(shortened, along)[0], 1.5 * no_fibres.stress(shortened, along)[0]);
  const HolzapfelGasserOgden dry{.shear_modulus = 3, .k1 = 20, .k2 = 60};
  EXPECT_EQ(dry.stress(shortened, along), NeoHookean{.shear_modulus = 3}.stress(shortened, along));
}

TEST(Material, SheetsTurnedInsideOutHaveNoFiniteEnergyNorStress)
{
  const Vec3 through_zero(-0.6, 0, 0), both_negative(-0.6, -0.6, 0);
  for (const auto& [name, material] : examples()) {
    if (std::holds_alternative<SaintVenantKirchhoff>(material) || std::holds_alternative<Fung>(material))
      continue;  // these have no limit in compression
    for (const Vec3& E : {through_zero, both_negative}) {
      EXPECT_FALSE(std::isfinite(energy(material, E))) << name;
      EXPECT_FALSE(response(material, E).stress.allFinite()) << name;
    }
  }
}

TEST(Material, ConstantsOutOfRangeAreNamed)
{
  struct Wrong {
    Material material;
    const char* words;
  };
  MayNewmanYin overflowing = anterior;
  overflowing.largest_exponent = 800;
  Fung indefinite{.c = 10, .A = full_matrix()};
  indefinite.A(0, 1) = indefinite.A(1, 0) = 9;
  const std::vector<Wrong> wrongs{{SaintVenantKirchhoff{.young = 1, .poisson = 0.6}, "poisson = 0.6"},
                                  {Hencky{.young = 1, .poisson = -1}, "poisson = -1"},
                                  {NeoHookean{.shear_modulus = -1}, "shear_modulus = -1"},
                                  {MayNewmanYin{.c0 = 0, .c1 = 1, .c2 = 1}, "c0 = 0"},
                                  {overflowing, "largest_exponent = 800"},
                                  {LeeSacks{.c0 = 1, .weight = 1.5}, "weight = 1.5"},
                                  {indefinite, "positive definite"},
                                  {HolzapfelGasserOgden{.shear_modulus = 1, .k1 = 1, .k2 = 1, .dispersion = 0.4},
                                   "dispersion = 0.4 must be between 0 and 1/3"}};
  for (const auto& [material, words] : wrongs)
    try {
      validate(material, "leaflet");
      ADD_FAILURE() << "accepted " << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("leaflet"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  for (const auto& [name, material] : examples())
    EXPECT_NO_THROW(validate(material, "leaflet")) << name;
}

}  // namespace
}  // namespace luff::shell
