// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/force_audit.hpp"

#include <algorithm>
#include <cmath>

#include "surface/solid.hpp"

namespace luff::simulation {

namespace {

/// int u dV over the inside of a closed surface that moves rigidly: tetrahedra from its first vertex.
Vec3 displaced_momentum(const SheetRange& sheet, const std::vector<Vec3>& x, const std::vector<Vec3>& u)
{
  const int first = sheet.first_vertex;
  Vec3 sum = Vec3::Zero();
  for (const auto& [a, b, c] : sheet.reference.triangles) {
    const Vec3 ra = x[first + a] - x[first];
    const double volume = ra.dot((x[first + b] - x[first]).cross(x[first + c] - x[first])) / 6.0;
    sum += 0.25 * volume * (u[first] + u[first + a] + u[first + b] + u[first + c]);
  }
  return sum;
}

bool is_closed(const Structure& structure, const SheetRange& sheet)
{
  return !sheet.deforms && structure.rigid()[sheet.part].closed;
}

std::vector<double> displaced_volumes(const Structure& structure)
{
  std::vector<double> volumes;
  for (const SheetRange& sheet : structure.sheets())
    volumes.push_back(is_closed(structure, sheet) ? surface::solid(sheet.reference).volume : 0.0);
  return volumes;
}

bool overlap(const IndexBox& a, const IndexBox& b)
{
  return intersection(a, b).volume() > 0;
}

IndexBox united(const IndexBox& a, const IndexBox& b)
{
  IndexBox both = a;
  for (int d = 0; d < 3; ++d) {
    both.lo[d] = std::min(a.lo[d], b.lo[d]);
    both.hi[d] = std::max(a.hi[d], b.hi[d]);
  }
  return both;
}

}  // namespace

ForceAudit::ForceAudit(int every, const Structure& structure)
    : every_(every),
      displaced_volume_(displaced_volumes(structure)),
      before_(structure.sheets().size()),
      sums_(structure.sheets().size())
{
}

std::vector<AuditedForce> ForceAudit::record(const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure)
{
  std::vector<AuditedForce> result;
  std::vector<Instant> now = instants(structure, step);
  double work = 0.0;
  for (std::size_t s = 0; s < now.size(); ++s)
    if (structure.sheets()[s].deforms)
      work += 0.5 * step.dt * (before_[s].power + now[s].power);
  flow_work_ += work;
  exchanged_ += std::abs(work);
  // The forces at the start of the first step are not known.
  if (step.index > 1 && step.index % every_ == 0) {
    result = audit(now, step, flow, structure);
    for (std::size_t s = 0; s < now.size(); ++s) {
      const AuditedForce& audited = result[s];
      sums_[s].by_traction += audited.by_traction;
      sums_[s].by_momentum += audited.by_momentum;
      sums_[s].square += audited.by_momentum.squaredNorm();
      sums_[s].square_of_difference += (audited.by_traction - audited.by_momentum).squaredNorm();
    }
    ++audits_;
  }
  before_ = std::move(now);
  return result;
}

std::vector<ForceAudit::Instant> ForceAudit::instants(const Structure& structure, const TimeStep& step) const
{
  const std::vector<Vec3> x = structure.accepted_positions(step.t_new);
  const std::vector<Vec3> u = structure.accepted_velocities(step.t_new, step.dt);
  std::vector<Instant> all;
  for (const SheetRange& sheet : structure.sheets()) {
    Instant now;
    for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertices; ++v) {
      now.force += structure.loads().force(v);
      now.power += structure.loads().force(v).dot(u[v]);
      now.inner_force += structure.inner_loads()[v];
      now.inner_power += structure.inner_loads()[v].dot(u[v]);
    }
    if (is_closed(structure, sheet))
      now.displaced_momentum = displaced_momentum(sheet, x, u);
    all.push_back(now);
  }
  return all;
}

/// Around each surface; surfaces whose boxes overlap share one that holds them all.
std::vector<IndexBox> ForceAudit::boxes(const fluid::FlowSolver& flow, const Structure& structure) const
{
  std::vector<IndexBox> all;
  for (const SheetRange& sheet : structure.sheets())
    all.push_back(flow.cells_around(sheet.first_triangle, sheet.triangles, margin));
  bool grown = true;
  while (grown) {
    grown = false;
    for (IndexBox& a : all)
      for (const IndexBox& b : all)
        if (overlap(a, b) && !(united(a, b) == a)) {
          a = united(a, b);
          grown = true;
        }
  }
  return all;
}

/// Surfaces that share a box get the same numbers.
std::vector<AuditedForce> ForceAudit::audit(const std::vector<Instant>& now, const TimeStep& step,
                                            fluid::FlowSolver& flow, const Structure& structure) const
{
  const fluid::FlowOverStep accepted = flow.accepted_step();
  const std::vector<IndexBox> around = boxes(flow, structure);
  std::vector<AuditedForce> all(now.size());
  for (std::size_t s = 0; s < now.size(); ++s) {
    const std::size_t first = std::find(around.begin(), around.end(), around[s]) - around.begin();
    if (first == s)
      all[s].by_momentum = flow.force_by_momentum(accepted, around[s]);
    const AuditedForce own = share(s, now[s], step, flow.options(), structure);
    all[first].by_traction += own.by_traction;
    all[first].by_momentum += own.by_momentum;
  }
  for (std::size_t s = 0; s < now.size(); ++s)
    all[s] = all[std::find(around.begin(), around.end(), around[s]) - around.begin()];
  return all;
}

/// What a surface adds: the force on it, the momentum and the body force of the fluid that it displaces, and what the
/// fluid inside of a skin takes.
AuditedForce ForceAudit::share(std::size_t surface, const Instant& now, const TimeStep& step,
                               const fluid::FlowOptions& flow, const Structure& structure) const
{
  const Instant& before = before_[surface];
  AuditedForce own{.by_traction = 0.5 * (before.force + now.force),
                   .by_momentum = flow.density * (now.displaced_momentum - before.displaced_momentum) / step.dt -
                                  0.5 * (before.inner_force + now.inner_force)};
  if (displaced_volume_[surface] == 0.0)
    return own;
  const double t = 0.5 * (step.t_old + step.t_new);
  const Vec3 centre = structure.body_motion(structure.sheets()[surface].part, step.t_new, step.dt).centre;
  own.by_momentum -= flow.density * displaced_volume_[surface] * flow.acceleration.value(centre, t);
  return own;
}

std::vector<AuditVerdict> ForceAudit::verdicts() const
{
  std::vector<AuditVerdict> all;
  const double n = static_cast<double>(std::max(1L, audits_));
  for (const Sums& sums : sums_) {
    AuditVerdict verdict{.by_traction = sums.by_traction / n,
                         .by_momentum = sums.by_momentum / n,
                         .scale = std::sqrt(sums.square / n),
                         .audits = audits_};
    if (verdict.scale > 0.0) {
      verdict.mismatch = (verdict.by_traction - verdict.by_momentum).norm() / verdict.scale;
      verdict.deviation = std::sqrt(sums.square_of_difference / n) / verdict.scale;
    }
    all.push_back(verdict);
  }
  return all;
}

double ForceAudit::power() const
{
  double sum = 0.0;
  for (const Instant& instant : before_)
    sum += instant.power + instant.inner_power;
  return sum;
}

std::vector<double> ForceAudit::numbers() const
{
  std::vector<double> all{static_cast<double>(audits_), flow_work_, exchanged_};
  const auto add = [&all](const Vec3& v) { all.insert(all.end(), v.begin(), v.end()); };
  for (const Sums& sums : sums_) {
    add(sums.by_traction);
    add(sums.by_momentum);
    all.push_back(sums.square);
    all.push_back(sums.square_of_difference);
  }
  for (const Instant& instant : before_) {
    add(instant.force);
    add(instant.displaced_momentum);
    all.push_back(instant.power);
    add(instant.inner_force);
    all.push_back(instant.inner_power);
  }
  return all;
}

void ForceAudit::restore(const std::vector<double>& numbers)
{
  const double* next = numbers.data();
  const auto take = [&next] { return *next++; };
  const auto take_vector = [&next] {
    const Vec3 v(next[0], next[1], next[2]);
    next += 3;
    return v;
  };
  audits_ = std::lround(take());
  flow_work_ = take();
  exchanged_ = take();
  for (Sums& sums : sums_) {
    sums.by_traction = take_vector();
    sums.by_momentum = take_vector();
    sums.square = take();
    sums.square_of_difference = take();
  }
  for (Instant& instant : before_) {
    instant.force = take_vector();
    instant.displaced_momentum = take_vector();
    instant.power = take();
    instant.inner_force = take_vector();
    instant.inner_power = take();
  }
}

}  // namespace luff::simulation
