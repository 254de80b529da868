// SPDX-License-Identifier: BSD-3-Clause
// What shells are made of, and where their fibres run.
#include "simulation/build_material.hpp"

#include <numbers>

#include <Eigen/Geometry>

#include "shell/fibres.hpp"
#include "simulation/refusal.hpp"
#include "surface/triangle_vectors.hpp"

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

/// The directions that the mesh file keeps, turned as the mesh is.
std::vector<Vec3> field_directions(const std::string& field, const config::ShellOptions& options,
                                   const std::string& owner)
{
  if (!options.mesh.file)
    fail_input("{}: material.fibre.field = \"{}\" needs a mesh file that holds it; this mesh is made by its shape",
               owner, field);
  std::vector<Vec3> directions = surface::read_triangle_vectors(*options.mesh.file, field);
  if (const auto& rotate = options.placement.rotate) {
    const Eigen::AngleAxisd turn(rotate->angle * radians, rotate->axis.normalized());
    for (Vec3& direction : directions)
      direction = turn * direction;
  }
  return directions;
}

std::vector<Vec3> directions(const config::FibreOptions& fibre, const config::ShellOptions& options,
                             const surface::TriangleMesh& mesh, const std::string& owner)
{
  if (fibre.direction)
    return shell::uniform_directions(mesh, *fibre.direction);
  if (fibre.circumference)
    return shell::circumferential_directions(mesh, fibre.circumference->axis, fibre.circumference->through,
                                             options.name);
  return field_directions(fibre.field.value(), options, owner);
}

}  // namespace

shell::Material build_material(const config::MaterialOptions& m)
{
  switch (m.model) {
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

std::vector<Vec3> build_fibres(const config::ShellOptions& options, const surface::TriangleMesh& mesh)
{
  const auto& fibre = options.material.fibre;
  if (!fibre)
    return {};
  return refusing_at(fibre->mark, [&] {
    std::vector<Vec3> found = directions(*fibre, options, mesh, fmt::format("shell '{}'", options.name));
    (void)shell::fibres_in_triangles(mesh, found, options.name);  // refused here, where the file is known
    return found;
  });
}

}  // namespace luff::simulation
