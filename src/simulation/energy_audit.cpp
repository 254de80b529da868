// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/energy_audit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace luff::simulation {

namespace {

constexpr std::array parts{&AuditedEnergy::kinetic, &AuditedEnergy::growth,   &AuditedEnergy::dissipation,
                           &AuditedEnergy::sides,   &AuditedEnergy::surfaces, &AuditedEnergy::body_force};
constexpr std::array flow_parts{&fluid::FlowEnergy::kinetic, &fluid::FlowEnergy::dissipation, &fluid::FlowEnergy::sides,
                                &fluid::FlowEnergy::body_force};

}  // namespace

double AuditedEnergy::turnover() const
{
  return 0.5 * (std::abs(growth) + std::abs(dissipation) + std::abs(sides) + std::abs(surfaces) + std::abs(body_force) +
                std::abs(missing()));
}

std::optional<AuditedEnergy> EnergyAudit::record(const TimeStep& step, const fluid::FlowSolver& flow,
                                                 double power_on_surfaces)
{
  const bool due = step.index % every_ == 0;
  if (!due && (step.index + 1) % every_ != 0)
    return std::nullopt;
  const Instant now{step.index, fluid::energy(flow, step.t_new), -power_on_surfaces};
  const Instant before = std::exchange(before_, now);
  // What surfaces do at the start of the first step is not known.
  if (!due || before.step == 0 || before.step != now.step - 1)
    return std::nullopt;
  const AuditedEnergy audited{.kinetic = now.flow.kinetic,
                              .growth = (now.flow.kinetic - before.flow.kinetic) / step.dt,
                              .dissipation = 0.5 * (before.flow.dissipation + now.flow.dissipation),
                              .sides = 0.5 * (before.flow.sides + now.flow.sides),
                              .surfaces = 0.5 * (before.surfaces + now.surfaces),
                              .body_force = 0.5 * (before.flow.body_force + now.flow.body_force)};
  for (const auto part : parts)
    sum_.*part += audited.*part;
  square_ += audited.missing() * audited.missing();
  ++audits_;
  return audited;
}

EnergyVerdict EnergyAudit::verdict() const
{
  EnergyVerdict verdict{.mean = sum_, .audits = audits_};
  const double n = static_cast<double>(std::max(1L, audits_));
  for (const auto part : parts)
    verdict.mean.*part /= n;
  if (const double turnover = verdict.mean.turnover(); turnover > 0.0) {
    verdict.mismatch = std::abs(verdict.mean.missing()) / turnover;
    verdict.deviation = std::sqrt(square_ / n) / turnover;
  }
  return verdict;
}

std::vector<double> EnergyAudit::numbers() const
{
  std::vector<double> all{static_cast<double>(audits_), square_, static_cast<double>(before_.step), before_.surfaces};
  for (const auto part : parts)
    all.push_back(sum_.*part);
  for (const auto part : flow_parts)
    all.push_back(before_.flow.*part);
  return all;
}

void EnergyAudit::restore(const double* numbers)
{
  audits_ = std::lround(numbers[0]);
  square_ = numbers[1];
  before_.step = std::lround(numbers[2]);
  before_.surfaces = numbers[3];
  numbers += 4;
  for (const auto part : parts)
    sum_.*part = *numbers++;
  for (const auto part : flow_parts)
    before_.flow.*part = *numbers++;
}

}  // namespace luff::simulation
