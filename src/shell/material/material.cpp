// SPDX-License-Identifier: BSD-3-Clause
// What is allowed of each law's constants.
#include "shell/material/material.hpp"

#include <cmath>

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

  void check(const SaintVenantKirchhoff& m) const
  {
    positive("young", m.young);
    require(m.poisson > -1 && m.poisson <= 0.5, "poisson", m.poisson, "greater than -1 and at most 0.5");
  }
  void check(const NeoHookean& m) const { positive("shear_modulus", m.shear_modulus); }
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

int recommended_thickness_points(const Material&)
{
  return 3;
}

}  // namespace luff::shell
