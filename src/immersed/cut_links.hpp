// SPDX-License-Identifier: BSD-3-Clause
// Links between cell centres that a sheet cuts, the cells beside them, and the flux through their faces.
//
// Variant C, "cut-link": no cell of the fluid is left out; each cut link is one-sided (docs/numerics/immersed.md).
// Cells inside closed bodies move with them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/vec3.hpp"
#include "grid/grid.hpp"
#include "immersed/cell_metric.hpp"
#include "immersed/crossings.hpp"
#include "immersed/free_edges.hpp"
#include "immersed/inside.hpp"
#include "immersed/link_tree.hpp"
#include "immersed/rigid_velocity.hpp"
#include "parallel/field.hpp"

namespace luff::immersed {

/// Smallest relative distance of the sheet from a cell centre that stencils and loads see; the same everywhere.
inline constexpr double theta_min = 0.1;

/// Position, velocity and acceleration of the vertices of all sheets together.
struct SheetMotion {
  std::vector<Vec3> position;      ///< [L]
  std::vector<Vec3> velocity;      ///< [L/T]
  std::vector<Vec3> acceleration;  ///< [L/T^2]
  std::vector<std::array<int, 3>> triangles;
  std::vector<ClosedSurface> bodies = {};  ///< rigid
};

/// Which velocity of the sheet a stage sees.
enum class SheetVelocity {
  Predicted,  ///< of the step's frozen predictor, u_b^0 - (1-c) dt a_b^0 at the time t^n + c dt
  Current     ///< of the current coupling iterate, at t^{n+1}
};

/// A time inside a step, t^n + fraction dt, and the sheet's velocity there.
struct StageTime {
  double fraction = 1.0;
  SheetVelocity sheet = SheetVelocity::Predicted;
};

/// A point of the sheet.
struct SurfacePoint {
  int triangle = 0;
  std::array<double, 3> weights{};  ///< barycentric coordinates
  Vec3 place = Vec3::Zero();
};

/// The low face of `cell` normal to `axis`, cut by the sheet between the centres of P = cell - e_axis and N = cell.
/// P sees the first of the hits on the link, N the last: two sheets closer than a cell leave a gap between them.
struct CutFace {
  int axis = 0;
  Index3 cell{};
  int first = 0;          ///< index of the hit next to P
  int last = 0;           ///< index of the hit next to N
  double cover = 1.0;     ///< part c of the face that the sheet covers, less than 1 at its free edges
  double open = 0.0;      ///< velocity through the open part at t^n, V, less the mean of the face U^n_f/A [L/T]
  double offset = 0.0;    ///< flux velocity minus that of its parts at t^n, eps [L/T]
  double rate = 0.0;      ///< d eps/dt at t^n [L/T^2]
  double passage = 0.0;   ///< d/speed, the time that the flow takes across the link [T]
  double decay_time = 0;  ///< tau [T]
};

/// tau of shells in parts of the time that the flow takes across the link: a critically damped return lasts about as
/// long as a plain one of twice its tau (docs/numerics/immersed.md).
inline constexpr double shell_decay = 0.6;
/// Largest rate, in parts of eps/tau, at which the offset of a newly cut face begins to return.
inline constexpr double fastest_return = 3.0;

/// The fluxes that newly cut faces start from.
struct FluxHistory {
  View3<const double> U;         ///< at t^n [L^3/T]
  View3<const double> U_before;  ///< at t^{n-1}
  double dt = 0.0;               ///< t^n - t^{n-1} [T]; zero: nothing is known of t^{n-1}
};

/// A cell of the fluid with at least one cut link.  face[2a] is its low and face[2a+1] its high face along axis a: an
/// index of CutLinks::faces(), or open_link.
struct CutCell {
  Index3 cell{};
  std::array<int, 6> face{};
  std::array<CellAxis, 3> along{};  ///< as in a cell without cut links
};
inline constexpr int open_link = -1;

/// As if none of its links were cut.
[[nodiscard]] CutCell uncut_cell(const grid::Grid& grid, const Index3& cell);

/// Offsets of the fluxes of cut faces in the accepted state, by the number of the face in the whole grid.
struct FluxOffsets {
  std::vector<std::int64_t> face;         ///< ascending
  std::vector<double> offset;             ///< eps [L/T]
  std::vector<double> rate;               ///< d eps/dt [L/T^2]
  std::vector<double> cover;              ///< covered part of the face
  std::vector<double> open;               ///< velocity through the open part [L/T]
  std::vector<std::int64_t> inside;       ///< cells inside closed bodies, by their low face of axis 0
  std::vector<std::int64_t> inside_body;  ///< number of the body
};

/// The cut links of one rank.  The geometry is frozen once per step; coupling iterations change the velocity only.
class CutLinks {
 public:
  explicit CutLinks(const grid::Grid& grid);

  /// From now on all stages see the sheet where it is at the end of the step, as the nodes of the scheme curvib do.
  void hold_within_step() { held_ = true; }
  /// From now on free edges cover parts of faces (FadingSheets); without, a face is cut whole where its link is.
  void cover_in_part() { covers_in_part_ = true; }

  /// Finds crossings, cut faces and cells, and starts the flux offsets from the accepted fluxes:
  ///
  ///   eps = the old offset where the link was cut at t^n, c (U^n_f/A_f - u_b^0 . e) where it was not,
  ///   eps' = the old rate, or c (U^n_f - U^{n-1}_f)/(A_f dt) - c a_b^0 . e within bounds,  tau = 0.6 d/speed.
  ///
  /// Where the covered part c of a face has changed, eps takes up what that changes the flux by, (c - c^n)(V^n - u_b^0
  /// . e).
  ///
  /// At closed bodies u_b^0 is that of t^n, the predictor's u_b^0 - dt a_b^0, tau eps' = -eps and tau = d/speed: then
  /// the offsets around a body have no net flux, whichever cells it takes in and gives back, and need no source of
  /// mass.
  ///
  /// `speed` [L/T]: the reference speed of the flow; the sheet's own is used where it is larger.
  /// Collective.
  void freeze(const SheetMotion& predicted, double dt, double speed, const FluxHistory& flow);

  /// Velocity u_b of the current coupling iterate at the vertices.
  void set_velocity(std::span<const Vec3> velocity);

  /// Commits the flux offsets, decayed over the step, the velocities through open parts of faces, which follow from the
  /// fluxes of the new state, and which cells lie inside bodies.
  void accept(const View3<const double>& U);
  /// The accepted offsets of the faces of this rank's cells, each face on one rank only.
  [[nodiscard]] FluxOffsets accepted_offsets() const;
  /// Go on from the accepted offsets of all ranks, in any order.
  void restore(const FluxOffsets& of_all_ranks);
  /// The number of a face in the whole grid, by the cell whose low face it is.
  [[nodiscard]] std::int64_t key(int axis, const Index3& cell) const;

  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
  [[nodiscard]] const std::vector<CutFace>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<CutCell>& cells() const { return cells_; }
  /// Owned cells inside closed bodies.
  [[nodiscard]] const std::vector<InsideCell>& inside() const { return inside_; }
  [[nodiscard]] bool is_inside(const Index3& owned) const { return solid_.view()(owned) != 0; }
  /// Owned cells of the fluid whose centre the sheet swept over since the accepted step, or which a body gave back.
  [[nodiscard]] const std::vector<Index3>& flipped() const { return flipped_; }
  /// Whether the low face of a cell, owned or just behind owned ones, belongs to a cut link.
  [[nodiscard]] bool is_cut(int axis, const Index3& cell) const { return mark_[axis].view()(cell) != open_link; }
  /// Whether a side of a hit (0: P's, 1: N's) looks into the body that the surface bounds.
  [[nodiscard]] bool looks_inside(int hit, int link_side) const
  {
    return body_of_hit_[hit] >= 0 && (link_side == 1) == (crossings_[hit].side < 0);
  }
  /// The part of such a face that sheets cover.
  [[nodiscard]] double cover(int axis, const Index3& cell) const
  {
    const int face = mark_[axis].view()(cell);
    return face == open_link ? 0.0 : faces_[face].cover;
  }
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// Of the vertices, as frozen.
  [[nodiscard]] const std::vector<Vec3>& positions() const { return positions_; }
  /// Length of the step that the geometry is frozen for [T].
  [[nodiscard]] double step_length() const { return dt_; }
  [[nodiscard]] const std::array<int, 3>& triangle(const Crossing& hit) const { return triangles_[hit.triangle]; }
  /// Unit normal of the sheet at hit q.
  [[nodiscard]] const Vec3& normal(int q) const { return normals_[q]; }
  /// Links with more than one hit: sheets closer than a cell, or a fold.
  [[nodiscard]] int multiple_hits() const
  {
    return static_cast<int>(crossings_.size()) - static_cast<int>(faces_.size());
  }

  /// Where a hit lies on its link at a time of the step, carried along the sheet's normal by its predicted velocity:
  /// theta(c) = theta - (1-c) dt u_b . n/(n . link).  Before the end of the step it may lie beyond the ends of the
  /// link.
  [[nodiscard]] double theta(int hit, const StageTime& time) const
  {
    return crossings_[hit].theta - (1.0 - time.fraction) * drift_[hit];
  }
  /// Velocity of the sheet at a hit.
  [[nodiscard]] Vec3 velocity(int hit, const StageTime& time) const
  {
    if (time.sheet == SheetVelocity::Current)
      return velocity_[hit];
    return predicted_velocity_[hit] - (1.0 - time.fraction) * dt_ * predicted_acceleration_[hit];
  }
  /// Velocity of the sheet at any of its points; on a body, that of its rigid motion.
  [[nodiscard]] Vec3 velocity_at(const SurfacePoint& point, const StageTime& time) const;
  /// Velocity of the body that an inside cell lies in, at a place.
  [[nodiscard]] Vec3 body_velocity(int body, const Vec3& x, const StageTime& time) const;
  /// Angular velocity, in the current iterate, of the closed body that a triangle bounds; zero of other sheets [1/T].
  [[nodiscard]] Vec3 spin_at(int triangle) const
  {
    const int body = body_of(triangle);
    return body < 0 ? Vec3(Vec3::Zero()) : body_velocity_[body].spin;
  }
  /// Before: U_f = U^n_f + what the open face has gained since.  After, on every cut face,
  ///
  ///   U_f = A [c u_b . e + (1 - c)(V^n + gained/A) + eps(t)];   U_f = A u_b . e between cells inside.
  void impose_fluxes(const StageTime& time, const View3<double>& U) const;
  /// V = (U_f/A - c u_b . e - eps)/(1 - c) through the open part of a face that is covered in part.
  [[nodiscard]] double open_velocity(const CutFace& face, const View3<const double>& U, const StageTime& time) const;

 private:
  void find_crossings(std::span<const Vec3> positions);
  [[nodiscard]] std::vector<Crossing> hits_of(std::span<const Vec3> positions,
                                              std::span<const std::array<int, 3>> triangles);
  void interpolate_prediction(const SheetMotion& predicted);
  [[nodiscard]] double drift(int hit) const;
  void find_faces();
  void find_cells();
  void find_flipped();
  void find_given_back();
  void start_offsets(double speed, const FluxHistory& flow);
  void set_decay_times(double speed);
  [[nodiscard]] bool decays_plainly(const CutFace& face) const;
  [[nodiscard]] double rate_of_newly_cut(const CutFace& face, const FluxHistory& flow) const;
  [[nodiscard]] double fluid_velocity(const CutFace& face, const View3<const double>& U) const;
  [[nodiscard]] double covered_velocity(const CutFace& face, const StageTime& time) const;
  void impose_fluxes_inside(const StageTime& time, const View3<double>& U) const;
  [[nodiscard]] std::vector<RigidVelocity> rigid_velocities(std::span<const Vec3> velocity) const;
  [[nodiscard]] int body_of(int triangle) const;
  /// The cell whose low face a key stands for, and the axis.
  [[nodiscard]] std::pair<int, Index3> face_of(std::int64_t key) const;
  [[nodiscard]] bool keeps(std::int64_t key) const;
  struct AcceptedOffset {
    std::int64_t face;
    double offset;
    double rate;
    double cover;
    double open;
  };
  [[nodiscard]] const AcceptedOffset* old_offset(std::int64_t key) const;
  [[nodiscard]] bool was_crossed(int axis, const Index3& cell) const;
  [[nodiscard]] bool is_crossed(int face) const;

  const grid::Grid& grid_;
  bool held_ = false;
  bool covers_in_part_ = false;
  double dt_ = 0.0;
  std::unique_ptr<const LinkTree> tree_;  ///< of curvilinear grids, once there is a sheet
  std::vector<Vec3> positions_;           ///< of the vertices, as are the following
  std::vector<Vec3> vertex_velocity_;     ///< of the predictor
  std::vector<Vec3> vertex_acceleration_;
  std::vector<Vec3> current_vertex_velocity_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<ClosedSurface> bodies_;
  std::vector<RigidVelocity> predicted_body_velocity_;
  std::vector<RigidVelocity> predicted_body_acceleration_;
  std::vector<RigidVelocity> body_velocity_;
  std::vector<FreeEdge> free_edges_;
  std::vector<Crossing> crossings_;  ///< and those of the strips beyond free edges
  std::vector<double> cover_;        ///< of the crossings; none where free edges cover whole faces
  std::vector<int> body_of_hit_;     ///< -1: not of a closed body
  std::vector<Vec3> places_;         ///< of the hits
  std::vector<Vec3> normals_;
  std::vector<double> drift_;  ///< of theta over the step
  std::vector<Vec3> predicted_velocity_;
  std::vector<Vec3> predicted_acceleration_;
  std::vector<Vec3> velocity_;
  std::vector<CutFace> faces_;
  std::vector<CutCell> cells_;
  std::vector<InsideCell> inside_;
  std::vector<Index3> flipped_;
  Field<char> solid_;                             ///< 1 in the owned cells inside bodies
  Field3<int> mark_;                              ///< index into faces_ of each face of the owned cells, or open_link
  std::vector<AcceptedOffset> accepted_offsets_;  ///< sorted by face
  std::vector<InsideCell> accepted_inside_;
};

}  // namespace luff::immersed
