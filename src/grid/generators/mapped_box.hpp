// SPDX-License-Identifier: BSD-3-Clause
// Grids whose nodes are those of a box, put elsewhere: annuli, channels, and any map of the user's own.
#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <vector>

#include "grid/generators/centreline.hpp"
#include "grid/node_source.hpp"

namespace luff::grid {

/// faces[a]: increasing coordinates of the box's nodes along axis a, at least two.  Directions xi, eta, zeta are x, y,
/// z of the box.
[[nodiscard]] CurvilinearNodes make_mapped_box(std::array<std::vector<double>, 3> faces,
                                               std::function<Vec3(const Vec3&)> map);

struct AnnulusShape {
  CurvePoint start;             ///< centre of the first end; t along the axis, angles from e1 towards e2
  std::vector<double> radii;    ///< of the nodes [L], increasing, positive
  std::vector<double> angles;   ///< of the nodes [radians], increasing, by a whole turn at most
  std::vector<double> heights;  ///< of the nodes along the axis [L], increasing
};

/// The space between two cylinders about one axis: xi outwards, eta around, zeta along the axis.  A whole turn is a
/// ring whose last nodes are its first ones, to the last bit.
[[nodiscard]] CurvilinearNodes make_annulus(const AnnulusShape& shape);

struct ChannelShape {
  std::vector<double> x;                ///< of the nodes along the channel [L], increasing
  std::vector<double> fractions;        ///< of the nodes from the lower wall (0) to the upper (1), increasing
  std::vector<double> z;                ///< of the nodes [L], increasing
  std::function<double(double)> lower;  ///< y of the walls [L] at x
  std::function<double(double)> upper;
};

/// A channel between two walls that may diverge or converge: xi along x, eta from wall to wall along y, zeta along z.
/// Throws InputError, naming x, where the walls are no numbers or meet.
[[nodiscard]] CurvilinearNodes make_channel(const ChannelShape& shape);

}  // namespace luff::grid
