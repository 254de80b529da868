// SPDX-License-Identifier: BSD-3-Clause
// What shells are made of, and where their fibres run.
#include "simulation/build_material.hpp"

#include <numbers>

#include "shell/fibres.hpp"
#include "simulation/refusal.hpp"

namespace luff::simulation {

namespace {

constexpr double radians = std::numbers::pi / 180.0;

shell::MayNewmanYin may_newman_yin(const config::MaterialOptions& m)
{
  return {.c0 = m.c0,
          .c1 = m.c1,
          .c2 = m.c2,
          .c10 = m.c10,
          .tension_only = m.tension_only,
          .largest_exponent = m.largest_exponent};
}

shell::LeeSacks lee_sacks(const config::MaterialOptions& m)
{
  return {.c0 = m.c0,
          .c1 = m.c1,
          .c2 = m.c2,
          .c3 = m.c3,
          .weight = m.weight,
          .tension_only = m.tension_only,
          .largest_exponent = m.largest_exponent};
}

shell::Fung fung(const config::MaterialOptions& m)
{
  shell::Fung law{.c = m.c, .largest_exponent = m.largest_exponent};
  law.A << m.a11, m.a12, m.a13, m.a12, m.a22, m.a23, m.a13, m.a23, m.a33;
  return law;
}

shell::HolzapfelGasserOgden holzapfel_gasser_ogden(const config::MaterialOptions& m)
{
  return {.shear_modulus = m.shear_modulus,
          .k1 = m.k1,
          .k2 = m.k2,
          .dispersion = m.dispersion,
          .angle = m.angle * radians,
          .largest_exponent = m.largest_exponent};
}

std::vector<Vec3> directions(const config::FibreOptions& fibre, const config::ShellOptions& options,
                             const surface::MarkedMesh& marked, const std::string& owner)
{
  if (fibre.direction)
    return shell::uniform_directions(marked.mesh, *fibre.direction);
  if (fibre.circumference)
    return shell::circumferential_directions(marked.mesh, fibre.circumference->axis, fibre.circumference->through,
                                             options.name);
  return surface::direction_field(marked.marks, fibre.field.value(), owner + ", material.fibre.field");
}

}  // namespace

shell::Material build_material(const config::MaterialOptions& m)
{
  switch (m.model) {
    case config::MaterialModel::Hencky:
      return shell::Hencky{.young = m.young, .poisson = m.poisson};
    case config::MaterialModel::NeoHookean:
      return shell::NeoHookean{.shear_modulus = m.shear_modulus};
    case config::MaterialModel::MayNewmanYin:
      return may_newman_yin(m);
    case config::MaterialModel::LeeSacks:
      return lee_sacks(m);
    case config::MaterialModel::Fung:
      return fung(m);
    case config::MaterialModel::HolzapfelGasserOgden:
      return holzapfel_gasser_ogden(m);
    case config::MaterialModel::SaintVenantKirchhoff:
      break;
  }
  return shell::SaintVenantKirchhoff{.young = m.young, .poisson = m.poisson};
}

std::vector<Vec3> build_fibres(const config::ShellOptions& options, const surface::MarkedMesh& marked)
{
  const auto& fibre = options.material.fibre;
  if (!fibre)
    return {};
  return refusing_at(fibre->mark, [&] {
    std::vector<Vec3> found = directions(*fibre, options, marked, fmt::format("shell '{}'", options.name));
    (void)shell::fibres_in_triangles(marked.mesh, found, options.name);  // refused here, where the file is known
    return found;
  });
}

}  // namespace luff::simulation
