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

/// Velocity and acceleration of a prescribed motion by fourth-order central differences.  A tenth of the step resolves
/// whatever the flow resolves, and keeps round-off near 1e-13 of the velocity.
struct PrescribedRates {
  Vec3 velocity;
  Vec3 acceleration;
};
PrescribedRates rates(const RigidSheet& sheet, const Vec3& x_0, double t, double dt)
{
  const double e = 0.1 * dt;
  const auto x = [&](int n) -> Vec3 { return sheet.position(x_0, t + n * e); };
  const Vec3 near = x(1) - x(-1);
  const Vec3 far = x(2) - x(-2);
  const Vec3 here = x(0);
  return {(8.0 * near - far) / (12.0 * e),
          (16.0 * (x(1) - 2.0 * here + x(-1)) - (x(2) - 2.0 * here + x(-2))) / (12.0 * e * e)};
}

}  // namespace

Structure::Structure(std::vector<ShellPart> shells, std::vector<RigidSheet> rigid)
    : shells_(std::move(shells)), rigid_(std::move(rigid))
{
  double longest = 0.0;
  for (std::size_t s = 0; s < shells_.size(); ++s) {
    add_sheet(shells_[s].shell->name(), true, static_cast<int>(s), shells_[s].shell->reference());
    unknowns_ += 3 * shells_[s].shell->n_vertices();
    longest = std::max(longest, shells_[s].shell->size());
  }
  for (std::size_t s = 0; s < rigid_.size(); ++s)
    add_sheet(rigid_[s].name, false, static_cast<int>(s), rigid_[s].mesh);
  if (longest > 0.0)
    length_ = longest;
  const std::vector<Vec3> none(vertices_, Vec3::Zero());
  loads_ = {none, none};
}

void Structure::add_sheet(const std::string& name, bool deforms, int part, const surface::TriangleMesh& mesh)
{
  sheets_.push_back({.name = name,
                     .deforms = deforms,
                     .part = part,
                     .first_vertex = vertices_,
                     .vertices = mesh.n_vertices(),
                     .first_triangle = static_cast<int>(triangles_.size()),
                     .triangles = mesh.n_triangles()});
  for (const auto& t : mesh.triangles)
    triangles_.push_back({t[0] + vertices_, t[1] + vertices_, t[2] + vertices_});
  vertices_ += mesh.n_vertices();
}

Eigen::VectorXd Structure::segment(const Eigen::VectorXd& d, std::size_t shell) const
{
  return d.segment(3 * sheets_[shell].first_vertex, 3 * sheets_[shell].vertices);
}

Eigen::VectorXd Structure::predict(const TimeStep& step) const
{
  Eigen::VectorXd d(unknowns_);
  for (std::size_t s = 0; s < shells_.size(); ++s)
    d.segment(3 * sheets_[s].first_vertex, 3 * sheets_[s].vertices) = shells_[s].dynamics->predicted_positions(step.dt);
  return d;
}

immersed::SheetMotion Structure::motion(const Eigen::VectorXd& d, const TimeStep& step) const
{
  immersed::SheetMotion motion;
  motion.triangles = triangles_;
  append(motion.position, d);
  for (std::size_t s = 0; s < shells_.size(); ++s) {
    const shell::Kinematics k = shells_[s].dynamics->kinematics(segment(d, s), step.dt);
    append(motion.velocity, k.v);
    append(motion.acceleration, k.a);
  }
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices) {
      const PrescribedRates r =
          sheet.moves ? rates(sheet, x_0, step.t_new, step.dt) : PrescribedRates{Vec3::Zero(), Vec3::Zero()};
      motion.position.push_back(sheet.moves ? sheet.position(x_0, step.t_new) : x_0);
      motion.velocity.push_back(r.velocity);
      motion.acceleration.push_back(r.acceleration);
    }
  return motion;
}

std::vector<Vec3> Structure::velocity(const Eigen::VectorXd& d, const TimeStep& step) const
{
  return motion(d, step).velocity;
}

/// Forces of the flow on one sheet, x y z of each vertex.
Eigen::VectorXd Structure::force_on(const SheetRange& sheet) const
{
  Eigen::VectorXd force(3 * sheet.vertices);
  for (int v = 0; v < sheet.vertices; ++v)
    force.segment<3>(3 * v) = loads_.force(sheet.first_vertex + v);
  return force;
}

Eigen::VectorXd Structure::solve(const TimeStep& step, const immersed::SheetLoads& loads, const Eigen::VectorXd& d)
{
  loads_ = loads;
  Eigen::VectorXd image(unknowns_);
  for (std::size_t s = 0; s < shells_.size(); ++s)
    image.segment(3 * sheets_[s].first_vertex, 3 * sheets_[s].vertices) =
        shells_[s].dynamics->solve(step.t_new, step.dt, force_on(sheets_[s]), segment(d, s)).positions;
  return image;
}

void Structure::accept(const TimeStep& step, const Eigen::VectorXd& d)
{
  for (std::size_t s = 0; s < shells_.size(); ++s)
    sharp_folds_ += shells_[s].dynamics->accept(segment(d, s), step.t_new, step.dt, force_on(sheets_[s])).n_sharp;
}

std::vector<Vec3> Structure::accepted_positions(double t) const
{
  std::vector<Vec3> positions;
  for (const ShellPart& part : shells_)
    append(positions, part.dynamics->accepted().x);
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices)
      positions.push_back(sheet.moves ? sheet.position(x_0, t) : x_0);
  return positions;
}

std::vector<Vec3> Structure::accepted_velocities(double t, double dt) const
{
  std::vector<Vec3> velocities;
  for (const ShellPart& part : shells_)
    append(velocities, part.dynamics->accepted().v);
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices)
      velocities.push_back(sheet.moves ? rates(sheet, x_0, t, dt).velocity : Vec3(Vec3::Zero()));
  return velocities;
}

std::string Structure::place_of(const Eigen::VectorXd& d) const
{
  Eigen::Index worst = 0;
  for (Eigen::Index n = 1; n < d.size() && std::isfinite(d[worst]); ++n)
    if (!(std::abs(d[n]) <= std::abs(d[worst])))
      worst = n;
  const int vertex = static_cast<int>(worst / 3);
  const auto sheet = std::find_if(sheets_.begin(), sheets_.end(),
                                  [vertex](const SheetRange& s) { return vertex < s.first_vertex + s.vertices; });
  const Vec3 x = shells_[sheet->part].dynamics->accepted().x.segment<3>(3 * (vertex - sheet->first_vertex));
  return fmt::format("vertex {} of shell '{}' at ({:.4g}, {:.4g}, {:.4g})", vertex - sheet->first_vertex, sheet->name,
                     x[0], x[1], x[2]);
}

shell::EnergyLedger Structure::energy() const
{
  shell::EnergyLedger sum;
  for (const ShellPart& part : shells_) {
    const shell::EnergyLedger& e = part.dynamics->ledger();
    sum.kinetic += e.kinetic;
    sum.elastic += e.elastic;
    sum.damping_work += e.damping_work;
    sum.external_work += e.external_work;
  }
  return sum;
}

}  // namespace luff::simulation
