// SPDX-License-Identifier: BSD-3-Clause
// The velocity gradient on faces of the domain's sides where the velocity is prescribed, of second order on grids of
// any kind (docs/numerics/boundaries.md).
#pragma once

#include <array>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "parallel/field.hpp"

namespace luff::fluid {

/// Weights of the derivative at a wall along a line that leaves it, f' = near (f_1 - f_wall) + far (f_2 - f_wall), of
/// values at the distances s_1 < s_2: exact for parabolas.
struct WallDerivative {
  double near = 0.0;
  double far = 0.0;

  static WallDerivative at(double s_1, double s_2) { return {s_2 / (s_1 * (s_2 - s_1)), -s_1 / (s_2 * (s_2 - s_1))}; }
  static WallDerivative at(double s_1) { return {1.0 / s_1, 0.0}; }
};

/// One side of one rank's block.  With x_f the centre of a face, D_s the derivative along the line of the centres of
/// the face, the cell beside it and the next one, D_1 and D_2 differences between neighbouring faces,
///
///   grad u = (D_s u, D_1 u_b, D_2 u_b) (D_s x, D_1 x_f, D_2 x_f)^-1,
///
/// exact where u is linear.  Where the side ends, D_1 and D_2 are one-sided over three faces, over two where a block
/// has no third.
///
/// Velocities at centres come from the fluxes of opposite faces, S_c u = <U>: they differ from those of the fluid by
///
///   delta = S_c^-1 r/8,   r_b = d_b^2 U_b - (d_b^2 S_b) . u,
///
/// d_b^2 the second difference from face to face along direction b.  The prescribed velocity is changed by the same
/// before D_s is taken: else an error of h^2 between it and the cell beside makes one of h in the gradient.
class SideGradient {
 public:
  /// cells: the owned cells beside the side.
  SideGradient(const grid::Grid& grid, int axis, int end, const IndexBox& cells);

  /// Prescribed velocities of `cells` and of the cells next to them along the side.
  class Prescribed {
   public:
    explicit Prescribed(const IndexBox& box) : box_(box), values_(box.volume()) {}
    [[nodiscard]] const Vec3& operator()(const Index3& c) const { return values_[box_.position(c)]; }
    [[nodiscard]] Vec3& operator()(const Index3& c) { return values_[box_.position(c)]; }

   private:
    IndexBox box_;
    std::vector<Vec3> values_;
  };

  /// u with valid halos, which mirror it about the prescribed values.
  [[nodiscard]] Prescribed prescribed(const View3<const double>& u) const;

  /// (grad u)_ij = du_i/dx_j at the face of a cell of `cells` [1/T]; u recovered from the fluxes U, u_b of this u.
  [[nodiscard]] Mat3 at(const View3<const double>& u, const View3<const double>& U, const Prescribed& u_b,
                        const Index3& c) const;

  /// A value at the face, from the straight line through the cell beside it and the next one.
  [[nodiscard]] double extrapolated(const View<const double>& p, const Index3& c) const;

  /// What a cell of `cells` loses through its face on the side per its own velocity, -d(S . grad u)/du_P [L].
  [[nodiscard]] double conductance(const Index3& c) const { return face(c).through[0] * -face(c).normal.near; }

  /// S . grad u, S out of the domain, less what the stencils of the momentum equation take for it from the mirrored
  /// halo [L^2/T].
  [[nodiscard]] Vec3 missing_flux(const View3<const double>& u, const View3<const double>& U, const Prescribed& u_b,
                                  const Index3& c) const;

 private:
  /// A difference between three faces in a row along one index direction.
  struct Difference {
    int from = 0;                    ///< steps to the first of them
    std::array<double, 3> weight{};  ///< of the first difference
    std::array<double, 3> second{};  ///< of the second
    /// Nothing is known of what changes along the only cell of an axis.
    [[nodiscard]] bool alone() const { return weight == std::array<double, 3>{}; }
  };
  /// D_m u_b and d_m^2 u_b along one index direction.
  struct Differences {
    Vec3 first;
    Vec3 second;
  };
  struct Face {
    WallDerivative normal;
    std::array<Difference, 2> along;
    double beyond = 0.0;           ///< distance of the face from the cell beside it over that to the next one
    Mat3 reciprocal;               ///< rows: what D_s, D_1, D_2 are multiplied with
    Vec3 outward;                  ///< area vector out of the domain
    Vec3 through;                  ///< reciprocal times outward: what D_s, D_1, D_2 add to the flux
    Mat3 recovery;                 ///< S_c^-1/8, columns: the side's axis and the two along it
    Vec3 bend = Vec3::Zero();      ///< d_a^2 S_a of the side's axis
    std::array<Vec3, 2> area;      ///< S_b of the two directions along the side
    std::array<Vec3, 2> widening;  ///< and their differences across the cell
  };
  [[nodiscard]] Index3 inwards(const Index3& c, int by) const { return stepped(c, axis_, end_ == 0 ? by : -by); }
  [[nodiscard]] const Face& face(const Index3& c) const;
  [[nodiscard]] Difference difference(int axis, const Index3& c) const;
  [[nodiscard]] Face make_face(const Index3& c) const;
  [[nodiscard]] std::array<Differences, 2> along_side(const Prescribed& u_b, const Index3& c) const;
  [[nodiscard]] Vec3 derivative_inwards(const View3<const double>& u, const View3<const double>& U,
                                        const Prescribed& u_b, const Index3& c,
                                        const std::array<Differences, 2>& along) const;
  [[nodiscard]] bool has_second_cell() const;
  [[nodiscard]] Index3 low_face(const Index3& c, int inwards) const;
  void prepare_recovery(const Index3& c, Face& face) const;
  [[nodiscard]] Vec3 recovery_defect(const View3<const double>& U, const Prescribed& u_b, const Index3& c,
                                     const std::array<Differences, 2>& along) const;
  [[nodiscard]] Vec3 mirrored_flux(const View3<const double>& u, const Prescribed& u_b, const Index3& c) const;

  const grid::Grid* grid_;
  int axis_;
  int end_;
  std::array<int, 2> along_;
  IndexBox cells_;
  std::vector<Face> faces_;  ///< of `cells`, i fastest
};

}  // namespace luff::fluid
