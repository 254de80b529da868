// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/structure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace luff::simulation {

namespace {

void append(std::vector<Vec3>& to, const std::vector<Vec3>& values)
{
  to.insert(to.end(), values.begin(), values.end());
}

/// Vertices of one piece of a shell.
std::span<const Vec3> of_piece(const std::vector<Vec3>& all, const shell::PieceRange& piece)
{
  return std::span(all).subspan(piece.first_vertex, piece.n_vertices);
}

}  // namespace

Structure::Structure(Shells shells, std::vector<RigidSheet> rigid)
    : shells_(std::move(shells)), rigid_(std::move(rigid))
{
  int part = 0;
  if (shells_.shell) {
    shells_.marks.resize(shells_.shell->pieces().size());
    for (const shell::PieceRange& piece : shells_.shell->pieces()) {
      if (const Skin* skin = skin_of(part))
        add_sheet(piece.name, true, part, skin->reference(), skin->marks());
      else
        add_sheet(piece.name, true, part, shells_.shell->reference_of(piece), shells_.marks[part]);
      ++part;
    }
    length_ = shells_.shell->size();
  }
  part = 0;
  first_rigid_vertex_ = vertices_;
  for (const RigidSheet& sheet : rigid_) {
    add_sheet(sheet.name, false, part++, sheet.mesh, sheet.marks);
    if (!sheet.free)
      continue;
    const double size = sheet.free->properties().length;
    length_ = answers_flow() ? std::max(length_, size) : size;
    ++n_free_;
  }
  const std::vector<Vec3> none(vertices_, Vec3::Zero());
  loads_ = {none, none};
  inner_loads_ = none;
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

template <class Sheets, class Visit>
void Structure::for_each_free(Sheets& rigid, int first_vertex, Visit visit)
{
  int n = 0;
  for (auto& sheet : rigid) {
    if (sheet.free)
      visit(sheet, first_vertex, n++);
    first_vertex += sheet.mesh.n_vertices();
  }
}

Eigen::Index Structure::shell_unknowns() const
{
  return shells_.dynamics ? Eigen::Index{3} * shells_.shell->n_vertices() : 0;
}

Vec6 Structure::body_part(const Eigen::VectorXd& d, int n) const
{
  return d.segment<6>(shell_unknowns() + Eigen::Index{6} * n);
}

Eigen::VectorXd Structure::predict(const TimeStep& step) const
{
  Eigen::VectorXd d(shell_unknowns() + Eigen::Index{6} * n_free_);
  if (shells_.dynamics)
    d.head(shell_unknowns()) = shells_.dynamics->predicted_positions(step.dt);
  for_each_free(rigid_, first_rigid_vertex_, [&](const RigidSheet& sheet, int, int n) {
    d.segment<6>(shell_unknowns() + Eigen::Index{6} * n) = sheet.free->predict(step.dt);
  });
  return d;
}

namespace {

void append_prescribed(immersed::SheetMotion& motion, const RigidSheet& sheet, const TimeStep& step)
{
  for (const Vec3& x_0 : sheet.mesh.vertices) {
    const shell::Rates r =
        sheet.moves ? sheet.motion.rates(x_0, step.t_new, step.dt) : shell::Rates{Vec3::Zero(), Vec3::Zero()};
    motion.position.push_back(sheet.moves ? sheet.motion.position(x_0, step.t_new) : x_0);
    motion.velocity.push_back(r.velocity);
    motion.acceleration.push_back(r.acceleration);
  }
}

/// The acceleration is the mean of the step.
void append_free(immersed::SheetMotion& motion, const RigidSheet& sheet, const Vec6& d, const TimeStep& step)
{
  const RigidState& before = sheet.free->accepted();
  const RigidState after = sheet.free->state(d, step.dt);
  for (const Vec3& x_0 : sheet.mesh.vertices) {
    const Vec3 arm = x_0 - sheet.centre;
    motion.position.push_back(after.position(arm));
    motion.velocity.push_back(after.velocity_of(arm));
    motion.acceleration.emplace_back((after.velocity_of(arm) - before.velocity_of(arm)) / step.dt);
  }
}

}  // namespace

immersed::SheetMotion Structure::motion(const Eigen::VectorXd& d, const TimeStep& step) const
{
  immersed::SheetMotion motion;
  motion.triangles = triangles_;
  if (shells_.dynamics) {
    const Eigen::VectorXd x = d.head(shell_unknowns());
    append(motion.position, wetted_positions(x));
    const shell::Kinematics k = shells_.dynamics->kinematics(x, step.dt);
    append(motion.velocity, wetted_rates(x, k.v));
    append(motion.acceleration, wetted_rates(x, k.a));
  }
  int n_free = 0;
  for (const RigidSheet& sheet : rigid_) {
    if (sheet.free)
      append_free(motion, sheet, body_part(d, n_free++), step);
    else
      append_prescribed(motion, sheet, step);
  }
  for (const SheetRange& sheet : sheets_)
    if (!sheet.deforms && rigid_[sheet.part].closed)
      motion.bodies.push_back({.first_vertex = sheet.first_vertex,
                               .vertices = sheet.vertices,
                               .first_triangle = sheet.first_triangle,
                               .triangles = sheet.triangles});
  return motion;
}

std::vector<Vec3> Structure::velocity(const Eigen::VectorXd& d, const TimeStep& step) const
{
  return motion(d, step).velocity;
}

const Skin* Structure::skin_of(std::size_t piece) const
{
  return piece < shells_.skins.size() && shells_.skins[piece] ? &*shells_.skins[piece] : nullptr;
}

std::vector<Vec3> Structure::wetted_positions(const Eigen::VectorXd& x) const
{
  const std::vector<Vec3> middle = surface::points(x);
  std::vector<Vec3> wetted;
  for (std::size_t n = 0; n < shells_.shell->pieces().size(); ++n) {
    const std::span<const Vec3> own = of_piece(middle, shells_.shell->pieces()[n]);
    const Skin* skin = skin_of(n);
    append(wetted, skin != nullptr ? skin->positions(own) : std::vector<Vec3>(own.begin(), own.end()));
  }
  return wetted;
}

std::vector<Vec3> Structure::wetted_rates(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const
{
  const std::vector<Vec3> middle = surface::points(x);
  const std::vector<Vec3> rates = surface::points(v);
  std::vector<Vec3> wetted;
  for (std::size_t n = 0; n < shells_.shell->pieces().size(); ++n) {
    const shell::PieceRange& piece = shells_.shell->pieces()[n];
    const std::span<const Vec3> own = of_piece(rates, piece);
    const Skin* skin = skin_of(n);
    append(wetted,
           skin != nullptr ? skin->rates(of_piece(middle, piece), own) : std::vector<Vec3>(own.begin(), own.end()));
  }
  return wetted;
}

template <class Visit>
void Structure::for_each_vertex_of_skins(Visit visit) const
{
  for (const SheetRange& sheet : sheets_)
    if (sheet.deforms && skin_of(sheet.part) != nullptr)
      for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertices; ++v)
        visit(v);
}

/// The fluid inside of a skin stands where the material is.
immersed::SheetLoads Structure::felt(immersed::SheetLoads loads) const
{
  for_each_vertex_of_skins([&](int v) { loads.minus[v].setZero(); });
  return loads;
}

void Structure::take_loads(const immersed::SheetLoads& loads)
{
  loads_ = felt(loads);
  for_each_vertex_of_skins([&](int v) { inner_loads_[v] = loads.minus[v]; });
}

Eigen::VectorXd Structure::forces_on_shells(const Eigen::VectorXd& x) const
{
  const std::vector<Vec3> middle = surface::points(x);
  std::vector<Vec3> force;
  for (const SheetRange& sheet : sheets_) {
    if (!sheet.deforms)
      continue;
    std::vector<Vec3> own;
    for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertices; ++v)
      own.push_back(loads_.force(v));
    const Skin* skin = skin_of(sheet.part);
    append(force, skin != nullptr ? skin->forces(of_piece(middle, shells_.shell->pieces()[sheet.part]), own) : own);
  }
  return surface::interleaved(force);
}

/// Of the flow on a free body, about its centre.
Wrench Structure::wrench(int first_vertex, const RigidSheet& sheet, const RigidState& state) const
{
  Wrench sum;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v) {
    const Vec3 force = loads_.force(first_vertex + v);
    sum.force += force;
    sum.moment += (state.turn * (sheet.mesh.vertices[v] - sheet.centre)).cross(force);
  }
  return sum;
}

Eigen::VectorXd Structure::solve(const TimeStep& step, const immersed::SheetLoads& loads, const Eigen::VectorXd& d)
{
  take_loads(loads);
  Eigen::VectorXd image = d;
  if (shells_.dynamics) {
    const Eigen::VectorXd x = d.head(shell_unknowns());
    const shell::Dynamics::Trial trial = shells_.dynamics->solve(step.t_new, step.dt, forces_on_shells(x), x);
    newton_iterations_ += trial.report.iterations;
    image.head(shell_unknowns()) = trial.positions;
  }
  for_each_free(rigid_, first_rigid_vertex_, [&](const RigidSheet& sheet, int first_vertex, int n) {
    const Wrench flow = wrench(first_vertex, sheet, sheet.free->state(body_part(d, n), step.dt));
    image.segment<6>(shell_unknowns() + Eigen::Index{6} * n) = sheet.free->solve(flow, step.dt);
  });
  return image;
}

void Structure::accept(const TimeStep& step, const Eigen::VectorXd& d)
{
  if (shells_.dynamics) {
    const Eigen::VectorXd x = d.head(shell_unknowns());
    sharp_folds_ += shells_.dynamics->accept(x, step.t_new, step.dt, forces_on_shells(x)).n_sharp;
  }
  for_each_free(rigid_, first_rigid_vertex_, [&](RigidSheet& sheet, int first_vertex, int n) {
    const Vec6 own = body_part(d, n);
    sheet.free->accept(own, wrench(first_vertex, sheet, sheet.free->state(own, step.dt)), step.dt);
  });
}

void Structure::restore(const shell::Checkpoint& shells, long newton_iterations, long sharp_folds)
{
  if (shells_.dynamics)
    shells_.dynamics->restore(shells);
  newton_iterations_ = newton_iterations;
  sharp_folds_ = sharp_folds;
}

std::vector<double> Structure::free_bodies() const
{
  std::vector<double> saved;
  for_each_free(rigid_, first_rigid_vertex_, [&](const RigidSheet& sheet, int, int) {
    const RigidBody::Checkpoint own = sheet.free->checkpoint();
    saved.insert(saved.end(), own.begin(), own.end());
  });
  return saved;
}

void Structure::restore_free_bodies(const std::vector<double>& saved)
{
  for_each_free(rigid_, first_rigid_vertex_, [&](RigidSheet& sheet, int, int n) {
    RigidBody::Checkpoint own;
    std::copy_n(saved.begin() + n * static_cast<std::ptrdiff_t>(own.size()), own.size(), own.begin());
    sheet.free->restore(own);
  });
}

std::vector<Vec3> Structure::accepted_positions(double t) const
{
  std::vector<Vec3> positions;
  if (shells_.dynamics)
    append(positions, wetted_positions(shells_.dynamics->accepted().x));
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices) {
      if (sheet.free)
        positions.push_back(sheet.free->accepted().position(x_0 - sheet.centre));
      else
        positions.push_back(sheet.moves ? sheet.motion.position(x_0, t) : x_0);
    }
  return positions;
}

std::vector<Vec3> Structure::accepted_velocities(double t, double dt) const
{
  std::vector<Vec3> velocities;
  if (shells_.dynamics)
    append(velocities, wetted_rates(shells_.dynamics->accepted().x, shells_.dynamics->accepted().v));
  for (const RigidSheet& sheet : rigid_)
    for (const Vec3& x_0 : sheet.mesh.vertices) {
      if (sheet.free)
        velocities.push_back(sheet.free->accepted().velocity_of(x_0 - sheet.centre));
      else
        velocities.push_back(sheet.moves ? sheet.motion.rates(x_0, t, dt).velocity : Vec3(Vec3::Zero()));
    }
  return velocities;
}

BodyMotion Structure::body_motion(int part, double t, double dt) const
{
  const RigidSheet& sheet = rigid_[part];
  const auto rotation_vector = [](const auto& turn) -> Vec3 {
    const Eigen::AngleAxisd rotation(turn);
    return rotation.angle() * rotation.axis();
  };
  if (sheet.free) {
    const RigidState& state = sheet.free->accepted();
    return {state.centre, rotation_vector(state.turn), state.velocity, state.spin};
  }
  if (!sheet.moves)
    return {.centre = sheet.centre};
  std::vector<Vec3> points;
  std::vector<Vec3> velocities;
  for (const Vec3& x_0 : sheet.mesh.vertices) {
    points.push_back(sheet.motion.position(x_0, t));
    velocities.push_back(sheet.motion.rates(x_0, t, dt).velocity);
  }
  const immersed::RigidVelocity rigid = immersed::nearest_rigid_velocity(points, velocities);
  const Vec3 centre = sheet.motion.position(sheet.centre, t);
  return {centre, rotation_vector(sheet.motion.turn(t)), rigid.at(centre), rigid.spin};
}

std::string Structure::place_of(const Eigen::VectorXd& d) const
{
  Eigen::Index worst = 0;
  for (Eigen::Index n = 1; n < d.size() && std::isfinite(d[worst]); ++n)
    if (!(std::abs(d[n]) <= std::abs(d[worst])))
      worst = n;
  if (worst >= shell_unknowns()) {
    std::string place;
    for_each_free(rigid_, first_rigid_vertex_, [&](const RigidSheet& sheet, int, int n) {
      const Vec3& x = sheet.free->accepted().centre;
      if (n == (worst - shell_unknowns()) / 6)
        place = fmt::format("body '{}' at ({:.4g}, {:.4g}, {:.4g})", sheet.name, x[0], x[1], x[2]);
    });
    return place;
  }
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
