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
    : every_(every), before_(structure.sheets().size()), sums_(structure.sheets().size())
{
}

std::vector<AuditedForce> ForceAudit::record(const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure)
{
  std::vector<AuditedForce> result;
  std::vector<Instant> now = instants(structure, step);
  double work = 0.0;
  for (std::size_t s = 0; s < now.size(); ++s)
    work += 0.5 * step.dt * (before_[s].power + now[s].power);
  flow_work_ += work;
  exchanged_ += std::abs(work);
  // The forces at the start of the first step are not known.
  if (step.index > 1 && step.index % every_ == 0) {
    const std::vector<IndexBox> around = boxes(flow, structure);
    for (std::size_t s = 0; s < now.size(); ++s) {
      const AuditedForce audited = audit(s, around, now, step, flow, structure);
      sums_[s].by_traction += audited.by_traction;
      sums_[s].by_momentum += audited.by_momentum;
      sums_[s].square += audited.by_momentum.squaredNorm();
      sums_[s].square_of_difference += (audited.by_traction - audited.by_momentum).squaredNorm();
      result.push_back(audited);
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
      if (sheet.deforms)
        now.power += structure.loads().force(v).dot(u[v]);
    }
    if (is_closed(structure, sheet))
      now.displaced_momentum = displaced_momentum(sheet, x, u);
    all.push_back(now);
  }
  return all;
}

/// Around each surface, grown until no box cuts another surface's.
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

AuditedForce ForceAudit::audit(std::size_t surface, const std::vector<IndexBox>& boxes, const std::vector<Instant>& now,
                               const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure) const
{
  const double density = flow.options().density;
  AuditedForce result{.by_momentum = flow.force_by_momentum(boxes[surface])};
  for (std::size_t s = 0; s < now.size(); ++s) {
    if (!overlap(boxes[surface], boxes[s]))
      continue;
    result.by_traction += 0.5 * (before_[s].force + now[s].force);
    result.by_momentum += density * (now[s].displaced_momentum - before_[s].displaced_momentum) / step.dt;
    const SheetRange& sheet = structure.sheets()[s];
    if (!is_closed(structure, sheet))
      continue;
    const double t = 0.5 * (step.t_old + step.t_new);
    const surface::Solid body = surface::solid(sheet.reference);
    const Vec3 centre = structure.body_motion(sheet.part, step.t_new, step.dt).centre;
    result.by_momentum -= density * body.volume * flow.options().acceleration.value(centre, t);
  }
  return result;
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
  }
}

}  // namespace luff::simulation
