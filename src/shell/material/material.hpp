// SPDX-License-Identifier: BSD-3-Clause
// The laws a shell can be made of.
#pragma once

#include <string_view>
#include <variant>

#include "shell/material/fung.hpp"
#include "shell/material/hencky.hpp"
#include "shell/material/holzapfel_gasser_ogden.hpp"
#include "shell/material/lee_sacks.hpp"
#include "shell/material/may_newman_yin.hpp"
#include "shell/material/neo_hookean.hpp"
#include "shell/material/saint_venant_kirchhoff.hpp"

namespace luff::shell {

/// Every law is a plain struct with energy, stress, tangent and response as functions of the Green-Lagrange strain
/// (E11, E22, 2 E12) and the fibre, both in the frame of the reference triangle; W is per reference volume, the
/// stress is dW/dE, the tangent d2W/dE2. Formulas, sources and constants: docs/numerics/materials.md.
using Material =
    std::variant<SaintVenantKirchhoff, Hencky, NeoHookean, MayNewmanYin, LeeSacks, Fung, HolzapfelGasserOgden>;

/// \throws InputError naming `shell`, the constant, its value and what is allowed.
void validate(const Material& material, std::string_view shell);

/// Moduli of an isotropic material that stands for this one where a shape or a scale of the stiffness is asked for,
/// as at free edges. They are the law's own at rest for isotropic laws that have stiffness there.
Mat3 reference_moduli(const Material& material);

/// Gauss points through the thickness that keep the moment's error near 1 % or below.
int recommended_thickness_points(const Material& material);

}  // namespace luff::shell
