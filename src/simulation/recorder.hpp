// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves: tables, series for ParaView, the log, the summary.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <spdlog/logger.h>

#include "config/case.hpp"
#include "grid/locate.hpp"
#include "output/csv.hpp"
#include "output/oscillation.hpp"
#include "output/progress.hpp"
#include "output/run_folder.hpp"
#include "output/series.hpp"
#include "simulation/audit_record.hpp"
#include "simulation/cadence.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/observer.hpp"
#include "simulation/simulation.hpp"
#include "simulation/statistics.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// How a run ended.
enum class Ending { Finished, Stopped, Failed };

/// Observes a run and writes its folder.  Collective.
class Recorder {
 public:
  /// Of a run that starts, or of one that goes on after `earlier`.
  Recorder(const output::RunFolder& folder, std::shared_ptr<spdlog::logger> log, const config::Case& options,
           Simulation& simulation, std::function<bool()> interrupted, const Record* earlier = nullptr);

  /// Records an accepted step; false when the user asks the run to end.
  bool record(const StepRecord& record);
  /// Writes a checkpoint where the run may go on from here, the last instant and the summary.  `reason` is the message
  /// of a failure.  Throws RunError, after all of it, if a stopped run's checkpoint could not be written.
  void finish(Ending ending, const std::string& reason);

 private:
  struct Probe {
    std::string name;
    int vertex = -1;  ///< of all sheets; -1: a point in the flow
    Vec3 point = Vec3::Zero();
    std::optional<grid::Location> location;  ///< of a point in the flow
    std::vector<double> t;
    std::array<std::vector<double>, 3> value;  ///< displacement or velocity
    std::unique_ptr<output::CsvWriter> csv;
  };
  void open_tables(const output::EarlierOutput* earlier);
  void open_observers(const Record* earlier);
  void open_probe(const config::ProbeOptions& options, const output::EarlierOutput* earlier);
  void write_start();
  void write_end(double t);
  void resume(const Record& earlier);
  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const;
  [[nodiscard]] std::vector<const output::SeriesMark*> series() const;
  [[nodiscard]] Record record_so_far() const;
  [[nodiscard]] std::string try_checkpoint();
  [[nodiscard]] std::string checkpoint_at_end(Ending ending);
  void write_steps(const StepRecord& record);
  void append_contact(std::vector<double>& row);
  void count_crossings();
  void report_contact(nlohmann::ordered_json& summary) const;
  void write_motions(double t, double dt);
  void write_probes(double t, double dt);
  void write_snapshots(double t, double dt, bool last);
  void write_shells(double t, double dt);
  [[nodiscard]] output::SurfaceSnapshot sheet_snapshot(const SheetRange& sheet, double t, double dt,
                                                       const std::vector<immersed::SideTraction>& tractions) const;
  void add_shear_history(const SheetRange& sheet, int side, output::SurfaceSnapshot& snapshot) const;
  [[nodiscard]] double audit(const TimeStep& step);
  void report_steps(nlohmann::ordered_json& summary) const;
  void say_ending(const char* state) const;
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
  Cadence walls_due_;
  Cadence checkpoint_due_;
  std::optional<output::FlowSeries> fields_;
  std::optional<output::SurfaceSeries> walls_;
  std::vector<output::SurfaceSeries> surfaces_;
  std::vector<std::pair<int, output::CsvWriter>> motions_;  ///< of rigid sheets that move, by number
  std::optional<output::CsvWriter> steps_;
  std::vector<Probe> probes_;
  std::optional<AuditRecord> audit_;
  std::vector<std::unique_ptr<Observer>> observers_;
  const StatisticsRecord* statistics_ = nullptr;  ///< one of them

  Tally tally_;
  double started_ = 0.0;
  double last_step_ended_ = 0.0;
  long newton_iterations_ = 0;   ///< up to the last step written
  int recorded_steps_ = 0;       ///< whose lines are in all tables
  int checkpointed_steps_ = -1;  ///< of the last checkpoint; -1: none yet
  long failed_checkpoints_ = 0;
};

}  // namespace luff::simulation
