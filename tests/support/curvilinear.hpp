// SPDX-License-Identifier: BSD-3-Clause
// Curvilinear grids for tests: skewed, stretched, randomly perturbed, left-handed.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "grid/grid.hpp"

namespace luff::test {

/// Nodes x(s), s the relative index in the unit cube.
template <class Map>
grid::NodeSource mapped_nodes(const Index3& cells, Map map)
{
  return grid::node_source([cells, map](int i, int j, int k) -> Vec3 {
    return map(Vec3(double(i) / cells[0], double(j) / cells[1], double(k) / cells[2]));
  });
}

/// The unit cube, its inside waved along all directions: skewed up to the cosine of about 0.55 for an amplitude of 0.1,
/// periodic in shape.
struct Waved {
  double amplitude = 0.06;
  Vec3 operator()(const Vec3& s) const
  {
    using std::numbers::pi;
    const double wave = amplitude * std::sin(2.0 * pi * s[0]) * std::sin(2.0 * pi * s[1]);
    return s + wave * Vec3(1.0, 0.8, 0.0) + 0.5 * amplitude * std::sin(2.0 * pi * s[2]) * Vec3(0.6, -0.4, 0.5) +
           0.3 * amplitude * Vec3(0.0, 0.0, std::sin(2.0 * pi * s[0]));
  }
};

/// The same with the last two directions exchanged: left-handed.
template <class Map>
struct Mirrored {
  Map map;
  Vec3 operator()(const Vec3& s) const { return map({s[0], s[2], s[1]}); }
};

/// Every node moved at random by up to `amplitude` cells; the same on any number of ranks.
struct Perturbed {
  Index3 cells;
  double amplitude = 0.2;
  Vec3 operator()(const Vec3& s) const
  {
    Vec3 x = s;
    unsigned seed = 0;
    for (int a = 0; a < 3; ++a) {
      // Nodes that a period identifies move alike.
      const int index = static_cast<int>(std::lround(s[a] * cells[a])) % cells[a];
      seed = 1009u * seed + static_cast<unsigned>(index) + 17u;
    }
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> noise(-amplitude, amplitude);
    for (int a = 0; a < 3; ++a)
      x[a] += noise(engine) / cells[a];
    return x;
  }
};

}  // namespace luff::test
