// SPDX-License-Identifier: BSD-3-Clause
// How large the shear on surfaces is over time, and how much it turns round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "fluid/flow_solver.hpp"
#include "simulation/structure.hpp"

namespace luff::simulation {

/// Of many places, over all steps added so far [ku_1985_pulsatile],
///
///   TAWSS = 1/T int |tau| dt,   OSI = 1/2 (1 - |int tau dt|/int |tau| dt),
///
/// tau that of the end of each step.  OSI is 0 where the shear keeps its direction, 1/2 where it has none in the mean.
struct ShearHistory {
  /// One shear stress per place, always in the same order [M/(L T^2)].
  void add(std::span<const Vec3> shear, double dt);
  /// Time-averaged wall shear stress of a place; 0 before anything was added.
  [[nodiscard]] double mean_magnitude(std::size_t place) const;
  /// Oscillatory shear index of a place; 0 where there was no shear.
  [[nodiscard]] double oscillation(std::size_t place) const;

  double time = 0.0;              ///< T [T]
  std::vector<double> impulse;    ///< int tau dt, three numbers per place [M/(L T)]
  std::vector<double> magnitude;  ///< int |tau| dt
};

/// The shear on both sides of all triangles, - and + side of each in turn, its part in the triangle's plane along and
/// across the triangle's first edge: a frame that goes with the surface.  Of the accepted state at t.
[[nodiscard]] std::vector<Vec3> shear_in_surface(std::span<const immersed::SideTraction> tractions,
                                                 const Structure& structure, double t);

}  // namespace luff::simulation
