// SPDX-License-Identifier: BSD-3-Clause
// A structured grid shared among ranks.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/vec3.hpp"
#include "grid/metrics.hpp"
#include "parallel/decomposition.hpp"

namespace luff::grid {

enum class Kind { Uniform, Rectilinear };

/// Coordinates of faces and centres along the three axes, whole on every rank, and the metrics made from them.
class Grid {
 public:
  /// faces[a]: strictly increasing face coordinates [L], at least two.  The kind is found from the coordinates: uniform
  /// when every width along every axis is the same to round-off.  Collective over `comm`.
  Grid(MPI_Comm comm, std::array<std::vector<double>, 3> faces, const std::array<bool, 3>& periodic);
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  [[nodiscard]] const Decomposition& ranks() const { return ranks_; }
  [[nodiscard]] const IndexBox& owned() const { return ranks_.owned(); }
  [[nodiscard]] const Index3& cells() const { return ranks_.cells(); }
  [[nodiscard]] Kind kind() const { return kind_; }

  /// Coordinate of the low face of cell i, i = 0 ... cells.
  [[nodiscard]] double face(int axis, int i) const { return faces_[axis][i]; }
  [[nodiscard]] const std::vector<double>& faces(int axis) const { return faces_[axis]; }
  /// Coordinate of the centre of cell i, i = -1 ... cells (halo cells mirror or repeat their neighbours).
  [[nodiscard]] double centre(int axis, int i) const { return centres_[axis][i + 1]; }
  [[nodiscard]] Vec3 centre(int i, int j, int k) const { return {centre(0, i), centre(1, j), centre(2, k)}; }
  [[nodiscard]] double width(int axis, int i) const { return widths_[axis][i + 1]; }
  /// Distance between the centres of cells i-1 and i, i = 0 ... cells.
  [[nodiscard]] double distance(int axis, int i) const { return distances_[axis][i]; }
  [[nodiscard]] double area(int axis, int i, int j, int k) const
  {
    const Index3 c{i, j, k};
    const int b = (axis + 1) % 3;
    const int e = (axis + 2) % 3;
    return width(b, c[b]) * width(e, c[e]);
  }
  [[nodiscard]] double volume(int i, int j, int k) const { return width(0, i) * width(1, j) * width(2, k); }
  [[nodiscard]] double smallest_width() const { return smallest_width_; }
  [[nodiscard]] double length(int axis) const { return faces_[axis].back() - faces_[axis].front(); }

  /// Calls f(metric) with the grid's metric as a compile-time type.
  template <class F>
  decltype(auto) visit(F&& f) const
  {
    return kind_ == Kind::Uniform ? std::forward<F>(f)(uniform_) : std::forward<F>(f)(rectilinear_);
  }

 private:
  void make_axis(int axis);
  void make_metrics();

  Decomposition ranks_;
  std::array<std::vector<double>, 3> faces_;
  std::array<std::vector<double>, 3> centres_;    // from index -1
  std::array<std::vector<double>, 3> widths_;     // from index -1
  std::array<std::vector<double>, 3> distances_;  // from index 0
  std::array<std::vector<double>, 3> inverse_widths_;
  std::array<std::vector<double>, 3> inverse_distances_;
  double smallest_width_ = 0.0;
  Kind kind_ = Kind::Rectilinear;
  Uniform uniform_{};
  Rectilinear rectilinear_{};
};

}  // namespace luff::grid
