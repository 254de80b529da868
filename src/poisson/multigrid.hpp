// SPDX-License-Identifier: BSD-3-Clause
// The multigrid V-cycle that preconditions conjugate gradients.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "poisson/coarsest.hpp"
#include "poisson/cross_terms.hpp"
#include "poisson/transfer.hpp"

namespace luff::poisson {

/// A symmetric V-cycle: two sweeps of red-black Gauss-Seidel down and two, mirrored, up, three or four on small levels.
/// Cells merge where they are narrow until they are about cubes, then everywhere.
///
/// The finest levels are shared out among ranks; from the first small one on, every rank works on the whole.
class Multigrid {
 public:
  /// The finest level covers `owned` of `box`.  Its coefficients are products of the box's tables, or stored ones if
  /// there is a source of them.
  Multigrid(const Box& box, const IndexBox& owned, const Neighbourhood& neighbourhood,
            const StoredCoefficients::Source& source = {});

  /// Stored coefficients of some faces of this rank changed on the finest level.  Then set_blocked().  Collective.
  void update_coefficients(std::span<const FaceIndex> faces, const StoredCoefficients::Source& source);
  /// Smooths the operator with cross terms from now on: those of the finest level, which is an argument, and on every
  /// coarser one what follows from them.  Pays on grids that are strongly skewed.  Then set_blocked().
  void smooth_cross_terms(CrossTerms& finest);
  /// Takes the blocked faces of the whole domain, the same on every rank.
  void set_blocked(std::span<const FaceIndex> faces);

  [[nodiscard]] Level& finest() { return *levels_.front(); }
  [[nodiscard]] const Level& finest() const { return *levels_.front(); }
  [[nodiscard]] const Cuts& finest_cuts() const { return cuts_.front(); }
  [[nodiscard]] const CoarsestSolver& coarsest() const { return coarsest_; }
  /// Connected component of every owned cell of the finest level, i fastest, then j, or nothing when there is only one;
  /// and whether each component is floating.  Numbered alike on every rank.
  void label_components(std::vector<int>& component, std::vector<char>& floating) const;

  using PlaneWork = std::function<void(int k)>;
  /// finest().u = M finest().f, M symmetric positive (semi-)definite; then `after` on every plane of the finest level
  /// while it is in cache.  Collective.
  void cycle(const PlaneWork& after = [](int) {}) { cycle(0, after); }

 private:
  void add_levels(const Neighbourhood& neighbourhood);
  [[nodiscard]] bool stored() const { return levels_.front()->box().stored != nullptr; }
  void coarsen_coefficients(std::size_t l);
  void coarsen_coefficients(std::size_t l, std::vector<FaceIndex>& changed);
  void share_cells_near_cuts(std::size_t l);
  void cycle(std::size_t l, const PlaneWork& after);
  void coarsen_cross_terms(std::size_t l);
  [[nodiscard]] bool waves_between_halos(std::size_t l) const;
  [[nodiscard]] bool sweeps_beside_cuts(std::size_t l) const;
  void smooth_from_zero(std::size_t l);
  void smooth(std::size_t l, const PlaneWork& after);
  void smooth_with_cross_terms(std::size_t l, const PlaneWork& after);
  void solve_coarsest(const PlaneWork& after);

  MPI_Comm comm_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<int> sweeps_;  // down and up, per level
  std::vector<std::unique_ptr<Transfer>> transfers_;
  std::vector<Cuts> cuts_;
  std::vector<CrossTerms*> cross_terms_;  // per level but the coarsest; empty where not smoothed
  std::vector<std::unique_ptr<CrossTerms>> coarse_cross_terms_;
  std::vector<Values> correction_;  // of levels with cross terms
  CoarsestSolver coarsest_;
};

}  // namespace luff::poisson
