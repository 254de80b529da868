// SPDX-License-Identifier: BSD-3-Clause
// The table and the verdict of a run's audits.
#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <spdlog/logger.h>

#include "output/csv.hpp"
#include "simulation/energy_audit.hpp"
#include "simulation/force_audit.hpp"

namespace luff::simulation {

/// audit.csv, `audit` of the summary, and the lines of the log about them.
class AuditRecord {
 public:
  /// `every`: steps between two audits.
  AuditRecord(const output::RunFolder& folder, int every, const Structure& structure,
              const output::EarlierOutput* earlier);

  /// Audits an accepted step if it is due; halos of the flow are filled.  The largest mismatch of its forces over their
  /// mean so far; no number where none was due.  Collective.
  double record(const TimeStep& step, fluid::FlowSolver& flow, const Structure& structure);
  /// Work that the flow has done on shells [M L^2/T^2].
  [[nodiscard]] double flow_work() const { return audit_.flow_work(); }
  void report(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const;

  [[nodiscard]] const output::CsvWriter& table() const { return table_; }
  /// Everything that a run has to go on with.
  [[nodiscard]] std::vector<double> numbers() const;
  void restore(const std::vector<double>& numbers);

 private:
  void report_forces(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const;
  void report_energy(spdlog::logger& log, nlohmann::ordered_json& summary) const;
  void report_work(const Structure& structure, spdlog::logger& log, nlohmann::ordered_json& summary) const;

  ForceAudit audit_;
  EnergyAudit energy_;
  output::CsvWriter table_;
};

}  // namespace luff::simulation
