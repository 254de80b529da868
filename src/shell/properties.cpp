// SPDX-License-Identifier: BSD-3-Clause
// What a shell is made of.
#include "shell/properties.hpp"

#include <cmath>

#include "core/error.hpp"

namespace luff::shell {

namespace {

void require(bool allowed, std::string_view shell, std::string_view property, double value, std::string_view range)
{
  if (!allowed)
    fail_input("shell '{}': {} = {} must be {}", shell, property, value, range);
}

}  // namespace

void validate(const Properties& p, std::string_view shell)
{
  require(p.thickness > 0 && std::isfinite(p.thickness), shell, "thickness", p.thickness, "greater than 0");
  require(p.density >= 0 && std::isfinite(p.density), shell, "density", p.density, "at least 0");
  require(p.young > 0 && std::isfinite(p.young), shell, "young", p.young, "greater than 0");
  require(p.poisson > -1 && p.poisson <= 0.5, shell, "poisson", p.poisson, "greater than -1 and at most 0.5");
  require(p.damping_mass >= 0 && std::isfinite(p.damping_mass), shell, "damping.mass", p.damping_mass, "at least 0");
  require(p.damping_stiffness >= 0 && std::isfinite(p.damping_stiffness), shell, "damping.stiffness",
          p.damping_stiffness, "at least 0");
  for (int d = 0; d < 3; ++d)
    require(std::isfinite(p.gravity[d]), shell, "gravity", p.gravity[d], "finite");
}

Mat3 plane_stress_moduli(const Properties& p)
{
  Mat3 C;
  C << 1, p.poisson, 0, p.poisson, 1, 0, 0, 0, (1 - p.poisson) / 2;
  return p.young / (1 - p.poisson * p.poisson) * C;
}

}  // namespace luff::shell
