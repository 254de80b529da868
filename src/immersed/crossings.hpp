// SPDX-License-Identifier: BSD-3-Clause
// Where sheets cross the grid lines that join cell centres.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"

namespace luff::immersed {

/// One hit of a sheet on the link between the centres of cells P = cell - e_axis and N = cell.
struct Crossing {
  int axis;
  Index3 cell;   ///< the face between P and N is the low face of this cell
  double theta;  ///< (x_hit - x_P)/(x_N - x_P), in [0, 1)
  int triangle;
  std::array<double, 3> weights;  ///< barycentric coordinates of the hit, >= 0, sum 1 to round-off
  int side;                       ///< +1 when the triangle's normal points from P to N, -1 otherwise

  friend bool operator==(const Crossing&, const Crossing&) = default;
};

/// All hits on the links whose face belongs to an owned cell of this rank (owned().faces(axis)), sorted by axis, then
/// k, j, i of the face, then theta.
///
/// Watertight: the hits are those of exact arithmetic on centres moved by an infinitesimal (-e1, -e2, -e3), e1 >> e2 >>
/// e3 > 0, the same for every link and triangle.  Hence no line slips through a shared edge or vertex, none is counted
/// twice, and along every line and around every loop of links a closed surface is crossed as often inwards as outwards.
/// A sheet in a plane of centres normal to x is hit at theta = 0 of the links above it; on an oblique plane through
/// centres some hits lie at theta = 1, given as the largest number below 1.  See docs/numerics/crossings.md.
///
/// Links join centres: along a non-periodic axis none reaches beyond the first or last centre; along a periodic axis
/// the link that wraps around is that of face 0 and of face `cells`, and its hits are listed under both.  A
/// wall-bounded axis of one cell has no links.
///
/// positions: vertices [L], inside the domain along periodic axes, anywhere along the others.
/// triangles: three vertex numbers each; corners counter-clockwise seen from the side the normal points to.  Triangles
/// of no area are never hit.  Differences of coordinates that are not zero lie between 1e-80 and 1e80 [L].
/// Local to the rank, serial; the same face gives the same bits on every rank.
[[nodiscard]] std::vector<Crossing> find_crossings(const grid::Grid& grid, std::span<const Vec3> positions,
                                                   std::span<const std::array<int, 3>> triangles);

/// By axis, then k, j, i of the face, then theta; the triangle settles what is left.
void sort(std::vector<Crossing>& crossings, const Index3& cells);

}  // namespace luff::immersed
