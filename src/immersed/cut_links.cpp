// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_links.hpp"

#include "immersed/cell_metric.hpp"
#include "surface/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace luff::immersed {

namespace {

/// A hit on a link that the sheet grazes may run along it any distance.
constexpr double largest_drift = 1.0;

/// Value of a vertex field at a point of a triangle.
Vec3 interpolate(std::span<const Vec3> field, const std::array<int, 3>& triangle, const std::array<double, 3>& weights)
{
  return weights[0] * field[triangle[0]] + weights[1] * field[triangle[1]] + weights[2] * field[triangle[2]];
}

}  // namespace

CutLinks::CutLinks(const grid::Grid& grid)
    : grid_(grid),
      solid_(grid.owned(), 0),
      mark_{Field<int>(grid.owned(), open_link), Field<int>(grid.owned(), open_link),
            Field<int>(grid.owned(), open_link)}
{
}

void CutLinks::freeze(const SheetMotion& predicted, double dt, double speed, const FluxHistory& flow)
{
  dt_ = dt;
  positions_ = predicted.position;
  vertex_velocity_ = predicted.velocity;
  vertex_acceleration_ = predicted.acceleration;
  current_vertex_velocity_ = predicted.velocity;
  if (triangles_ != predicted.triangles) {
    triangles_ = predicted.triangles;
    free_edges_ = covers_in_part_ ? free_edges(triangles_) : std::vector<FreeEdge>();
  }
  bodies_ = predicted.bodies;
  find_crossings(predicted.position);
  interpolate_prediction(predicted);
  find_faces();
  find_cells();
  find_flipped();
  find_given_back();
  start_offsets(speed, flow);
}

/// What the hits know of the sheet: place, normal, velocity and acceleration; at closed bodies those of a rigid motion,
/// whose flux out of any set of cells is zero.
void CutLinks::interpolate_prediction(const SheetMotion& predicted)
{
  predicted_body_velocity_ = rigid_velocities(predicted.velocity);
  predicted_body_acceleration_ = rigid_velocities(predicted.acceleration);
  body_velocity_ = predicted_body_velocity_;
  const std::size_t n = crossings_.size();
  body_of_hit_.assign(n, -1);
  places_.resize(n);
  normals_.resize(n);
  drift_.resize(n);
  predicted_velocity_.resize(n);
  predicted_acceleration_.resize(n);
  for (std::size_t q = 0; q < n; ++q) {
    const auto& [a, b, c] = triangle(crossings_[q]);
    normals_[q] =
        surface::area_vector(predicted.position[a], predicted.position[b], predicted.position[c]).normalized();
    places_[q] = interpolate(predicted.position, triangle(crossings_[q]), crossings_[q].weights);
    predicted_velocity_[q] = interpolate(predicted.velocity, triangle(crossings_[q]), crossings_[q].weights);
    predicted_acceleration_[q] = interpolate(predicted.acceleration, triangle(crossings_[q]), crossings_[q].weights);
    if (const int body = body_of(crossings_[q].triangle); body >= 0) {
      body_of_hit_[q] = body;
      predicted_velocity_[q] = predicted_body_velocity_[body].at(places_[q]);
      predicted_acceleration_[q] = predicted_body_acceleration_[body].at(places_[q]);
    }
    drift_[q] = drift(static_cast<int>(q));
  }
  velocity_ = predicted_velocity_;
}

/// dt u_b . n/(n . link), u_b the predicted velocity in the middle of the step: the part of its link that a hit passes.
double CutLinks::drift(int hit) const
{
  if (held_)
    return 0.0;
  const Crossing& at = crossings_[hit];
  const double along = normals_[hit].dot(link_vector(grid_, at.axis, at.cell));
  const double passed = dt_ * normals_[hit].dot(velocity(hit, {0.5, SheetVelocity::Predicted}));
  return std::abs(passed) < largest_drift * std::abs(along) ? passed / along
                                                            : std::copysign(largest_drift, passed * along);
}

/// The closed body that a triangle bounds, or -1.
int CutLinks::body_of(int triangle) const
{
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    if (bodies_[body].holds(triangle))
      return static_cast<int>(body);
  return -1;
}

void CutLinks::find_crossings(std::span<const Vec3> positions)
{
  cover_.clear();
  if (free_edges_.empty()) {
    crossings_ = hits_of(positions, triangles_);
    return;
  }
  const FadingSheets sheets(grid_, positions, triangles_, free_edges_);
  crossings_ = hits_of(sheets.positions(), sheets.triangles());
  cover_ = sheets.settle(crossings_);
}

std::vector<Crossing> CutLinks::hits_of(std::span<const Vec3> positions, std::span<const std::array<int, 3>> triangles)
{
  if (grid_.kind() != grid::Kind::Curvilinear)
    return immersed::find_crossings(grid_, positions, triangles);
  if (triangles.empty())
    return {};
  if (!tree_)
    tree_ = make_link_tree(grid_);
  return tree_->find_crossings(positions, triangles);
}

void CutLinks::set_velocity(std::span<const Vec3> velocity)
{
  current_vertex_velocity_.assign(velocity.begin(), velocity.end());
  body_velocity_ = rigid_velocities(velocity);
  for (std::size_t q = 0; q < crossings_.size(); ++q)
    velocity_[q] = body_of_hit_[q] < 0 ? interpolate(velocity, triangle(crossings_[q]), crossings_[q].weights)
                                       : body_velocity_[body_of_hit_[q]].at(places_[q]);
}

std::vector<RigidVelocity> CutLinks::rigid_velocities(std::span<const Vec3> velocity) const
{
  std::vector<RigidVelocity> rigid;
  for (const ClosedSurface& body : bodies_)
    rigid.push_back(nearest_rigid_velocity(std::span(positions_).subspan(body.first_vertex, body.vertices),
                                           velocity.subspan(body.first_vertex, body.vertices)));
  return rigid;
}

Vec3 CutLinks::velocity_at(const SurfacePoint& point, const StageTime& time) const
{
  if (const int body = body_of(point.triangle); body >= 0)
    return body_velocity(body, point.place, time);
  const auto& corners = triangles_[point.triangle];
  if (time.sheet == SheetVelocity::Current)
    return interpolate(current_vertex_velocity_, corners, point.weights);
  return interpolate(vertex_velocity_, corners, point.weights) -
         (1.0 - time.fraction) * dt_ * interpolate(vertex_acceleration_, corners, point.weights);
}

Vec3 CutLinks::body_velocity(int body, const Vec3& x, const StageTime& time) const
{
  if (time.sheet == SheetVelocity::Current)
    return body_velocity_[body].at(x);
  return predicted_body_velocity_[body].at(x) - (1.0 - time.fraction) * dt_ * predicted_body_acceleration_[body].at(x);
}

/// One face per cut link; hits on a link follow one another, ordered by theta.
void CutLinks::find_faces()
{
  for (const CutFace& face : faces_)
    mark_[face.axis].view()(face.cell) = open_link;
  faces_.clear();
  for (int q = 0; q < static_cast<int>(crossings_.size()); ++q) {
    const Crossing& hit = crossings_[q];
    if (!faces_.empty() && faces_.back().axis == hit.axis && faces_.back().cell == hit.cell) {
      faces_.back().last = q;
      continue;
    }
    mark_[hit.axis].view()(hit.cell) = static_cast<int>(faces_.size());
    faces_.push_back({.axis = hit.axis, .cell = hit.cell, .first = q, .last = q});
  }
  for (CutFace& face : faces_)
    if (!cover_.empty() && face.first == face.last)
      face.cover = cover_[face.first];
}

/// The cells inside bodies, and those of the fluid beside cut faces.
CutCell uncut_cell(const grid::Grid& grid, const Index3& cell)
{
  CutCell result;
  result.cell = cell;
  result.face.fill(open_link);
  for (int a = 0; a < 3; ++a)
    result.along[a] = cell_axis(grid, a, cell);
  return result;
}

void CutLinks::find_cells()
{
  for (const InsideCell& inside : inside_)
    solid_.view()(inside.cell) = 0;
  inside_ = find_inside(grid_, crossings_, bodies_);
  for (const InsideCell& inside : inside_)
    solid_.view()(inside.cell) = 1;
  std::vector<std::array<int, 3>> beside;  // k, j, i: sorted as the fields are stored
  for (const CutFace& face : faces_)
    for (const Index3& c : {face.cell, stepped(face.cell, face.axis, -1)})
      if (grid_.owned().contains(c) && solid_.view()(c) == 0)
        beside.push_back({c[2], c[1], c[0]});
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  cells_.resize(beside.size());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < beside.size(); ++n) {
    CutCell& cut = cells_[n];
    cut = uncut_cell(grid_, {beside[n][2], beside[n][1], beside[n][0]});
    for (int a = 0; a < 3; ++a) {
      cut.face[2 * a] = mark_[a].view()(cut.cell);
      cut.face[2 * a + 1] = mark_[a].view()(stepped(cut.cell, a, 1));
    }
  }
}

namespace {

/// Covered part of a face from which on its link counts as crossed.
constexpr double crossed_from = 0.5;

}  // namespace

bool CutLinks::is_crossed(int face) const
{
  return face != open_link && faces_[face].cover >= crossed_from;
}

bool CutLinks::was_crossed(int axis, const Index3& cell) const
{
  const AcceptedOffset* const old = old_offset(key(axis, cell));
  return old != nullptr && old->cover >= crossed_from;
}

/// The sheet swept over a cell's centre when the cut moved from one of its faces to the opposite one.
void CutLinks::find_flipped()
{
  flipped_.clear();
  for (const CutCell& cut : cells_)
    for (int a = 0; a < 3; ++a) {
      const bool low = is_crossed(cut.face[2 * a]);
      const bool high = is_crossed(cut.face[2 * a + 1]);
      if (low == high)
        continue;
      const bool was_low = was_crossed(a, cut.cell);
      const bool was_high = was_crossed(a, stepped(cut.cell, a, 1));
      if (was_low != was_high && was_low != low) {
        flipped_.push_back(cut.cell);
        break;
      }
    }
}

/// Cells that were inside a body and are not any more; their velocity and fluxes are those of the body.
void CutLinks::find_given_back()
{
  const auto sweep_order = [](const Index3& a, const Index3& b) {
    return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
  };
  for (const InsideCell& before : accepted_inside_)
    if (solid_.view()(before.cell) == 0)
      flipped_.push_back(before.cell);
  std::sort(flipped_.begin(), flipped_.end(), sweep_order);
  flipped_.erase(std::unique(flipped_.begin(), flipped_.end()), flipped_.end());
}

namespace {

/// The velocity of a body at t^n, from that at t^{n+1} and the mean acceleration of the step.
RigidVelocity velocity_before(const RigidVelocity& velocity, const RigidVelocity& acceleration, double dt)
{
  return {.centre = velocity.centre - dt * (velocity.velocity - 0.5 * dt * acceleration.velocity),
          .velocity = velocity.velocity - dt * acceleration.velocity,
          .spin = velocity.spin - dt * acceleration.spin};
}

/// tau = d/speed of each body, d the mean length of its links: one for all of its faces, so that offsets that add up to
/// zero go on to do so.  Collective.
std::vector<double> decay_times(const grid::Grid& grid, std::size_t bodies, std::span<const CutFace> faces,
                                std::span<const int> body_of_hit, std::span<const Vec3> velocity, double speed,
                                double dt)
{
  std::vector<double> lengths(2 * bodies, 0.0);  // and numbers of faces
  std::vector<double> fastest(bodies, speed);
  for (const CutFace& face : faces)
    if (const int body = body_of_hit[face.first]; body >= 0) {
      fastest[body] = std::max(fastest[body], velocity[face.first].norm());
      if (!grid.owned().contains(face.cell))
        continue;  // another rank has it too
      lengths[2 * body] += distance_across(grid, face.axis, face.cell);
      lengths[2 * body + 1] += 1.0;
    }
  const MPI_Comm comm = grid.ranks().comm();
  MPI_Allreduce(MPI_IN_PLACE, lengths.data(), static_cast<int>(lengths.size()), MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, fastest.data(), static_cast<int>(fastest.size()), MPI_DOUBLE, MPI_MAX, comm);
  std::vector<double> times(bodies, dt);
  for (std::size_t b = 0; b < bodies; ++b)
    if (fastest[b] > 0.0 && lengths[2 * b + 1] > 0.0)
      times[b] = lengths[2 * b] / lengths[2 * b + 1] / fastest[b];
  return times;
}

struct Offset {
  double value;
  double rate;
};

/// The critically damped return of the offset to zero from its value and its rate at t^n,
///
///   eps(t) = (eps + b t) exp(-t/tau),   b = eps' + eps/tau,
///
/// a plain decay where b = 0.
Offset offset_at(const CutFace& face, double t)
{
  const double b = face.rate + face.offset / face.decay_time;
  const double left = std::exp(-t / face.decay_time);
  return {(face.offset + b * t) * left, (face.rate - b * t / face.decay_time) * left};
}

}  // namespace

void CutLinks::start_offsets(double speed, const FluxHistory& flow)
{
  set_decay_times(speed);
  std::vector<RigidVelocity> before;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    before.push_back(velocity_before(predicted_body_velocity_[b], predicted_body_acceleration_[b], dt_));
  const auto at_start = [&](int hit) -> Vec3 {
    const int body = body_of_hit_[hit];
    return body < 0 ? predicted_velocity_[hit] : before[body].at(places_[hit]);
  };
  for (CutFace& face : faces_) {
    const auto* old = old_offset(key(face.axis, face.cell));
    const Vec3 surface = 0.5 * (at_start(face.first) + at_start(face.last));
    const double mean = fluid_velocity(face, flow.U);
    const double open = old != nullptr && old->cover < 1.0 ? old->open : mean;
    const double change = face.cover - (old != nullptr ? old->cover : 0.0);
    face.open = open - mean;
    face.offset = old != nullptr ? old->offset : 0.0;
    if (change != 0.0)
      face.offset += change * (open - surface.dot(face_normal(grid_, face.axis, face.cell)));
    if (decays_plainly(face))
      face.rate = -face.offset / face.decay_time;
    else
      face.rate = old != nullptr ? old->rate : rate_of_newly_cut(face, flow);
  }
}

/// Where something else depends on the offsets' decay: the offsets of a body add up to zero, and the nodes of the
/// scheme curvib have offsets of their own.
bool CutLinks::decays_plainly(const CutFace& face) const
{
  return held_ || body_of_hit_[face.first] >= 0;
}

void CutLinks::set_decay_times(double speed)
{
  const std::vector<double> body_times =
      bodies_.empty() ? std::vector<double>()
                      : decay_times(grid_, bodies_.size(), faces_, body_of_hit_, predicted_velocity_, speed, dt_);
  for (CutFace& face : faces_) {
    const double fastest =
        std::max({speed, predicted_velocity_[face.first].norm(), predicted_velocity_[face.last].norm()});
    if (const int body = body_of_hit_[face.first]; body >= 0)
      face.passage = body_times[body];
    else
      face.passage = fastest > 0.0 ? distance_across(grid_, face.axis, face.cell) / fastest : dt_;
    face.decay_time = decays_plainly(face) ? face.passage : shell_decay * face.passage;
  }
}

/// (U^n - U^{n-1})/(A dt) - a_b . e, as far as it leads back to the sheet: between 0 and -fastest_return eps/tau.
/// Without bounds a very light shell throws the offset further than its own motion.
double CutLinks::rate_of_newly_cut(const CutFace& face, const FluxHistory& flow) const
{
  if (flow.dt <= 0.0)
    return 0.0;
  const Vec3 acceleration = 0.5 * (predicted_acceleration_[face.first] + predicted_acceleration_[face.last]);
  const double rate = (fluid_velocity(face, flow.U) - fluid_velocity(face, flow.U_before)) / flow.dt -
                      acceleration.dot(face_normal(grid_, face.axis, face.cell));
  const double fastest = -fastest_return * face.offset / face.decay_time;
  return std::clamp(face.cover * rate, std::min(0.0, fastest), std::max(0.0, fastest));
}

double CutLinks::fluid_velocity(const CutFace& face, const View3<const double>& U) const
{
  const auto [i, j, k] = face.cell;
  return U[face.axis](i, j, k) / grid_.area(face.axis, i, j, k);
}

/// c u_b . e + eps
double CutLinks::covered_velocity(const CutFace& face, const StageTime& time) const
{
  const Vec3 normal = face_normal(grid_, face.axis, face.cell);
  const double sheet = 0.5 * (velocity(face.first, time).dot(normal) + velocity(face.last, time).dot(normal));
  return face.cover * sheet + offset_at(face, time.fraction * dt_).value;
}

double CutLinks::open_velocity(const CutFace& face, const View3<const double>& U, const StageTime& time) const
{
  return (fluid_velocity(face, U) - covered_velocity(face, time)) / (1.0 - face.cover);
}

void CutLinks::impose_fluxes(const StageTime& time, const View3<double>& U) const
{
  for (const CutFace& face : faces_) {
    const auto [i, j, k] = face.cell;
    const double area = grid_.area(face.axis, i, j, k);
    double& flux = U[face.axis](i, j, k);
    const double through_open_part = face.cover < 1.0 ? (1.0 - face.cover) * (flux + area * face.open) : 0.0;
    flux = area * covered_velocity(face, time) + through_open_part;
  }
  impose_fluxes_inside(time, U);
}

/// Sides of the domain that a body ends on keep their own flux.
void CutLinks::impose_fluxes_inside(const StageTime& time, const View3<double>& U) const
{
  for (const auto& [cell, body] : inside_)
    for (int link = 0; link < 6; ++link) {
      const int axis = link / 2;
      const int side = link % 2;
      const Index3 face = stepped(cell, axis, side);
      const bool on_side =
          !grid_.ranks().periodic(axis) && (side == 0 ? face[axis] == 0 : face[axis] == grid_.cells()[axis]);
      if (on_side || is_cut(axis, face))
        continue;
      const Vec3 x = grid_.face_centre(axis, face[0], face[1], face[2]);
      U[axis](face) = grid_.area_vector(axis, face[0], face[1], face[2]).dot(body_velocity(body, x, time));
    }
}

void CutLinks::accept(const View3<const double>& U)
{
  const StageTime now{1.0, SheetVelocity::Current};
  accepted_offsets_.resize(faces_.size());
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const CutFace& face = faces_[n];
    const Offset end = offset_at(face, dt_);
    accepted_offsets_[n] = {key(face.axis, face.cell), end.value, end.rate, face.cover,
                            face.cover < 1.0 ? open_velocity(face, U, now) : 0.0};
  }
  accepted_inside_ = inside_;
}

/// Position of a face in the order in which crossings are sorted.
std::int64_t CutLinks::key(int axis, const Index3& cell) const
{
  const Index3& n = grid_.cells();
  return ((std::int64_t{axis} * (n[2] + 1) + cell[2]) * (n[1] + 1) + cell[1]) * (n[0] + 1) + cell[0];
}

std::pair<int, Index3> CutLinks::face_of(std::int64_t key) const
{
  const Index3& n = grid_.cells();
  Index3 cell{};
  for (int a = 0; a < 3; key /= n[a] + 1, ++a)
    cell[a] = static_cast<int>(key % (n[a] + 1));
  return {static_cast<int>(key), cell};
}

/// Whether a face is one of this rank's: low faces are their cell's, the last ones of the domain those of the cell
/// below.
bool CutLinks::keeps(std::int64_t key) const
{
  auto [axis, cell] = face_of(key);
  if (cell[axis] == grid_.cells()[axis])
    --cell[axis];
  return grid_.owned().contains(cell);
}

FluxOffsets CutLinks::accepted_offsets() const
{
  FluxOffsets mine;
  for (const AcceptedOffset& accepted : accepted_offsets_)
    if (keeps(accepted.face)) {
      mine.face.push_back(accepted.face);
      mine.offset.push_back(accepted.offset);
      mine.rate.push_back(accepted.rate);
      mine.cover.push_back(accepted.cover);
      mine.open.push_back(accepted.open);
    }
  for (const InsideCell& inside : accepted_inside_) {
    mine.inside.push_back(key(0, inside.cell));
    mine.inside_body.push_back(inside.body);
  }
  return mine;
}

void CutLinks::restore(const FluxOffsets& of_all_ranks)
{
  accepted_offsets_.clear();
  for (std::size_t n = 0; n < of_all_ranks.face.size(); ++n)
    accepted_offsets_.push_back({of_all_ranks.face[n], of_all_ranks.offset[n], of_all_ranks.rate[n],
                                 of_all_ranks.cover[n], of_all_ranks.open[n]});
  std::sort(accepted_offsets_.begin(), accepted_offsets_.end(),
            [](const AcceptedOffset& a, const AcceptedOffset& b) { return a.face < b.face; });
  accepted_inside_.clear();
  for (std::size_t n = 0; n < of_all_ranks.inside.size(); ++n)
    if (const Index3 cell = face_of(of_all_ranks.inside[n]).second; grid_.owned().contains(cell))
      accepted_inside_.push_back({cell, static_cast<int>(of_all_ranks.inside_body[n])});
}

const CutLinks::AcceptedOffset* CutLinks::old_offset(std::int64_t key) const
{
  const auto at = std::lower_bound(accepted_offsets_.begin(), accepted_offsets_.end(), key,
                                   [](const auto& entry, std::int64_t k) { return entry.face < k; });
  return at != accepted_offsets_.end() && at->face == key ? &*at : nullptr;
}

}  // namespace luff::immersed
