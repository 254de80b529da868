// SPDX-License-Identifier: BSD-3-Clause
// The cross-section at one side of the domain, and the developed flows through it.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "fluid/side_gradient.hpp"
#include "grid/grid.hpp"

namespace luff::fluid {

/// The faces of one side as a surface grid of their own, whole on every rank.  Faces are numbered as the cells beside
/// the side, the lower of the two other axes fastest.
class Section {
 public:
  /// no_slip[a][end]: whether the fluid sticks to the side that the section's rim touches at this end of its a-th axis,
  /// the other two axes in increasing order; at other rims nothing shears.  Collective.
  Section(const grid::Grid& grid, int axis, int end, const std::array<std::array<bool, 2>, 2>& no_slip);

  [[nodiscard]] const std::array<int, 2>& faces() const { return n_; }
  [[nodiscard]] const std::vector<double>& areas() const { return area_; }
  /// Whether the fluid sticks anywhere along the rim.
  [[nodiscard]] bool has_wall() const;

  /// The solution of the section's own problem
  ///
  ///   lambda w - lap_s w = c,   w = 0 where the fluid sticks,   dw/dn = 0 elsewhere,   sum_f |S_f| w_f = 1,
  ///
  /// at the faces [1/L^2]: of lambda = 0 the developed steady profile, of lambda = i omega/nu the developed oscillating
  /// one [womersley_1955_method].  Needs a wall when lambda = 0.
  ///
  /// Two-dimensional finite volumes on the faces with their surface metric, cross terms included; on rectilinear grids
  /// the flow's own Laplacian, so that a developed flow enters as the flow itself would have it.
  [[nodiscard]] std::vector<std::complex<double>> developed_flow(std::complex<double> lambda) const;

 private:
  /// G_11, G_22, G_12 of a face: sqrt(g) times the inverse of its metric tensor.
  using Tensor = std::array<double, 3>;
  /// Difference of w across one edge of a face, along increasing index: sum of weight x w over up to two faces.
  struct Difference {
    std::array<int, 2> face{};
    std::array<double, 2> weight{};
    int count = 0;  ///< 0 at a rim without shear
    bool at_wall = false;
  };
  [[nodiscard]] int number(const std::array<int, 2>& f) const { return f[0] + n_[0] * f[1]; }
  [[nodiscard]] Difference difference(const std::array<int, 2>& face, int a, int end) const;
  [[nodiscard]] int beside(const std::array<int, 2>& face, int a, int end) const;
  [[nodiscard]] WallDerivative wall_shear(const std::array<int, 2>& face, int a, int end) const;

  std::array<int, 2> n_{};
  std::array<bool, 2> periodic_{};
  std::array<std::array<bool, 2>, 2> no_slip_{};
  std::vector<double> area_;
  std::vector<Vec3> centre_;
  std::vector<std::array<Vec3, 4>> corners_;  ///< of each face: the first axis fastest
  std::vector<Tensor> metric_;
};

}  // namespace luff::fluid
