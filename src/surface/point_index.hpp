// SPDX-License-Identifier: BSD-3-Clause
// Which points are close to one another?
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/vec3.hpp"

namespace luff::surface {

/// Finds a point placed before, closer than a distance. Cells of that distance, so that only neighbours are looked at.
class PointIndex {
 public:
  /// A distance of zero stands for points that all coincide; then any other serves.
  PointIndex(const Vec3& origin, double distance) : origin_(origin), distance_(distance > 0 ? distance : 1) {}

  /// Number of an earlier point, or -1.
  int find(const Vec3& p) const
  {
    const Cell cell = cell_of(p);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({cell[0] + i, cell[1] + j, cell[2] + k});
          if (found == cells_.end())
            continue;
          for (const auto& [number, q] : found->second)
            if ((p - q).norm() <= distance_)
              return number;
        }
    return -1;
  }

  void add(int number, const Vec3& p) { cells_[cell_of(p)].emplace_back(number, p); }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& p) const
  {
    const Vec3 c = (p - origin_) / distance_;
    return {std::llround(c.x()), std::llround(c.y()), std::llround(c.z())};
  }

  Vec3 origin_;
  double distance_;
  std::map<Cell, std::vector<std::pair<int, Vec3>>> cells_;
};

}  // namespace luff::surface
