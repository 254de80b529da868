// SPDX-License-Identifier: BSD-3-Clause
// Cells beside a sheet whose velocity is reconstructed along the sheet's normal: the scheme "curvib".
#pragma once

#include <cstdint>
#include <vector>

#include "immersed/cut_links.hpp"
#include "immersed/surface_walk.hpp"
#include "parallel/halo.hpp"

namespace luff::immersed {

/// An immersed-boundary node of the sources, IB+ or IB-: a cell of the fluid with a cut link, on one side of one sheet.
///
/// A line from the closest point of the sheet, the foot a, through the node P goes on to a point c between nodes of the
/// same side one index away, and
///
///   u_P = u_a + s_P/s_c (u_c - u_a),   u_c = sum_k w_k u_k,   s: distance from the foot.
struct WallNode {
  SurfacePoint foot;
  std::vector<int> touched;    ///< triangles that the foot lies on, several of them on an edge or a vertex
  Vec3 normal = Vec3::Zero();  ///< unit vector from the foot to the node, into the fluid
  bool plus = true;            ///< on the side that the triangle's normal points to
  double distance = 0.0;       ///< s_P [L]
  double reach = 0.0;          ///< s_c [L]
  bool on_patch = false;       ///< c lies on a patch of donors; else it is one neighbour, and only s counts
  int donors = 0;              ///< number of them; 0: none found, the node lies between sheets
  std::array<Index3, 4> donor{};
  std::array<double, 4> weight{};
  int level = 0;               ///< 0: no donor is a wall node itself; else one more than the highest of them
  Vec3 offset = Vec3::Zero();  ///< velocity minus the reconstructed one at t^n [L/T]
  double decay_time = 0.0;     ///< tau [T]
};

/// What velocities of wall nodes lack of the reconstructed ones in the accepted state, by the number of the low face of
/// axis 0 of the node's cell.
struct NodeOffsets {
  std::vector<std::int64_t> node;  ///< ascending
  std::vector<double> offset;      ///< three components each [L/T]
};

/// How the donors of wall nodes were found.
struct DonorCounts {
  long nodes = 0;
  long single = 0;  ///< one neighbour instead of the patch that the normal goes through
  long none = 0;    ///< between sheets: the mean of the sheets' velocities
};

/// The wall nodes of one rank, one for each of CutLinks::cells().  The geometry is frozen once per step.
class WallNodes {
 public:
  explicit WallNodes(const grid::Grid& grid);

  /// Finds feet and donors.  Collective.
  void freeze(const CutLinks& links);
  /// Starts the offset of nodes that were none at t^n, e = u^n - (reconstructed from u^n); it decays like those of the
  /// fluxes through cut faces, with their tau.  Without it a node would jump onto the line between wall and fluid in
  /// one step, and its pressure like 1/dt.  u_old: with valid halos.
  void start_offsets(const CutLinks& links, const View3<const double>& u_old);

  /// Owned cells that nodes of this or another rank may take velocities from.
  [[nodiscard]] const std::vector<Index3>& donors() const { return donors_; }
  /// Velocities of the nodes into u, from the donors in u, whose halos are valid.  Collective.
  void reconstruct(const CutLinks& links, const StageTime& time, const View3<double>& u);

  [[nodiscard]] const std::vector<WallNode>& nodes() const { return nodes_; }
  /// Of this rank.
  [[nodiscard]] DonorCounts counts() const;

  void accept(const CutLinks& links);
  [[nodiscard]] NodeOffsets accepted_offsets() const;
  /// Go on from the accepted offsets of all ranks, in any order.
  void restore(const NodeOffsets& of_all_ranks);

 private:
  void mark_cells(const CutLinks& links);
  void find_feet(const CutLinks& links);
  void find_donors(const CutLinks& links);
  void find_levels(const CutLinks& links);
  void find_owned_donors(const CutLinks& links);
  bool find_patch(WallNode& node, const Index3& cell) const;
  bool find_patch_along(WallNode& node, const Index3& cell, int axis, const Vec3& heading) const;
  bool find_neighbour(WallNode& node, const Index3& cell) const;
  [[nodiscard]] Index3 beside_side(Index3 cell) const;
  [[nodiscard]] bool joined(const Index3& from, const Index3& to) const;
  [[nodiscard]] bool gives(const Index3& donor, double distance) const;
  [[nodiscard]] Vec3 from_foot(const WallNode& node, const Index3& cell, const Index3& other) const;
  [[nodiscard]] Vec3 value(const CutLinks& links, std::size_t n, const StageTime& time,
                           const View3<const double>& u) const;

  const grid::Grid& grid_;
  HaloExchange halo_;
  std::vector<WallNode> nodes_;
  std::vector<Index3> donors_;
  int highest_level_ = 0;
  Field<int> mark_;         ///< bits: the low faces of axes 0, 1, 2 are cut; the cell is a wall node
  Field<double> distance_;  ///< of wall nodes from the sheet
  Field<int> level_;        ///< of wall nodes
  std::vector<std::pair<std::int64_t, Vec3>> accepted_;  ///< sorted
};

}  // namespace luff::immersed
