// SPDX-License-Identifier: BSD-3-Clause
// What is allowed of each law's constants.
#include "shell/material/material.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// Complains about constants of one shell's material.
struct Constants {
  std::string_view shell;

  void require(bool allowed, std::string_view constant, double value, std::string_view range) const
  {
    if (!allowed)
      fail_input("shell '{}': material.{} = {} must be {}", shell, constant, value, range);
  }
  void positive(std::string_view constant, double value) const
  {
    require(value > 0 && std::isfinite(value), constant, value, "greater than 0");
  }

  void not_negative(std::string_view constant, double value) const
  {
    require(value >= 0 && std::isfinite(value), constant, value, "at least 0");
  }
  void exponent(double largest) const
  {
    require(largest >= 1 && largest <= 50, "largest_exponent", largest, "between 1 and 50");
  }

  void isotropic(double young, double poisson) const
  {
    positive("young", young);
    require(poisson > -1 && poisson <= 0.5, "poisson", poisson, "greater than -1 and at most 0.5");
  }

  void check(const SaintVenantKirchhoff& m) const { isotropic(m.young, m.poisson); }
  void check(const Hencky& m) const { isotropic(m.young, m.poisson); }
  void check(const NeoHookean& m) const { positive("shear_modulus", m.shear_modulus); }
  void check(const MayNewmanYin& m) const
  {
    positive("c0", m.c0);
    not_negative("c1", m.c1);
    not_negative("c2", m.c2);
    not_negative("c10", m.c10);
    exponent(m.largest_exponent);
  }
  void check(const LeeSacks& m) const
  {
    positive("c0", m.c0);
    not_negative("c1", m.c1);
    not_negative("c2", m.c2);
    not_negative("c3", m.c3);
    require(m.weight >= 0 && m.weight <= 1, "weight", m.weight, "between 0 and 1");
    exponent(m.largest_exponent);
  }
  void check(const Fung& m) const
  {
    positive("c", m.c);
    const Eigen::SelfAdjointEigenSolver<Mat3> A(m.A, Eigen::EigenvaluesOnly);
    if (!m.A.allFinite() || m.A != m.A.transpose() || !(A.eigenvalues()[0] > 0))
      fail_input(
          "shell '{}': material: the exponents a11 = {}, a22 = {}, a33 = {}, a12 = {}, a13 = {}, a23 = {} must make a "
          "positive definite matrix (a12^2 < a11 a22 and so on), or some strain would cost no energy",
          shell, m.A(0, 0), m.A(1, 1), m.A(2, 2), m.A(0, 1), m.A(0, 2), m.A(1, 2));
    exponent(m.largest_exponent);
  }
  void check(const HolzapfelGasserOgden& m) const
  {
    positive("shear_modulus", m.shear_modulus);
    not_negative("k1", m.k1);
    positive("k2", m.k2);
    require(m.dispersion >= 0 && m.dispersion <= 1.0 / 3, "dispersion", m.dispersion, "between 0 and 1/3");
    require(std::isfinite(m.angle), "angle", m.angle, "finite");
    exponent(m.largest_exponent);
  }
};

}  // namespace

void validate(const Material& material, std::string_view shell)
{
  std::visit([&](const auto& law) { Constants{shell}.check(law); }, material);
}

Mat3 reference_moduli(const Material& material)
{
  return std::visit([](const auto& law) { return law.reference_moduli(); }, material);
}

int recommended_thickness_points(const Material& material)
{
  return std::holds_alternative<MayNewmanYin>(material) ? 5 : 3;
}

}  // namespace luff::shell
