// SPDX-License-Identifier: BSD-3-Clause
// Do surfaces pass through each other or through themselves?
#pragma once

#include "shell/contact/pieces.hpp"

namespace luff::shell {

/// Edges that pierce triangles they share no vertex with.
struct Crossings {
  int count = 0;
  int vertex = -1;  ///< an end of the first such edge
  Vec3 place = Vec3::Zero();
};

/// Of all surfaces with each other and, if `self`, with themselves. Rigid bodies may cross one another.
/// An edge that only touches a triangle doesn't count.
Crossings crossings(const ContactPieces& pieces, const Eigen::VectorXd& x, bool self);

/// Does the edge from a to b pass through the inside of the triangle?
bool pierces(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

}  // namespace luff::shell
