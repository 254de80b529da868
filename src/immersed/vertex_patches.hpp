// SPDX-License-Identifier: BSD-3-Clause
// Vertices closer to each other than cells, as the flow sees them: together.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "immersed/loads.hpp"

namespace luff::immersed {

/// A hit samples the area of a cell.  Where triangles are smaller, its force is no one vertex's: it goes to all
/// vertices w that lie less than a cell away along the sheet, as to a rigid patch.  With weights A_w (1 - |q_w|/0.9),
/// A_w the area around w and q_w its distance from the vertex v in cells, W their sum, y the centre of the patch, eta_w
/// = x_w - y, r = x_v - y and J = sum w_w (|eta|^2 I - eta eta^T),
///
///   f_w = w_w (F/W + J^-1 (r x F) x eta_w),
///
/// which has the force and the moment of F.  The flow sees at v the transpose,
///
///   u'_v = sum w_w u_w/W + Omega x r,   Omega = J^-1 sum w_w eta_w x u_w,
///
/// the velocity of the rigid motion that is nearest to the patch's: what the flow does on the sheet is what the sheet
/// gets.  Vertices without others within 0.9 cells keep what is theirs, to the last bit.
class VertexPatches {
 public:
  VertexPatches() = default;
  /// None until update(): around the first `count` vertices of the triangles.
  VertexPatches(std::span<const std::array<int, 3>> triangles, int count);

  /// Finds the patches around vertices that are here now.  Collective.
  void update(const grid::Grid& grid, std::span<const Vec3> positions);

  /// Whether any patch has more than one vertex.
  [[nodiscard]] bool any() const { return !patches_.empty(); }
  /// Forces on vertices, spread over the patches around them.
  [[nodiscard]] SheetLoads spread(SheetLoads loads) const;
  /// Velocities (or accelerations) of vertices, as the flow sees them.
  [[nodiscard]] std::vector<Vec3> seen(std::span<const Vec3> velocity) const;

 private:
  struct Member {
    int vertex = 0;
    double weight = 0.0;  ///< w_w/W
    Vec3 arm;             ///< eta_w
  };
  struct Patch {
    int vertex = 0;  ///< v
    int first = 0;   ///< among the members
    int last = 0;
    Vec3 arm;      ///< r
    Mat3 inverse;  ///< W J^-1
  };
  [[nodiscard]] std::vector<double> areas(std::span<const Vec3> positions) const;
  void add_patch(int vertex, const std::vector<Member>& members, std::span<const Vec3> positions);
  void spread(std::vector<Vec3>& forces) const;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::vector<int>> around_;  ///< of each vertex with a patch: others that share a triangle with it
  std::vector<Patch> patches_;
  std::vector<Member> members_;
};

}  // namespace luff::immersed
