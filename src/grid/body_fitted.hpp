// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a curvilinear block: nodes, area vectors, volumes and the metric tensor of one rank's cells.
#pragma once

#include "core/vec3.hpp"
#include "grid/metrics.hpp"
#include "grid/node_source.hpp"
#include "parallel/decomposition.hpp"

namespace luff::grid {

/// Metrics of trilinear cells.  Area vectors are those of the bilinear faces, half the cross product of the diagonals:
/// the six of a cell add up to zero to round-off, so that a uniform flow stays uniform.
class BodyFitted {
 public:
  /// Collective.
  BodyFitted(const Decomposition& ranks, const NodeSource& source);

  [[nodiscard]] const Curvilinear& metric() const { return metric_; }
  [[nodiscard]] Vec3 node(int i, int j, int k) const
  {
    return {metric_.node[0](i, j, k), metric_.node[1](i, j, k), metric_.node[2](i, j, k)};
  }
  [[nodiscard]] Vec3 centre(int i, int j, int k) const;
  [[nodiscard]] Vec3 face_centre(int axis, int i, int j, int k) const;
  [[nodiscard]] Vec3 area_vector(int axis, int i, int j, int k) const
  {
    const auto& S = metric_.S[axis];
    return {S[0](i, j, k), S[1](i, j, k), S[2](i, j, k)};
  }
  /// Smallest of V/|S_a| over cells and directions, S_a at centres.  Over all ranks.
  [[nodiscard]] double smallest_width() const { return smallest_width_; }
  /// +1 when (i, j, k) is a right-handed system, -1 when it is left-handed.
  [[nodiscard]] double handedness() const { return handedness_; }
  /// T_1 . (T_2 x T_3) of the mean edges T_a of a cell, times handedness(): positive unless the cell is folded.
  [[nodiscard]] double jacobian(int i, int j, int k) const;

 private:
  void read_nodes(const Decomposition& ranks, const NodeSource& source);
  void extrapolate_nodes(const Decomposition& ranks);
  void find_handedness(const Decomposition& ranks);
  void make_area_vectors();
  void make_cells(const Decomposition& ranks);
  void repeat_inside(int axis, int end);
  [[nodiscard]] std::array<Vec3, 3> mean_edges(int i, int j, int k) const;
  [[nodiscard]] double exact_volume(int i, int j, int k) const;

  IndexBox owned_;
  Field3<double> nodes_;
  std::array<Field3<double>, 3> area_;
  std::array<Field<double>, 6> tensor_;
  Field<double> volume_;
  double handedness_ = 1.0;
  double smallest_width_ = 0.0;
  Curvilinear metric_{};
};

}  // namespace luff::grid
