// SPDX-License-Identifier: BSD-3-Clause
// A structured grid shared among ranks.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "core/vec3.hpp"
#include "grid/body_fitted.hpp"
#include "grid/metrics.hpp"
#include "parallel/decomposition.hpp"
#include "parallel/memory.hpp"

namespace luff::grid {

enum class Kind { Uniform, Rectilinear, Curvilinear };

/// A structured block of cells and its metrics.  Uniform and rectilinear grids hold the coordinates of faces and
/// centres along the three axes, whole on every rank; curvilinear ones the nodes of this rank's block.
class Grid {
 public:
  /// faces[a]: strictly increasing face coordinates [L], at least two.  The kind is found from the coordinates: uniform
  /// when every width along every axis is the same to round-off.  Collective over `comm`.
  Grid(MPI_Comm comm, std::array<std::vector<double>, 3> faces, const std::array<bool, 3>& periodic);
  /// A curvilinear grid of `cells` cells, right- or left-handed.  Along periodic axes the last layer of nodes is the
  /// first one moved by a constant, which is zero for a closed ring.  Collective over `comm`.
  Grid(MPI_Comm comm, const Index3& cells, const NodeSource& nodes, const std::array<bool, 3>& periodic);
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  [[nodiscard]] const Decomposition& ranks() const { return ranks_; }
  [[nodiscard]] const IndexBox& owned() const { return ranks_.owned(); }
  [[nodiscard]] const Index3& cells() const { return ranks_.cells(); }
  [[nodiscard]] Kind kind() const { return kind_; }

  /// Mean of the eight nodes of a cell, in the halo too: beyond a side of the domain the mirrored place.
  [[nodiscard]] Vec3 centre(int i, int j, int k) const
  {
    return kind_ == Kind::Curvilinear ? body_fitted_->centre(i, j, k) : Vec3(centre(0, i), centre(1, j), centre(2, k));
  }
  [[nodiscard]] Vec3 centre(const Index3& c) const { return centre(c[0], c[1], c[2]); }
  /// The same of any cell of the domain.  Collective.
  [[nodiscard]] Vec3 centre_of_any(const Index3& c) const;
  /// The low corner of a cell, of this rank's cells and those just above them.
  [[nodiscard]] Vec3 node(int i, int j, int k) const
  {
    return kind_ == Kind::Curvilinear ? body_fitted_->node(i, j, k) : Vec3(face(0, i), face(1, j), face(2, k));
  }
  /// Mean of the four nodes of the low face of a cell normal to an axis.
  [[nodiscard]] Vec3 face_centre(int axis, int i, int j, int k) const;
  /// Area vector of that face, towards increasing index [L^2].
  [[nodiscard]] Vec3 area_vector(int axis, int i, int j, int k) const
  {
    return kind_ == Kind::Curvilinear ? body_fitted_->area_vector(axis, i, j, k)
                                      : Vec3(area(axis, i, j, k) * Vec3::Unit(axis));
  }
  [[nodiscard]] double area(int axis, int i, int j, int k) const;
  [[nodiscard]] double volume(int i, int j, int k) const
  {
    return kind_ == Kind::Curvilinear ? body_fitted_->metric().V(i, j, k) : width(0, i) * width(1, j) * width(2, k);
  }
  /// Smallest distance between opposite faces of a cell.
  [[nodiscard]] double smallest_width() const { return smallest_width_; }

  // Of uniform and rectilinear grids only.

  /// Coordinate of the low face of cell i, i = 0 ... cells.
  [[nodiscard]] double face(int axis, int i) const { return faces_[axis][i]; }
  [[nodiscard]] const std::vector<double>& faces(int axis) const { return faces_[axis]; }
  /// Coordinate of the centre of cell i, i = -1 ... cells (halo cells mirror or repeat their neighbours).
  [[nodiscard]] double centre(int axis, int i) const { return centres_[axis][i + 1]; }
  [[nodiscard]] double width(int axis, int i) const { return widths_[axis][i + 1]; }
  /// Distance between the centres of cells i-1 and i, i = 0 ... cells.
  [[nodiscard]] double distance(int axis, int i) const { return distances_[axis][i]; }
  [[nodiscard]] double length(int axis) const { return faces_[axis].back() - faces_[axis].front(); }

  /// Calls f(metric) with the grid's metric as a compile-time type.
  template <class F>
  decltype(auto) visit(F&& f) const
  {
    if (kind_ == Kind::Curvilinear)
      return std::forward<F>(f)(body_fitted_->metric());
    return kind_ == Kind::Uniform ? std::forward<F>(f)(uniform_) : std::forward<F>(f)(rectilinear_);
  }

 private:
  void make_axis(int axis);
  void make_metrics();

  Decomposition ranks_;
  std::array<std::vector<double>, 3> faces_;
  std::array<std::vector<double>, 3> centres_;  // from index -1
  // Of the metric that kernels read.
  std::array<KernelVector<double>, 3> widths_;     // from index -1
  std::array<KernelVector<double>, 3> distances_;  // from index 0
  std::array<KernelVector<double>, 3> inverse_widths_;
  std::array<KernelVector<double>, 3> inverse_distances_;
  double smallest_width_ = 0.0;
  Kind kind_ = Kind::Rectilinear;
  Uniform uniform_{};
  Rectilinear rectilinear_{};
  std::unique_ptr<const BodyFitted> body_fitted_;  ///< of curvilinear grids
};

}  // namespace luff::grid
