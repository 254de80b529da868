// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves: tables, series for ParaView, the log, the summary.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <spdlog/logger.h>

#include "config/case.hpp"
#include "output/csv.hpp"
#include "output/oscillation.hpp"
#include "output/progress.hpp"
#include "output/run_folder.hpp"
#include "output/series.hpp"
#include "simulation/cadence.hpp"
#include "simulation/simulation.hpp"

namespace luff::simulation {

/// How a run ended.
enum class Ending { Finished, Stopped, Failed };

/// Observes a run and writes its folder.  Collective.
class Recorder {
 public:
  Recorder(const output::RunFolder& folder, std::shared_ptr<spdlog::logger> log, const config::Case& options,
           Simulation& simulation, std::function<bool()> interrupted);

  /// Records an accepted step; false when the user asks the run to end.
  bool record(const StepRecord& record);
  /// Writes the last instant and the summary.  `reason` is the message of a failure.
  void finish(Ending ending, const std::string& reason);

 private:
  struct Probe {
    std::string name;
    int vertex = -1;  ///< of all sheets; -1: a point in the flow
    Vec3 point = Vec3::Zero();
    std::vector<double> t;
    std::array<std::vector<double>, 3> value;  ///< displacement or velocity
    std::unique_ptr<output::CsvWriter> csv;
  };
  void open_tables();
  void open_probe(const config::ProbeOptions& options);
  void write_steps(const StepRecord& record);
  void append_contact(std::vector<double>& row);
  void count_crossings();
  void report_contact(nlohmann::ordered_json& summary) const;
  void write_forces(double t);
  void write_probes(double t, double dt);
  void write_snapshots(double t, double dt, bool last);
  void write_shells(double t, double dt);
  [[nodiscard]] output::SurfaceSnapshot sheet_snapshot(const SheetRange& sheet, double t, double dt,
                                                       const std::vector<immersed::SideTraction>& tractions) const;
  void show_progress(const StepRecord& record);
  void warn_about_limits(const StepRecord& record);
  void report_oscillations(nlohmann::ordered_json& summary);
  void name_files() const;

  output::RunFolder folder_;
  std::shared_ptr<spdlog::logger> log_;
  config::Case options_;
  Simulation& simulation_;
  std::function<bool()> interrupted_;
  output::Progress progress_;
  Cadence fields_due_;
  Cadence shells_due_;
  std::optional<output::FlowSeries> fields_;
  std::vector<output::SurfaceSeries> surfaces_;
  std::vector<output::CsvWriter> forces_;
  std::optional<output::CsvWriter> steps_;
  std::vector<Probe> probes_;

  Profile profile_;  ///< of the whole run
  double started_ = 0.0;
  double last_step_ended_ = 0.0;
  double largest_divergence_ = 0.0;
  double largest_cfl_ = 0.0;
  long coupling_iterations_ = 0;
  int most_coupling_iterations_ = 0;
  long pressure_iterations_ = 0;
  long halvings_ = 0;
  long steps_beyond_limits_ = 0;
  long newton_iterations_ = 0;  ///< up to the last step written
  int most_pairs_ = 0;
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  long crossings_ = 0;
  double seconds_stepping_ = 0.0;
};

}  // namespace luff::simulation
