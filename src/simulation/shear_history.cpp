// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/shear_history.hpp"

namespace luff::simulation {

void ShearHistory::add(std::span<const Vec3> shear, double dt)
{
  impulse.resize(3 * shear.size(), 0.0);
  magnitude.resize(shear.size(), 0.0);
  time += dt;
  for (std::size_t n = 0; n < shear.size(); ++n) {
    for (int d = 0; d < 3; ++d)
      impulse[3 * n + d] += dt * shear[n][d];
    magnitude[n] += dt * shear[n].norm();
  }
}

double ShearHistory::mean_magnitude(std::size_t place) const
{
  return place < magnitude.size() && time > 0.0 ? magnitude[place] / time : 0.0;
}

double ShearHistory::oscillation(std::size_t place) const
{
  if (place >= magnitude.size() || magnitude[place] == 0.0)
    return 0.0;
  return 0.5 * (1.0 - Eigen::Map<const Vec3>(&impulse[3 * place]).norm() / magnitude[place]);
}

std::vector<Vec3> shear_in_surface(std::span<const immersed::SideTraction> tractions, const Structure& structure,
                                   double t)
{
  const std::vector<Vec3> x = structure.accepted_positions(t);
  std::vector<Vec3> shear;
  shear.reserve(2 * tractions.size());
  for (std::size_t e = 0; e < tractions.size(); ++e) {
    const auto& [a, b, c] = structure.triangles()[e];
    const Vec3 along = (x[b] - x[a]).normalized();
    const Vec3 across = (x[b] - x[a]).cross(x[c] - x[a]).normalized().cross(along);
    for (const Vec3& tau : tractions[e].shear)
      shear.emplace_back(tau.dot(along), tau.dot(across), 0.0);
  }
  return shear;
}

}  // namespace luff::simulation
