// SPDX-License-Identifier: BSD-3-Clause
// Gauss' rules for the thickness.
#include "shell/section.hpp"

#include <cmath>

#include "core/error.hpp"

namespace luff::shell {

namespace {

GaussRule three_points()
{
  const double x = std::sqrt(0.6);
  return {{-x, 0, x}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
}

GaussRule four_points()
{
  const double inner = std::sqrt((3 - 2 * std::sqrt(1.2)) / 7), outer = std::sqrt((3 + 2 * std::sqrt(1.2)) / 7);
  const double larger = (18 + std::sqrt(30.0)) / 36, smaller = (18 - std::sqrt(30.0)) / 36;
  return {{-outer, -inner, inner, outer}, {smaller, larger, larger, smaller}};
}

GaussRule five_points()
{
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double larger = (322 + 13 * std::sqrt(70.0)) / 900, smaller = (322 - 13 * std::sqrt(70.0)) / 900;
  return {{-outer, -inner, 0, inner, outer}, {smaller, larger, 128.0 / 225, larger, smaller}};
}

struct SectionMaker {
  double thickness;
  int points;

  Section operator()(const SaintVenantKirchhoff& law) const { return LinearSection(law.reference_moduli(), thickness); }
  template <class Law>
  Section operator()(const Law& law) const
  {
    return IntegratedSection<Law>(law, thickness, points);
  }
};

}  // namespace

const GaussRule& gauss_rule(int n_points)
{
  ensure(1 <= n_points && n_points <= max_thickness_points, "there are rules of 1 to 5 points");
  static const double two = 1 / std::sqrt(3.0);
  static const std::array<GaussRule, max_thickness_points> rules{
      {{{0}, {2}}, {{-two, two}, {1, 1}}, three_points(), four_points(), five_points()}};
  return rules[n_points - 1];
}

Section make_section(const Material& material, double thickness, int thickness_points)
{
  const int points = thickness_points == 0 ? recommended_thickness_points(material) : thickness_points;
  return std::visit(SectionMaker{thickness, points}, material);
}

}  // namespace luff::shell
