// SPDX-License-Identifier: BSD-3-Clause
// Conditions on the six sides of the domain.
//
//   side       u in the halo cell (mirror of P)     U on the face         p in the halo cell   pressure system
//   velocity   2 u_b - u_P                          S . u_b               p_P                  Neumann
//   wall       2 u_b - u_P  (u_b tangential)        0                     p_P                  Neumann
//   slip       u_P mirrored at the face             0                     p_P                  Neumann
//   symmetry   as slip                              0                     p_P                  Neumann
//   outflow    u_P, or 0 where the flow comes back  S . u_P, projected    -p_P (p = 0 at face) Dirichlet
//   periodic   from the other side                  interior face         from the other side  -
//
// Outflow leaves the flux to the projection, which closes mass exactly with p = 0 on the face; where fluid flows back
// in, it carries u_P/2, which adds no kinetic energy (docs/numerics/boundaries.md).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "parallel/field.hpp"
#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::fluid {

/// A vector field in space and time.  Constants are evaluated once.
struct VectorFunction {
  std::function<Vec3(const Vec3& x, double t)> value;
  bool constant = true;  ///< the same everywhere and always

  static VectorFunction uniform(const Vec3& v)
  {
    return {[v](const Vec3&, double) { return v; }, true};
  }
};

enum class SideKind { Velocity, Wall, Slip, Symmetry, Outflow, Periodic };

struct SideBoundary {
  SideKind kind = SideKind::Slip;
  VectorFunction velocity = VectorFunction::uniform(Vec3::Zero());  ///< of velocity sides and moving walls [L/T]
};

/// [axis][low, high]
using Boundaries = std::array<std::array<SideBoundary, 2>, 3>;

[[nodiscard]] poisson::SideConditions pressure_conditions(const Boundaries& boundaries);
[[nodiscard]] std::array<bool, 3> periodic_axes(const Boundaries& boundaries);

/// Sets halos and boundary fluxes of one rank's block.
class BoundaryConditions {
 public:
  /// Throws InputError when the sides prescribe a net flow and no outflow side can take it.  Collective.
  BoundaryConditions(const grid::Grid& grid, Boundaries boundaries);

  /// Evaluates the prescribed velocities at time t.  Collective.
  void evaluate_at(double t);

  /// Halo of the centre velocity beyond the domain's sides; U tells outflow from backflow.
  void fill_velocity(const View3<double>& u, const View3<const double>& U) const;
  /// Where two sides meet, the halo goes on linearly from the three cells around: u = u_a + u_b - u_P.  The rest of it
  /// must be filled before.
  void extrapolate_edges(const View3<double>& u) const;
  /// Halo of the pressure beyond the domain's sides.
  void fill_pressure(const View<double>& p) const;
  /// U* on the domain's sides; on outflow from the velocity u_old + increment of the cells beside them.
  void set_fluxes(const View3<const double>& u_old, const View3<const double>& increment, const View3<double>& U) const;

  /// Curvilinear grids: the part of the pressure gradient that the closure of the pressure operator leaves out.  It
  /// takes S_b . grad p as zero on sides b where the flux is prescribed; it is what the flow would have run through by,
  ///
  ///   g_b = c dt S_b . grad p = U^n_b + S_b . du_P - U_b,   and   U_t <- U_t - (1/4) G_tb/G_bb g_b
  ///
  /// on the faces t of P that are not prescribed: without it the pressure along a skewed side is wrong in the first row
  /// of cells (docs/numerics/curvilinear.md).  U with the prescribed fluxes, increment with valid halos.  Collective.
  void subtract_side_gradient(const View3<const double>& U_old, const View3<const double>& increment,
                              const View3<double>& U);

  /// Largest prescribed speed at the time of the last evaluation [L/T].
  [[nodiscard]] double largest_speed() const { return largest_speed_; }

 private:
  struct Side {
    int axis = 0;
    int end = 0;                 ///< 0 low, 1 high
    IndexBox cells;              ///< owned cells beside the side
    std::vector<Vec3> velocity;  ///< prescribed, per cell of `cells`, i fastest
    [[nodiscard]] double outward() const { return end == 0 ? -1.0 : 1.0; }
    /// The cell whose low face is the boundary face of a cell.
    [[nodiscard]] Index3 face(const Index3& c) const { return stepped(c, axis, end); }
    [[nodiscard]] Index3 beyond(const Index3& c) const { return stepped(c, axis, end == 0 ? -1 : 1); }
  };
  template <class Visit>
  void for_each_side_cell(const Side& side, Visit visit) const;
  [[nodiscard]] Vec3 area_vector(const Side& side, const Index3& c) const;
  [[nodiscard]] Vec3 velocity_beyond(const Side& side, const Index3& c, const Vec3& inside, const Vec3& prescribed,
                                     bool backflow) const;
  [[nodiscard]] const SideBoundary& boundary(const Side& side) const { return boundaries_[side.axis][side.end]; }
  [[nodiscard]] bool prescribes_flow(const Side& side) const { return boundary(side).kind == SideKind::Velocity; }
  void balance_fluxes();
  void subtract_side_gradient(const Side& side, const View3<double>& U) const;
  [[nodiscard]] bool prescribed(int axis, const Index3& face) const;

  const grid::Grid& grid_;
  Boundaries boundaries_;
  std::vector<Side> sides_;  ///< those that this rank touches
  HaloExchange halo_;
  Field3<double> side_gradient_;  ///< g_b of cells beside sides, on curvilinear grids
  bool has_outflow_ = false;
  bool evaluated_ = false;
  double largest_speed_ = 0.0;
};

}  // namespace luff::fluid
