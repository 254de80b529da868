// SPDX-License-Identifier: BSD-3-Clause
// Energy, force and tangents of a triangle from its section, with a constant or a smoothed membrane strain.
#pragma once

#include "shell/membrane.hpp"

namespace luff::shell {

/// Stored energy. `membrane`: null for the constant strain, here and below.
template <class Section>
double element_energy(const Section& section, const Element& e, const SmoothedMembrane* membrane,
                      const NodePositions& y)
{
  const ElementKinematics k = kinematics(e, y);
  if (!membrane)
    return e.area * section.energy(k.E_membrane, k.E_bending, e.fibre);
  double sum = 0;
  for (const Vec3& E : smoothed_strains(*membrane, k, y).E)
    sum += section.energy(E, k.E_bending, e.fibre);
  return e.area / 3 * sum;
}

/// Gradient of the energy in the nodes' positions.
template <class Section>
NodeForces element_force(const Section& section, const Element& e, const SmoothedMembrane* membrane,
                         const NodePositions& y)
{
  const ElementKinematics k = kinematics(e, y);
  const auto resultants = [&](const Vec3& E) { return section.resultants(E, k.E_bending, e.fibre); };
  if (!membrane)
    return nodal_forces(e, k, resultants(k.E_membrane));
  const SmoothedStrains strains = smoothed_strains(*membrane, k, y);
  return nodal_forces(e, k, *membrane, strains,
                      {resultants(strains.E[0]), resultants(strains.E[1]), resultants(strains.E[2])});
}

/// Its part A B'DB.
template <class Section>
ElementTangent element_stiffness(const Section& section, const Element& e, const SmoothedMembrane* membrane,
                                 const NodePositions& y)
{
  const ElementKinematics k = kinematics(e, y);
  const auto stiffness = [&](const Vec3& E) { return section.stiffness(E, k.E_bending, e.fibre); };
  if (!membrane)
    return material_tangent(e, k, stiffness(k.E_membrane), section.couples);
  const SmoothedStrains strains = smoothed_strains(*membrane, k, y);
  return material_tangent(e, k, *membrane, strains,
                          {stiffness(strains.E[0]), stiffness(strains.E[1]), stiffness(strains.E[2])}, section.couples);
}

/// Hessian of the energy.
template <class Section>
ElementTangent element_tangent(const Section& section, const Element& e, const SmoothedMembrane* membrane,
                               const NodePositions& y)
{
  const ElementKinematics k = kinematics(e, y);
  const auto response = [&](const Vec3& E) { return section.response(E, k.E_bending, e.fibre); };
  if (!membrane) {
    const SectionResponse at = response(k.E_membrane);
    ElementTangent tangent = material_tangent(e, k, at.stiffness, section.couples);
    add_geometric_tangent(e, k, at.resultants, tangent);
    return tangent;
  }
  const SmoothedStrains strains = smoothed_strains(*membrane, k, y);
  const PerEdge<SectionResponse> at{response(strains.E[0]), response(strains.E[1]), response(strains.E[2])};
  ElementTangent tangent =
      material_tangent(e, k, *membrane, strains, {at[0].stiffness, at[1].stiffness, at[2].stiffness}, section.couples);
  add_geometric_tangent(e, k, *membrane, {at[0].resultants, at[1].resultants, at[2].resultants}, tangent);
  return tangent;
}

}  // namespace luff::shell
