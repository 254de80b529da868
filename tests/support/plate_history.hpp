// SPDX-License-Identifier: BSD-3-Clause
// The force on a plate over time, moving through the grid or fixed in a stream, and its noise.
#pragma once

#include "support/plates.hpp"

namespace luff::test {

/// A plate of length 1 that moves at speed 1 against fluid: through still fluid (stream 0), or fixed in a stream (1).
struct PlateRun {
  double stream = 0.0;
  double dt = 0.005;
  Vec3 centre{0.007, 0.003, 0.0};
  double degrees = 70.0;
  double h = 0.04;
  double viscosity = 0.01;
  double end = 2.0;
  fluid::ImmersedScheme scheme = fluid::ImmersedScheme::CutLink;
  bool edges_cover_in_part = false;
};

/// Force coefficients over time.
struct History {
  double dt = 0.0;
  std::vector<Vec3> force;               ///< at the ends of steps, with the pressure extrapolated: what sheets feel
  std::vector<Vec3> without_pressure{};  ///< of these
  std::vector<Vec3> pressure{};          ///< what the pressure does in the middle of the steps

  /// With the pressure interpolated between steps, as runs report it.
  [[nodiscard]] History as_reported() const
  {
    History reported{.dt = dt, .force = force};
    for (std::size_t n = 0; n + 1 < force.size(); ++n)
      reported.force[n] = without_pressure[n] + 0.5 * (pressure[n] + pressure[n + 1]);
    return reported;
  }

  /// The part after the start-up.
  [[nodiscard]] std::size_t settled() const { return static_cast<std::size_t>(std::lround(0.8 / dt)); }
  [[nodiscard]] Vec3 mean() const
  {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = settled(); n < force.size(); ++n)
      sum += force[n];
    return sum / static_cast<double>(force.size() - settled());
  }
};

inline History history_of(const PlateRun& run)
{
  const double h = run.h;
  const int cells = static_cast<int>(std::lround(4.0 / h));
  const int across = static_cast<int>(std::lround(1.6 / h));
  const Slab slab{.x = {-5.0, 4.0, cells + 32, grid::Refinement{-2.8, 1.2, h}},
                  .y = {-3.0, 3.0, across + 34, grid::Refinement{-0.8, 0.8, h}},
                  .depth = h,
                  .stream = run.stream,
                  .viscosity = run.viscosity};
  const Plate plate{.degrees = run.degrees, .centre = run.centre, .velocity = {run.stream - 1.0, 0.0, 0.0}};
  const auto flow =
      make_flow(slab, MPI_COMM_WORLD,
                {.immersed = run.scheme, .edges_cover_in_part = run.edges_cover_in_part, .viscosity = slab.viscosity});
  History history{.dt = run.dt, .force = {}};
  for (int n = 0; n < std::lround(run.end / run.dt); ++n) {
    flow->step(run.dt, plate.at(flow->t + run.dt, slab.depth));
    history.force.push_back(coefficients(total_force(flow->solver.loads()), slab.depth));
    flow->solver.accept();
    flow->solver.fill_halos();
    const fluid::PressureLoads pressure = flow->solver.pressure_loads();
    history.without_pressure.push_back(history.force.back() - coefficients(total_force(pressure.at_end), slab.depth));
    history.pressure.push_back(coefficients(total_force(pressure.in_middle), slab.depth));
  }
  return history;
}

/// Root mean square of what a running cubic fit over `window` leaves of the force along x.
inline double noise(const History& history, double window)
{
  const int m = static_cast<int>(std::lround(0.5 * window / history.dt));
  double square = 0.0;
  int count = 0;
  // The cubic's value in the middle of the window: weights of Savitzky and Golay.
  const double w0 = (3.0 * m * (m + 1.0) - 1.0) * 3.0;
  const double scale = (2.0 * m + 1.0) * (4.0 * m * (m + 1.0) - 3.0);
  for (std::size_t n = history.settled() + m; n + m < history.force.size(); ++n) {
    double smooth = 0.0;
    for (int k = -m; k <= m; ++k)
      smooth += (w0 - 15.0 * k * k) / scale * history.force[n + k][0];
    square += std::pow(history.force[n][0] - smooth, 2);
    ++count;
  }
  return std::sqrt(square / count);
}

}  // namespace luff::test
