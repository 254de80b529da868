// SPDX-License-Identifier: BSD-3-Clause
// Conditions on the six sides of the domain.
//
//   side       u in the halo cell (mirror of P)     U on the face          p in the halo cell   pressure system
//   velocity   2 u_b - u_P                          S . u_b                p_P                  Neumann
//   flow rate  as velocity, u_b = -w n              -w |S|, sum Q          p_P                  Neumann
//   wall       2 u_b - u_P  (u_b tangential)        0                      p_P                  Neumann
//   slip       u_P - 2 (u_P . n) n                  0                      p_P                  Neumann
//   symmetry   as slip                              0                      p_P                  Neumann
//   outflow    u_P                                  S . u_P, projected     -p_P (p = 0 at face) Dirichlet
//   pressure   u_P                                  S . u_P, projected     2 p_b - p_P          Dirichlet
//   periodic   from the other side                  interior face          from the other side  -
//
// n points out of the domain, S along increasing index.  Outflow leaves the flux to the projection, which closes mass
// exactly with p = 0 on the face.  Fluid that comes in through an outflow or pressure side carries u_P/2 by convection,
// which adds no kinetic energy (docs/numerics/boundaries.md).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/vec3.hpp"
#include "fluid/inflow.hpp"
#include "fluid/side_gradient.hpp"
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

/// A scalar field in space and time.  Constants are evaluated once.
struct ScalarFunction {
  std::function<double(const Vec3& x, double t)> value;
  bool constant = true;

  static ScalarFunction uniform(double v)
  {
    return {[v](const Vec3&, double) { return v; }, true};
  }
};

enum class SideKind { Velocity, Wall, Slip, Symmetry, Outflow, Pressure, Periodic };

/// How fluid enters through a pressure side: from a reservoir at rest, whose pressure is given (a total pressure,
/// stable whatever the stream does), or with the velocity that it has inside (a static pressure; for streams that stay
/// the same way in).
enum class Entering { Reservoir, Developed };

struct SideBoundary {
  SideKind kind = SideKind::Slip;
  VectorFunction velocity = VectorFunction::uniform(Vec3::Zero());  ///< of velocity sides and moving walls [L/T]
  std::optional<FlowRate> flow_rate = std::nullopt;                 ///< of velocity sides, instead of `velocity`
  ScalarFunction pressure = ScalarFunction::uniform(0.0);           ///< of pressure sides, kinematic [L^2/T^2]
  Entering entering = Entering::Reservoir;
};

/// [axis][low, high]
using Boundaries = std::array<std::array<SideBoundary, 2>, 3>;

[[nodiscard]] poisson::SideConditions pressure_conditions(const Boundaries& boundaries);
[[nodiscard]] std::array<bool, 3> periodic_axes(const Boundaries& boundaries);

/// What the fluid exerts on the faces of one side where its velocity is prescribed, per density.
struct SideStress {
  int axis = 0;
  int end = 0;                   ///< 0 low, 1 high
  IndexBox cells;                ///< owned cells beside the side
  std::vector<Vec3> shear;       ///< tangential part of nu (grad u + grad u^T) n, n into the fluid [L^2/T^2]
  std::vector<double> pressure;  ///< extrapolated to the face from the two cells beside it [L^2/T^2]
};

/// Sets halos and boundary fluxes of one rank's block.
class BoundaryConditions {
 public:
  /// Throws InputError, naming the side, when a flow rate cannot have the profile it asks for.  Collective.
  BoundaryConditions(const grid::Grid& grid, Boundaries boundaries, double viscosity);

  /// Evaluates the prescribed velocities at time t.  Throws InputError when they bring in a net flow that no open side
  /// can take.  Collective.
  void evaluate_at(double t);
  /// Evaluates the prescribed pressures at time t.
  void evaluate_pressure_at(double t);

  /// Halo of the centre velocity beyond the domain's sides.
  void fill_velocity(const View3<double>& u) const;
  /// Where two sides meet, the halo goes on linearly from the three cells around: u = u_a + u_b - u_P.  The rest of it
  /// must be filled before.
  void extrapolate_edges(const View3<double>& u) const;
  /// What the rate of the cells beside open sides lacks where fluid comes in: it carries u_P/2, not the halo's u_P,
  ///
  ///   du <- du + w dN,  N <- N + dN,   dN = min(U . n, 0) u_P/(2 V).
  void add_entering_rate(const View3<const double>& u, const View3<const double>& U, double weight,
                         const View3<double>& rate, const View3<double>& increment) const;
  /// What the rate of the cells beside prescribed velocities lacks: the kernels take the viscous flux through the side
  /// from the mirrored halo, to first order; added is what makes it of second order (SideGradient),
  ///
  ///   du <- du + w dN,  N <- N + dN,   dN = nu/V (S . grad u - the mirrored one).
  ///
  /// Convection keeps u_b on the face.  u with valid halos.
  void add_wall_stress(const View3<const double>& u, const View3<const double>& U, double viscosity, double weight,
                       const View3<double>& rate, const View3<double>& increment) const;
  /// Largest over the cells beside prescribed velocities of the sum over axes of what counts for the step [1/L^2]:
  /// times nu dt, the diffusion number there.  Along an axis that ends on one or two such sides a quarter of what the
  /// cell loses through both faces per its own velocity, over V: 1/h^2 on equal cells, several times that where skewed
  /// cells meet two sides.  Along others G_aa/V, 1/h^2.
  [[nodiscard]] double diffusive_rate() const;
  /// Halo of the pressure beyond the domain's sides; on open ones it tells the pressure solver what is given there.
  void fill_pressure(const View<double>& p) const;
  /// U* on the domain's sides; on open ones from the velocity u_old + increment of the cells beside them.
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

  /// Of each side with a prescribed velocity that this rank touches: all, or walls only.  u and p with valid halos; of
  /// second order.
  [[nodiscard]] std::vector<SideStress> stresses(const View3<const double>& u, const View3<const double>& U,
                                                 const View<const double>& p, double viscosity, bool walls_only) const;

  /// Which sides prescribe the velocity: velocity sides and walls.
  [[nodiscard]] std::array<std::array<bool, 2>, 3> holds_velocity() const;
  /// Largest prescribed speed at the time of the last evaluation [L/T].
  [[nodiscard]] double largest_speed() const { return largest_speed_; }
  /// Largest prescribed kinematic pressure, in size, at the time of the last evaluation [L^2/T^2].  Collective.
  [[nodiscard]] double largest_pressure() const;

 private:
  /// Of the face between a side and the cell beside it.
  struct Face {
    Vec3 place;
    Vec3 area;    ///< along increasing index
    Vec3 normal;  ///< out of the domain
  };
  struct Side {
    int axis = 0;
    int end = 0;                           ///< 0 low, 1 high
    IndexBox cells;                        ///< owned cells beside the side
    std::vector<Face> faces;               ///< of `cells`, i fastest; so are the following
    std::vector<Vec3> velocity;            ///< prescribed
    std::vector<double> pressure;          ///< prescribed
    std::vector<std::size_t> section;      ///< numbers in the side's whole section, with a flow rate
    std::optional<SideGradient> gradient;  ///< where the velocity is prescribed
    [[nodiscard]] double outward() const { return end == 0 ? -1.0 : 1.0; }
    /// The cell whose low face is the boundary face of a cell.
    [[nodiscard]] Index3 face(const Index3& c) const { return stepped(c, axis, end); }
    [[nodiscard]] Index3 beyond(const Index3& c) const { return stepped(c, axis, end == 0 ? -1 : 1); }
  };
  template <class Visit>
  void for_each_side_cell(const Side& side, Visit visit) const;
  void add_side(int axis, int end);
  void add_inflow(int axis, int end, double viscosity);
  void evaluate_velocity(Side& side, double t) const;
  [[nodiscard]] const SideBoundary& boundary(const Side& side) const { return boundaries_[side.axis][side.end]; }
  [[nodiscard]] const std::optional<InflowProfile>& inflow(const Side& side) const
  {
    return inflow_[side.axis][side.end];
  }
  void balance_fluxes();
  [[nodiscard]] double diffusive_rate(int axis, const Index3& c) const;
  void subtract_side_gradient(const Side& side, const View3<double>& U) const;
  [[nodiscard]] IndexBox cells_with_free_face(const Side& side, int t, int end) const;
  [[nodiscard]] bool enters_freely(const Side& side) const;

  const grid::Grid& grid_;
  Boundaries boundaries_;
  std::array<std::array<std::optional<InflowProfile>, 2>, 3> inflow_;
  std::vector<Side> sides_;  ///< those that this rank touches
  HaloExchange halo_;
  Field3<double> side_gradient_;  ///< g_b of cells beside sides, on curvilinear grids
  bool is_open_ = false;          ///< through an outflow or pressure side
  bool evaluated_ = false;
  double largest_speed_ = 0.0;
};

}  // namespace luff::fluid
