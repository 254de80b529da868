// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/audit_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace luff::simulation {

namespace {

/// Difference of mean forces by traction and by momentum that deserves a warning.
constexpr double trusted_mismatch = 0.05;

std::vector<output::Column> columns_of(const Structure& structure)
{
  std::vector<output::Column> columns{{"t", "time"}};
  for (const SheetRange& sheet : structure.sheets())
    for (const char* name : {"by_traction_", "by_momentum_"})
      output::add_vector(columns, name + sheet.name, "force");
  columns.push_back({"kinetic", "energy"});
  for (const char* name :
       {"growth", "dissipation", "power_of_sides", "power_of_surfaces", "power_of_body_force", "missing"})
    columns.push_back({name, "power"});
  return columns;
}

nlohmann::ordered_json list_of(const Vec3& v)
{
  return {v[0], v[1], v[2]};
}

}  // namespace

AuditRecord::AuditRecord(const output::RunFolder& folder, int every, const Structure& structure,
                         const output::EarlierOutput* earlier)
    : audit_(every, structure), energy_(every), table_(folder, "audit.csv", columns_of(structure), earlier)
{
}

double AuditRecord::record(const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure)
{
  const std::vector<AuditedForce> forces = audit_.record(step, flow, structure);
  const std::optional<AuditedEnergy> energy = energy_.record(step, flow, audit_.power());
  const std::vector<AuditVerdict> so_far = audit_.verdicts();
  if (!energy)
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row{0.5 * (step.t_old + step.t_new)};
  double worst = 0.0;
  for (std::size_t s = 0; s < forces.size(); ++s) {
    output::add_vector(row, forces[s].by_traction);
    output::add_vector(row, forces[s].by_momentum);
    if (so_far[s].scale > 0.0)
      worst = std::max(worst, (forces[s].by_traction - forces[s].by_momentum).norm() / so_far[s].scale);
  }
  for (const double part : {energy->kinetic, energy->growth, energy->dissipation, energy->sides, energy->surfaces,
                            energy->body_force, energy->missing()})
    row.push_back(part);
  table_.row(row);
  return forces.empty() ? std::numeric_limits<double>::quiet_NaN() : worst;
}

std::vector<double> AuditRecord::numbers() const
{
  std::vector<double> all = energy_.numbers();
  const std::vector<double> of_forces = audit_.numbers();
  all.insert(all.end(), of_forces.begin(), of_forces.end());
  return all;
}

void AuditRecord::restore(const std::vector<double>& numbers)
{
  energy_.restore(numbers.data());
  audit_.restore({numbers.begin() + EnergyAudit::size, numbers.end()});
}

void AuditRecord::report(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const
{
  report_forces(structure, log, summary);
  report_work(structure, log, summary);
  report_energy(log, summary);
}

void AuditRecord::report_forces(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const
{
  const auto& sheets = structure.sheets();
  const std::vector<AuditVerdict> verdicts = audit_.verdicts();
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const AuditVerdict& v = verdicts[s];
    if (v.audits == 0)
      continue;
    summary["audit"][sheets[s].name] = {{"audits", v.audits},
                                        {"mean_force_by_traction", list_of(v.by_traction)},
                                        {"mean_force_by_momentum", list_of(v.by_momentum)},
                                        {"mismatch_of_means", v.mismatch},
                                        {"rms_of_difference", v.deviation}};
    log.info(
        "force audit of '{}': mean force by traction ({:.4g}, {:.4g}, {:.4g}), by momentum ({:.4g}, {:.4g}, "
        "{:.4g}), apart {:.1f} %; single steps {:.1f} %",
        sheets[s].name, v.by_traction[0], v.by_traction[1], v.by_traction[2], v.by_momentum[0], v.by_momentum[1],
        v.by_momentum[2], 100.0 * v.mismatch, 100.0 * v.deviation);
    if (v.mismatch > trusted_mismatch)
      log.warn(
          "the forces on '{}' differ by {:.0f} % from what the fluid around it loses: refine the grid there, or "
          "shorten time.step",
          sheets[s].name, 100.0 * v.mismatch);
  }
}

void AuditRecord::report_work(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const
{
  if (audit_.exchanged() == 0.0)
    return;
  const double work = structure.energy().fluid_work;
  const double apart = std::abs(audit_.flow_work() - work) / audit_.exchanged();
  summary["audit"]["work"] = {
      {"by_flow", audit_.flow_work()}, {"on_shells", work}, {"exchanged", audit_.exchanged()}, {"mismatch", apart}};
  log.info(
      "work of the flow on shells: {:.4g} as the flow counts it, {:.4g} as the shells do, apart {:.2f} % of the "
      "{:.4g} that went to and fro",
      audit_.flow_work(), work, 100.0 * apart, audit_.exchanged());
}

void AuditRecord::report_energy(spdlog::logger& log, nlohmann::ordered_json& summary) const
{
  const EnergyVerdict verdict = energy_.verdict();
  if (verdict.audits == 0)
    return;
  const AuditedEnergy& mean = verdict.mean;
  summary["audit"]["energy"] = {{"audits", verdict.audits},
                                {"kinetic", mean.kinetic},
                                {"growth", mean.growth},
                                {"dissipation", mean.dissipation},
                                {"power_of_sides", mean.sides},
                                {"power_of_surfaces", mean.surfaces},
                                {"power_of_body_force", mean.body_force},
                                {"missing", mean.missing()},
                                {"mismatch", verdict.mismatch},
                                {"rms_of_missing", verdict.deviation}};
  log.info(
      "energy of the flow: growth {:.4g}, dissipation {:.4g}, power of sides {:.4g}, of surfaces {:.4g}, of the body "
      "force {:.4g}; the discretisation takes {:.4g}, {:.1f} % of what goes through",
      mean.growth, mean.dissipation, mean.sides, mean.surfaces, mean.body_force, mean.missing(),
      100.0 * verdict.mismatch);
}

}  // namespace luff::simulation
