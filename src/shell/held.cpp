// SPDX-License-Identifier: BSD-3-Clause
// Displacements that supports hold: which, along what, and where they take them.
#include "shell/held.hpp"

namespace luff::shell {

void Held::append(const Held& other)
{
  const int first_vertex = static_cast<int>(flags.size() / 3), first_motion = static_cast<int>(motions.size());
  flags.insert(flags.end(), other.flags.begin(), other.flags.end());
  motions.insert(motions.end(), other.motions.begin(), other.motions.end());
  for (const auto& [vertex, free] : other.oblique)
    oblique.push_back({vertex + first_vertex, free});
  for (const auto& [vertex, components, motion] : other.moved)
    moved.push_back({vertex + first_vertex, components, motion + first_motion});
}

void Held::clear(Eigen::VectorXd& v) const
{
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i])
      v[static_cast<Eigen::Index>(i)] = 0;
  for (const auto& [vertex, free] : oblique)
    v.segment<3>(3 * vertex) = (free * v.segment<3>(3 * vertex)).eval();
}

void Held::place(const Eigen::VectorXd& X, double t, double factor, Eigen::VectorXd& x) const
{
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i])
      x[static_cast<Eigen::Index>(i)] = X[static_cast<Eigen::Index>(i)];
  for (const auto& [vertex, free] : oblique) {
    const Vec3 here = X.segment<3>(3 * vertex);
    x.segment<3>(3 * vertex) = (here + free * (x.segment<3>(3 * vertex) - here)).eval();
  }
  for (const auto& [vertex, components, motion] : moved) {
    const Vec3 there = motions[motion].position(X.segment<3>(3 * vertex), t, factor);
    for (int d = 0; d < 3; ++d)
      if (components[d])
        x[3 * vertex + d] = there[d];
  }
}

Held::HeldRates Held::rates(const Eigen::VectorXd& X, double t_velocity, double t_acceleration, double dt) const
{
  HeldRates now{Eigen::VectorXd::Zero(X.size()), Eigen::VectorXd::Zero(X.size())};
  for (const auto& [vertex, components, motion] : moved) {
    const Vec3 here = X.segment<3>(3 * vertex);
    const Vec3 velocity = motions[motion].rates(here, t_velocity, dt).velocity;
    const Vec3 acceleration = motions[motion].rates(here, t_acceleration, dt).acceleration;
    for (int d = 0; d < 3; ++d)
      if (components[d]) {
        now.velocity[3 * vertex + d] = velocity[d];
        now.acceleration[3 * vertex + d] = acceleration[d];
      }
  }
  return now;
}

void Held::decouple(BlockMatrix& K, double weight) const
{
  const BlockPattern& pattern = K.pattern();
  for (const auto& [vertex, free] : oblique) {
    auto diagonal = K.block(pattern.slot(vertex, vertex));
    const double size = diagonal.diagonal().cwiseAbs().maxCoeff();
    for (int s = pattern.row_start[vertex]; s < pattern.row_start[vertex + 1]; ++s) {
      auto beyond = K.block(s);
      auto before = K.block(pattern.slot(pattern.column[s], vertex));
      beyond = (free * beyond).eval();
      before = (before * free).eval();
    }
    diagonal += weight * size * (Mat3::Identity() - free);
  }
}

}  // namespace luff::shell
