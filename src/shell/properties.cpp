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
  validate(p.material, shell);
  require(p.thickness_points >= 0 && p.thickness_points <= 5, shell, "thickness_points", p.thickness_points,
          "between 1 and 5, or 0");
  require(p.damping_mass >= 0 && std::isfinite(p.damping_mass), shell, "damping.mass", p.damping_mass, "at least 0");
  require(p.damping_stiffness >= 0 && std::isfinite(p.damping_stiffness), shell, "damping.stiffness",
          p.damping_stiffness, "at least 0");
  for (int d = 0; d < 3; ++d)
    require(std::isfinite(p.gravity[d]), shell, "gravity", p.gravity[d], "finite");
}

}  // namespace luff::shell
