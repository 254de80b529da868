// SPDX-License-Identifier: BSD-3-Clause
// Forces of the flow on sheets, by crossing quadrature.
#pragma once

#include <span>
#include <vector>

#include "immersed/cross_terms.hpp"
#include "immersed/cut_links.hpp"
#include "immersed/wall_nodes.hpp"

namespace luff::immersed {

/// What the flow does to a sheet, per vertex [M L/T^2].  The force on the flow is the opposite, link by link.
struct SheetLoads {
  std::vector<Vec3> minus;  ///< by the fluid on the - side
  std::vector<Vec3> plus;   ///< by the fluid on the + side, where the normal points
  [[nodiscard]] Vec3 force(std::size_t vertex) const { return minus[vertex] + plus[vertex]; }
};

/// Pressure and viscous traction on the two sides of one triangle: side 0 is the - side, side 1 the + side, where the
/// triangle's normal points.
struct SideTraction {
  std::array<double, 2> pressure{0.0, 0.0};               ///< [M/(L T^2)]
  std::array<Vec3, 2> shear{Vec3::Zero(), Vec3::Zero()};  ///< viscous traction on the sheet [M/(L T^2)]
};

/// The fields that loads are made of, with valid halos: kinematic pressure p and velocity u at t^{n+1}.
struct LoadFields {
  View<const double> p;
  View3<const double> u;
  std::span<const Vec3> u_star;  ///< of links.cells(): the velocity that the implicit wall terms have seen
  /// of links.cells(): rates of the mean velocities of their faces over the step [L/T^2], low and high of each axis
  std::span<const std::array<double, 6>> acceleration = {};
  double density = 1.0;
  double viscosity = 0.0;             ///< kinematic
  const CrossTerms* cross = nullptr;  ///< of u, on curvilinear grids
};

/// Force on every vertex.  Each cut link in direction d samples the projected area n_d dS = A_d; its two sides give
///
///   f = rho { -(p_R - p_L) S_d + A_d (tau_R + tau_L) },   S_d = A_d e_d on Cartesian grids,
///   tau = h/H nu (u* - u_b)/h_k - (h/H - 1) nu (u_W - u)/h_W,
///
/// what the cell's momentum stencil takes from the fluid: h is the cell's width, H = (h_k + h_W)/2 the stencil's, h_k
/// the distance of the sheet as there (theta clipped), W the neighbour behind.  Where the shear is the same on both
/// sides of the cell, tau = nu (u* - u_b)/h_k; where the cell slows down or speeds up, the part of its momentum that
/// the narrower stencil leaves out is not lost (docs/numerics/immersed.md).  On curvilinear grids lengths and areas are
/// those of the gradient flux (cell_metric.hpp), and the cross flux through the face belongs to tau.  A body that turns
/// feels -mu spin x n besides: its own velocity changes along the surface, so that the transposed gradient does not
/// vanish.  That has no force in all but the moment -2 mu V spin.  p_L, p_R are extrapolated to the sheet from the
/// cells of their side,
///
///   p = p_P + theta d [(p_P - p_W)/d_W + a_W - a_c],
///
/// a_W and a_c the accelerations towards the sheet of the fluid at the face behind the cell and at the cut face: with
/// that slope the fluid between the centre and the sheet has the momentum that the fluxes have (a_W - a_c is left out
/// at closed bodies).  The hit's force goes to the triangle's vertices with its barycentric weights: force and moment
/// are conserved.  Collective; the same numbers on every rank.
[[nodiscard]] SheetLoads sheet_loads(const grid::Grid& grid, const CutLinks& links, const LoadFields& fields,
                                     std::size_t vertices);

/// Mean pressure and shear per triangle and side over its hits; triangles without any take the mean of neighbours that
/// share a vertex.  Collective.
[[nodiscard]] std::vector<SideTraction> side_tractions(const grid::Grid& grid, const CutLinks& links,
                                                       const LoadFields& fields, std::size_t vertices);

/// The same of the scheme "curvib", after (4.30) to (4.32) of \cite gilmanov_2015_numerical: each wall node belongs to
/// the triangle its foot lies on, and gives it, on its side, pressure and shear along the normal,
///
///   p_a = p_P - s_P (p_c - p_P)/(s_c - s_P),   tau = mu (u_c - u_a)_t/s_c - (s_c/2) (grad p + rho a)_t,
///
/// the slope at the wall of a parabola through u_a and u_c whose curvature is what momentum has there, nu d2u/dn2 =
/// grad p/rho + a; a is the sheet's acceleration over the step.  Bodies that turn as above.  A triangle's values are
/// the means over its nodes, weighted by 1/|x_P - x_e|, x_e its centre.  Triangles without any take those around.
/// Between sheets, where no c is known, dp/dn = -rho a . n and no shear.  Collective.
[[nodiscard]] std::vector<SideTraction> node_tractions(const grid::Grid& grid, const CutLinks& links,
                                                       const WallNodes& nodes, const LoadFields& fields);

/// Tractions times areas, a third for each vertex.
[[nodiscard]] SheetLoads loads_of_tractions(const CutLinks& links, std::span<const SideTraction> tractions);

}  // namespace luff::immersed
