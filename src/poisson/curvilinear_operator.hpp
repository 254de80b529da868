// SPDX-License-Identifier: BSD-3-Clause
// Coefficients of the pressure gradient through the faces of a curvilinear grid.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson {

/// Pairs of index directions of cross terms, in the order in which they are stored.
inline constexpr std::array<std::array<int, 2>, 3> cross_pairs{{{0, 1}, {0, 2}, {1, 2}}};
/// Place of the pair of the two directions other than a.
[[nodiscard]] constexpr int pair_without(int a)
{
  return 2 - a;
}

/// The energy of the pressure differences d_f across faces,
///
///   E = 1/2 sum_f a_f d_f^2 + sum_cells sum_{a<b} g_ab <d_a> <d_b>,   <d_a> = (d_low + d_high)/2,
///
/// d_f = 0 on closed faces, whose true differences are eliminated (operators/octant_closure.hpp).  Its derivative with
/// respect to d_f is the flux of the gradient,
///
///   F_f = a_f d_f + (w_a(L) + w_a(R))/2,   w_a = sum_{b != a} g_ab <d_b>,
///
/// A face of which the part c is open counts as open with weight c and as closed with 1 - c: E is the mean of the
/// energies of all combinations, in which <d_a> = (c_low d_low + c_high d_high)/2, a_f is c times what it is without,
/// and the cross part of F_f too.
///
/// so that the equation div F = div U* is symmetric positive semi-definite, its null vectors the constants on connected
/// parts.  Beyond Dirichlet sides p mirrors the cell inside, and w repeats it.
class CurvilinearOperator {
 public:
  /// Collective.
  CurvilinearOperator(const Decomposition& ranks, const View<const double> (&G)[6], const SideConditions& sides);

  /// Takes the blocked faces, as PressureSolver.  Returns the low faces of owned cells, and those on high sides of the
  /// domain, whose coefficient changed, and the cells whose cross terms did.  Collective.
  struct Changes {
    std::vector<FaceIndex> faces;
    std::vector<Index3> cells;
  };
  Changes set_blocked(std::span<const FaceIndex> faces);

  /// a_f at the low faces of cells, 0 where closed; with halo.
  [[nodiscard]] View3<const double> face() const { return views(face_); }
  /// g_ab of cells, in the order of cross_pairs; with halo.
  [[nodiscard]] View3<const double> cross() const { return views(cross_); }
  /// Largest |cos| of the angles between the gradients of two index directions, |G_ab|/sqrt(G_aa G_bb): 0 on an
  /// orthogonal grid.  Collective.
  [[nodiscard]] double largest_cosine() const;

 private:
  void close_sides();
  [[nodiscard]] bool stays_closed(const FaceIndex& f) const;
  void set_open(const FaceIndex& f, double open, std::vector<Index3>& touched);
  [[nodiscard]] double closed_half(int axis, const Index3& c) const;
  void close_cell(const Index3& c);
  void set_face(const FaceIndex& f);
  void list_faces(std::span<const Index3> cells, std::vector<FaceIndex>& faces) const;
  [[nodiscard]] bool on_side(const FaceIndex& f) const;

  const Decomposition& ranks_;
  std::array<View<const double>, 6> G_;
  SideConditions sides_;
  HaloExchange halo_;
  Field3<double> open_;    // part of each face of owned cells
  Field3<double> normal_;  // coefficient of d_a^2 of cells
  Field3<double> face_;
  Field3<double> cross_;
  std::vector<FaceIndex> blocked_;
};

}  // namespace luff::poisson
