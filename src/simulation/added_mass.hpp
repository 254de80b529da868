// SPDX-License-Identifier: BSD-3-Clause
// How heavy the fluid is that moves with shells, and what follows for coupling.
#pragma once

#include <string>

#include "simulation/simulation.hpp"

namespace luff::simulation {

/// Largest ratio of added mass to the shells' own at which loose coupling is stable with this scheme of the shells, for
/// any length of the steps (docs/numerics/coupling.md); 1/4 with Newmark's average acceleration.
[[nodiscard]] double loose_limit(const shell::TimeScheme& scheme);

/// How much the fluid weighs that resists the motion of the shells in which it is heaviest, over their own mass there
/// [causin_2005_added]: the largest eigenvalue mu of
///
///   -(1 - alpha_m)/((1 - alpha_f) gamma) S'(F(d) - F(d^0)),   alpha_m, alpha_f, gamma of the shells' scheme,
///
/// F the forces of the flow's last stage, S' the shells' answer in a step.  Without stiffness this is M_s^-1 M_a, M_a
/// the added mass with the geometry, the walls and the grid of the case; stiffness keeps single vertices from moving
/// alone. By power iteration from a motion along the normals, at the start of the run, with as many projections as it
/// takes to know mu to two per cent, at most ten.  Of a simulation that has a flow and shells and has not begun; its
/// accepted state stays as it is.  Collective.
[[nodiscard]] double added_mass_ratio(Simulation& simulation);

/// The mass that the shells borrow in coupling iterations (shell::Dynamics::borrow_mass) so that the fluid that moves
/// with them is at most ten times as heavy; in parts of their own, zero where they are heavy enough.
[[nodiscard]] double borrowed_mass(double added_mass_ratio);

/// What that means for a simulation, by the scheme that couples it, in words.
[[nodiscard]] std::string describe_coupling(double added_mass_ratio, Simulation& simulation);

}  // namespace luff::simulation
