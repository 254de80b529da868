// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/structure.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace luff::simulation {

namespace {

void append(std::vector<Vec3>& to, const Eigen::VectorXd& values)
{
  for (Eigen::Index n = 0; n < values.size(); n += 3)
    to.emplace_back(values.segment<3>(n));
}

surface::TriangleMesh mesh_of(const shell::Shell& shell, const shell::PieceRange& piece)
{
  const auto first = shell.reference().vertices.begin() + piece.first_vertex;
  surface::TriangleMesh mesh{{first, first + piece.n_vertices}, {}};
  for (int t = piece.first_triangle; t < piece.first_triangle + piece.n_triangles; ++t) {
    auto corners = shell.reference().triangles[t];
    for (int& v : corners)
      v -= piece.first_vertex;
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace

Structure::Structure(Shells shells, std::vector<RigidSheet> rigid)
    : shells_(std::move(shells)), rigid_(std::move(rigid))
{
  int part = 0;
  if (shells_.shell) {
    shells_.marks.resize(shells_.shell->pieces().size());
    for (const shell::PieceRange& piece : shells_.shell->pieces()) {
      add_sheet(piece.name, true, part, mesh_of(*shells_.shell, piece), shells_.marks[part]);
      ++part;
    }
    length_ = shells_.shell->size();
  }
  part = 0;
  for (const RigidSheet& sheet : rigid_)
    add_sheet(sheet.name, false, part++, sheet.mesh, sheet.marks);
  const std::vector<Vec3> none(vertices_, Vec3::Zero());
  loads_ = {none, none};
}

void Structure::add_sheet(const std::string& name, bool deforms, int part, const surface::TriangleMesh& reference,
                          const surface::Marks& marks)
{
  for (const auto& t : reference.triangles)
    triangles_.push_back({t[0] + vertices_, t[1] + vertices_, t[2] + vertices_});
  SheetRange sheet{.name = name,
                   .deforms = deforms,
                   .part = part,
                   .reference = reference,
                   .marks = marks,
                   .first_vertex = vertices_,
                   .vertices = reference.n_vertices(),
                   .first_triangle = static_cast<int>(triangles_.size()) - reference.n_triangles(),
                   .triangles = reference.n_triangles()};
  vertices_ += sheet.vertices;
  sheets_.push_back(std::move(sheet));
}

Eigen::VectorXd Structure::predict(const TimeStep& step) const
{
  return shells_.dynamics ? shells_.dynamics->predicted_positions(step.dt) : Eigen::VectorXd();
}

immersed::SheetMotion Structure::motion(const Eigen::VectorXd& d, const TimeStep& step) const
{
  immersed::SheetMotion motion;
  motion.triangles = triangles_;
  append(motion.position, d);
  if (shells_.dynamics) {
    const shell::Kinematics k = shells_.dynamics->kinematics(d, step.dt);
    append(motion.velocity, k.v);
    append(motion.acceleration, k.a);
  }
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices) {
      const shell::Rates r =
          sheet.moves ? sheet.motion.rates(x_0, step.t_new, step.dt) : shell::Rates{Vec3::Zero(), Vec3::Zero()};
      motion.position.push_back(sheet.moves ? sheet.motion.position(x_0, step.t_new) : x_0);
      motion.velocity.push_back(r.velocity);
      motion.acceleration.push_back(r.acceleration);
    }
  return motion;
}

std::vector<Vec3> Structure::velocity(const Eigen::VectorXd& d, const TimeStep& step) const
{
  return motion(d, step).velocity;
}

/// Forces of the flow on the shells, x y z of each vertex.
Eigen::VectorXd Structure::forces_on_shells() const
{
  Eigen::VectorXd force(3 * shells_.shell->n_vertices());
  for (int v = 0; v < shells_.shell->n_vertices(); ++v)
    force.segment<3>(3 * v) = loads_.force(v);
  return force;
}

Eigen::VectorXd Structure::solve(const TimeStep& step, const immersed::SheetLoads& loads, const Eigen::VectorXd& d)
{
  loads_ = loads;
  if (!shells_.dynamics)
    return d;
  shell::Dynamics::Trial trial = shells_.dynamics->solve(step.t_new, step.dt, forces_on_shells(), d);
  newton_iterations_ += trial.report.iterations;
  return std::move(trial.positions);
}

void Structure::accept(const TimeStep& step, const Eigen::VectorXd& d)
{
  if (shells_.dynamics)
    sharp_folds_ += shells_.dynamics->accept(d, step.t_new, step.dt, forces_on_shells()).n_sharp;
}

void Structure::restore(const shell::Checkpoint& shells, long newton_iterations, long sharp_folds)
{
  if (shells_.dynamics)
    shells_.dynamics->restore(shells);
  newton_iterations_ = newton_iterations;
  sharp_folds_ = sharp_folds;
}

std::vector<Vec3> Structure::accepted_positions(double t) const
{
  std::vector<Vec3> positions;
  if (shells_.dynamics)
    append(positions, shells_.dynamics->accepted().x);
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices)
      positions.push_back(sheet.moves ? sheet.motion.position(x_0, t) : x_0);
  return positions;
}

std::vector<Vec3> Structure::accepted_velocities(double t, double dt) const
{
  std::vector<Vec3> velocities;
  if (shells_.dynamics)
    append(velocities, shells_.dynamics->accepted().v);
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices)
      velocities.push_back(sheet.moves ? sheet.motion.rates(x_0, t, dt).velocity : Vec3(Vec3::Zero()));
  return velocities;
}

std::string Structure::place_of(const Eigen::VectorXd& d) const
{
  Eigen::Index worst = 0;
  for (Eigen::Index n = 1; n < d.size() && std::isfinite(d[worst]); ++n)
    if (!(std::abs(d[n]) <= std::abs(d[worst])))
      worst = n;
  const int vertex = static_cast<int>(worst / 3);
  const shell::PieceRange& piece = shells_.shell->piece_of_vertex(vertex);
  const Vec3 x = shells_.dynamics->accepted().x.segment<3>(3 * vertex);
  return fmt::format("vertex {} of shell '{}' at ({:.4g}, {:.4g}, {:.4g})", vertex - piece.first_vertex, piece.name,
                     x[0], x[1], x[2]);
}

shell::EnergyLedger Structure::energy() const
{
  return shells_.dynamics ? shells_.dynamics->ledger() : shell::EnergyLedger{};
}

}  // namespace luff::simulation
