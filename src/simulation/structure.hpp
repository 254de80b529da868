// SPDX-License-Identifier: BSD-3-Clause
// Everything that moves in the flow, seen as one set of vertices: shells that the flow bends, rigid bodies, thin or
// closed, that move as prescribed or as the flow moves them.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/time_step.hpp"
#include "immersed/cut_links.hpp"
#include "immersed/loads.hpp"
#include "shell/dynamics.hpp"
#include "simulation/rigid_body.hpp"
#include "simulation/skin.hpp"
#include "surface/marked_mesh.hpp"

namespace luff::simulation {

/// All shells, as pieces that are solved together, and their motion. Both null where there is none.
struct Shells {
  std::unique_ptr<shell::Shell> shell;
  std::unique_ptr<shell::Dynamics> dynamics;
  std::vector<surface::Marks> marks = {};       ///< of each piece's mesh; may be left out
  std::vector<std::optional<Skin>> skins = {};  ///< of pieces whose faces the flow sees; may be left out
};

/// A rigid thin sheet or closed body, whose place is given for all times, or which the flow moves.
struct RigidSheet {
  std::string name;
  surface::TriangleMesh mesh;  ///< at t = 0
  shell::Motion motion;
  bool moves = false;  ///< as `motion` says
  surface::Marks marks = {};
  bool closed = false;                 ///< there is no fluid inside; normals point outwards
  std::optional<RigidBody> free = {};  ///< the flow moves it
  Vec3 centre = Vec3::Zero();          ///< at t = 0, for tables: of mass, of volume, or of the vertices
};

/// How a rigid body moves, for tables.
struct BodyMotion {
  Vec3 centre = Vec3::Zero();
  Vec3 rotation = Vec3::Zero();  ///< rotation vector from t = 0 [rad]
  Vec3 velocity = Vec3::Zero();  ///< of the centre
  Vec3 spin = Vec3::Zero();
};

/// Part of the vertices and triangles of all sheets together.  The vertices of a shell are its own, or those of its
/// skin.
struct SheetRange {
  std::string name;
  bool deforms = false;
  int part = 0;                     ///< index among the shells or the rigid sheets
  surface::TriangleMesh reference;  ///< of a shell, or its skin; at t = 0 of a rigid sheet
  surface::Marks marks;             ///< of that mesh
  int first_vertex = 0;
  int vertices = 0;
  int first_triangle = 0;
  int triangles = 0;
};

/// Shells first, then rigid sheets.  The interface vector d holds the positions of the shells' vertices, then six
/// numbers of each free body (see RigidBody); velocities follow from it through the scheme of each, so that both stay
/// consistent.
class Structure {
 public:
  Structure(Shells shells, std::vector<RigidSheet> rigid);

  /// d^0, extrapolated to the end of the step.
  [[nodiscard]] Eigen::VectorXd predict(const TimeStep& step) const;
  /// Position, velocity and acceleration of all vertices at t_new, with shells and free bodies at d.
  [[nodiscard]] immersed::SheetMotion motion(const Eigen::VectorXd& d, const TimeStep& step) const;
  /// Velocity of all vertices at t_new.
  [[nodiscard]] std::vector<Vec3> velocity(const Eigen::VectorXd& d, const TimeStep& step) const;
  /// Where shells and free bodies come to rest in the step under the forces of the flow (one per vertex of all sheets),
  /// from the accepted state; Newton starts from d.
  [[nodiscard]] Eigen::VectorXd solve(const TimeStep& step, const immersed::SheetLoads& loads,
                                      const Eigen::VectorXd& d);
  /// See shell::Dynamics::borrow_mass.
  void borrow_mass(double ratio) { shells_.dynamics->borrow_mass(ratio); }
  /// Commits d.
  void accept(const TimeStep& step, const Eigen::VectorXd& d);

  [[nodiscard]] const std::vector<SheetRange>& sheets() const { return sheets_; }
  [[nodiscard]] const Shells& shells() const { return shells_; }
  [[nodiscard]] int vertices() const { return vertices_; }
  /// Those of shells, which come first.
  [[nodiscard]] int shell_vertices() const { return first_rigid_vertex_; }
  [[nodiscard]] const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// What the flow did to each vertex of all sheets in the last solve(). Skins feel their outside only.
  [[nodiscard]] const immersed::SheetLoads& loads() const { return loads_; }
  /// Loads as the sheets feel them: skins not those of the fluid inside.
  [[nodiscard]] immersed::SheetLoads felt(immersed::SheetLoads loads) const;
  /// What the fluid inside of skins did to their vertices, which nothing answers; zero at other vertices.
  [[nodiscard]] const std::vector<Vec3>& inner_loads() const { return inner_loads_; }
  /// Positions of all vertices at time t in the accepted state.
  [[nodiscard]] std::vector<Vec3> accepted_positions(double t) const;
  [[nodiscard]] std::vector<Vec3> accepted_velocities(double t, double dt) const;
  /// How rigid sheet `part` moves in the accepted state at t.
  [[nodiscard]] BodyMotion body_motion(int part, double t, double dt) const;
  [[nodiscard]] const std::vector<RigidSheet>& rigid() const { return rigid_; }
  [[nodiscard]] bool has_closed_bodies() const
  {
    return std::any_of(rigid_.begin(), rigid_.end(), [](const RigidSheet& sheet) { return sheet.closed; });
  }
  /// Whether d has any entries: something answers the flow.
  [[nodiscard]] bool answers_flow() const { return shells_.dynamics != nullptr || n_free_ > 0; }
  /// Length that makes displacements relative: the size of the largest shell or free body, 1 without any.
  [[nodiscard]] double length() const { return length_; }
  /// The vertex with the largest component of an interface vector, or the first that is no number, in words.
  [[nodiscard]] std::string place_of(const Eigen::VectorXd& d) const;
  /// Of all shells together.
  [[nodiscard]] shell::EnergyLedger energy() const;
  /// Go on from an earlier run's accepted state: its shells' and how many there were of what is counted.
  void restore(const shell::Checkpoint& shells, long newton_iterations, long sharp_folds);
  /// The accepted states of the free bodies, one after the other.
  [[nodiscard]] std::vector<double> free_bodies() const;
  void restore_free_bodies(const std::vector<double>& saved);
  /// Null without contact.
  [[nodiscard]] const shell::ContactStep* contact() const
  {
    return shells_.dynamics ? shells_.dynamics->contact() : nullptr;
  }
  /// Of all solutions so far.
  [[nodiscard]] long newton_iterations() const { return newton_iterations_; }
  [[nodiscard]] long sharp_folds() const { return sharp_folds_; }

 private:
  void add_sheet(const std::string& name, bool deforms, int part, const surface::TriangleMesh& reference,
                 const surface::Marks& marks);
  /// The skin of a piece, or null.
  [[nodiscard]] const Skin* skin_of(std::size_t piece) const;
  template <class Visit>
  void for_each_vertex_of_skins(Visit visit) const;
  void take_loads(const immersed::SheetLoads& loads);
  /// Of the flow on the shells at x, x y z of each vertex.
  [[nodiscard]] Eigen::VectorXd forces_on_shells(const Eigen::VectorXd& x) const;
  /// Positions of the shells' vertices in the flow with the shells at x.
  [[nodiscard]] std::vector<Vec3> wetted_positions(const Eigen::VectorXd& x) const;
  [[nodiscard]] std::vector<Vec3> wetted_rates(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;
  [[nodiscard]] Eigen::Index shell_unknowns() const;
  /// The part of d that belongs to the n-th free body.
  [[nodiscard]] Vec6 body_part(const Eigen::VectorXd& d, int n) const;
  [[nodiscard]] Wrench wrench(int first_vertex, const RigidSheet& sheet, const RigidState& state) const;
  /// visit(sheet, first vertex, number among the free bodies)
  template <class Sheets, class Visit>
  static void for_each_free(Sheets& rigid, int first_vertex, Visit visit);

  Shells shells_;
  std::vector<RigidSheet> rigid_;
  std::vector<SheetRange> sheets_;
  std::vector<std::array<int, 3>> triangles_;
  int vertices_ = 0;
  int first_rigid_vertex_ = 0;
  int n_free_ = 0;
  double length_ = 1.0;
  immersed::SheetLoads loads_;
  std::vector<Vec3> inner_loads_;
  long newton_iterations_ = 0;
  long sharp_folds_ = 0;
};

}  // namespace luff::simulation
