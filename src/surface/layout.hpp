// SPDX-License-Identifier: BSD-3-Clause
// Where the vertices of a regular mesh lie in the plane of its two parameters, and how they are joined.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace luff::surface {

struct Node {
  double u = 0;
  double v = 0;
  double du = 0;  ///< how far a move by one spacing goes in u
  double dv = 0;
  bool inner = false;  ///< not on the boundary
};

/// Nodes along a side, in order; a side that shrinks to a pole has one.
struct Side {
  std::vector<int> nodes;
  bool closed = false;  ///< from the last node on to the first
};

/// Corners run counter-clockwise in the plane of u and v.
struct Layout {
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> quadrilaterals;  ///< still to be cut in two
  std::vector<std::array<int, 3>> triangles;
  std::map<std::string, Side> sides;  ///< those there are of u_min, u_max, v_min, v_max
};

/// \throws InputError that starts with `shape` for divisions below 1, or more cells than can be numbered.
void check_divisions(std::string_view shape, const std::array<int, 2>& divisions);

enum class Around { Open, Closed };

/// Place in 0 to 1 of this fraction of the divisions when spacings grow by a constant factor from one to the next, by
/// `growth` over all: (growth^fraction - 1)/(growth - 1).
double graded(double fraction, double growth);

/// Node (i, j), at u = i, v = j, has number i (divisions[1] + 1) + j. Closed: u = divisions[0] is u = 0 again.
Layout grid_layout(const std::array<int, 2>& divisions, Around around);

/// Rings about a pole, cut into sectors. On ring k every sector has min(k, rings_to_far_pole - k) intervals, so that
/// the mesh is made of near-equilateral triangles; ring 0 is the pole, ring rings_to_far_pole the opposite one.
struct Fan {
  int rings;
  int rings_to_far_pole;  ///< at least `rings`
  int sectors;
  Around around;
};

/// Node c of ring k is at u = k, v = c / (number of intervals on the ring), 0 <= v <= 1; rings follow one another.
Layout fan_layout(const Fan& fan);

}  // namespace luff::surface
