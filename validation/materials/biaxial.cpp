// SPDX-License-Identifier: BSD-3-Clause
// Stresses of a square pulled along and across its fibres: biaxial CASE > TABLE, one row per material of the case,
// protocol and stretch.
#include <cstdio>
#include <exception>

#include "config/case.hpp"
#include "simulation/build_material.hpp"

namespace luff {
namespace {

constexpr double largest_stretch = 1.8;
constexpr double stretch_step = 0.0025;

/// Cauchy stress along and across the fibre, F S F' with F = diag(along, across) and no change of volume.
Eigen::Vector2d cauchy(const shell::Material& material, double along, double across)
{
  const Vec3 E((along * along - 1) / 2, (across * across - 1) / 2, 0);
  const Vec3 S = std::visit([&](const auto& law) { return law.stress(E, shell::Fibre::UnitX()); }, material);
  return {along * along * S[0], across * across * S[1]};
}

void print(const std::string& name, const char* protocol, double along, double across, const Eigen::Vector2d& sigma)
{
  std::printf("%s,%s,%.17g,%.17g,%.17g,%.17g\n", name.c_str(), protocol, along, across, sigma[0], sigma[1]);
}

/// The same stretch both ways.
void stretch_equally(const std::string& name, const shell::Material& material)
{
  for (int n = 0; 1 + n * stretch_step <= largest_stretch; ++n) {
    const double stretch = 1 + n * stretch_step;
    print(name, "stretch", stretch, stretch, cauchy(material, stretch, stretch));
  }
}

/// The stretch across the fibre at which both stresses are the same, by halving an interval: pulling across raises that
/// stress more than the other.
double balancing_stretch(const shell::Material& material, double along)
{
  double low = 0.5, high = 3;
  while (high - low > 1e-14 * high) {
    const double middle = 0.5 * (low + high);
    const Eigen::Vector2d sigma = cauchy(material, along, middle);
    (sigma[1] < sigma[0] ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The same stress both ways.
void pull_equally(const std::string& name, const shell::Material& material)
{
  for (int n = 1; 1 + n * stretch_step <= largest_stretch; ++n) {
    const double along = 1 + n * stretch_step, across = balancing_stretch(material, along);
    if (across > largest_stretch)
      return;
    print(name, "tension", along, across, cauchy(material, along, across));
  }
}

void tabulate(const char* file)
{
  const config::Case options = config::load_case(file);
  std::puts("material,protocol,stretch_along,stretch_across,stress_along,stress_across");
  for (const config::ShellOptions& shell : options.shells) {
    const shell::Material material = simulation::build_material(shell.material);
    stretch_equally(shell.name, material);
    pull_equally(shell.name, material);
  }
}

}  // namespace
}  // namespace luff

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::fputs("usage: validation_materials_biaxial CASE\n", stderr);
    return 2;
  }
  try {
    luff::tabulate(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
