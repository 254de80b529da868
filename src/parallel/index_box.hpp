// SPDX-License-Identifier: BSD-3-Clause
// Boxes of global cell indices.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace luff {

using Index3 = std::array<int, 3>;

/// The cell `by` cells away along an axis.
[[nodiscard]] inline Index3 stepped(Index3 cell, int axis, int by)
{
  cell[axis] += by;
  return cell;
}

/// The cells (i, j, k) with lo <= (i, j, k) < hi.  Indices are global: every rank numbers the same cell alike.
struct IndexBox {
  Index3 lo{0, 0, 0};
  Index3 hi{0, 0, 0};

  [[nodiscard]] int extent(int axis) const { return std::max(0, hi[axis] - lo[axis]); }
  [[nodiscard]] std::ptrdiff_t volume() const { return static_cast<std::ptrdiff_t>(extent(0)) * extent(1) * extent(2); }
  [[nodiscard]] bool contains(int i, int j, int k) const
  {
    return i >= lo[0] && i < hi[0] && j >= lo[1] && j < hi[1] && k >= lo[2] && k < hi[2];
  }
  [[nodiscard]] bool contains(const Index3& c) const { return contains(c[0], c[1], c[2]); }
  /// Place of a cell in a list of the cells of the box, i fastest, then j.
  [[nodiscard]] std::ptrdiff_t position(const Index3& c) const
  {
    return (c[0] - lo[0]) + static_cast<std::ptrdiff_t>(extent(0)) *
                                ((c[1] - lo[1]) + static_cast<std::ptrdiff_t>(extent(1)) * (c[2] - lo[2]));
  }

  /// The box widened by n cells on every side.
  [[nodiscard]] IndexBox grown(int n) const
  {
    return {{lo[0] - n, lo[1] - n, lo[2] - n}, {hi[0] + n, hi[1] + n, hi[2] + n}};
  }
  /// The box widened by n cells at its high end along one axis: the faces of its cells normal to that axis.
  [[nodiscard]] IndexBox faces(int axis) const
  {
    IndexBox box = *this;
    ++box.hi[axis];
    return box;
  }

  friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

[[nodiscard]] inline IndexBox intersection(const IndexBox& a, const IndexBox& b)
{
  IndexBox box;
  for (int d = 0; d < 3; ++d) {
    box.lo[d] = std::max(a.lo[d], b.lo[d]);
    box.hi[d] = std::max(box.lo[d], std::min(a.hi[d], b.hi[d]));
  }
  return box;
}

}  // namespace luff
