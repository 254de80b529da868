// SPDX-License-Identifier: BSD-3-Clause
// Means over time that a run collects from a given time on.
#pragma once

#include <memory>
#include <optional>

#include "config/options.hpp"
#include "output/run_folder.hpp"
#include "simulation/cadence.hpp"
#include "simulation/flow_moments.hpp"
#include "simulation/observer.hpp"
#include "simulation/shear_history.hpp"
#include "simulation/simulation.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// What has been collected, as checkpoints hold it.
struct Statistics {
  explicit Statistics(const IndexBox& owned) : flow(owned) {}

  double start = 0.0;  ///< from when on [T]
  FlowMoments flow;
  ShearHistory sheets;  ///< of shear_in_surface()
  ShearHistory walls;   ///< of this rank's faces, in the order of wall_shear()
};

/// Collects them step by step, writes those of the flow: statistics.pvd.
class StatisticsRecord : public Observer {
 public:
  /// Goes on with what the earlier run collected, if that began at the same time.
  StatisticsRecord(const output::RunFolder& folder, const config::Case& options, Simulation& simulation,
                   const Record* earlier);

  void record(const TimeStep& step) override;
  void finish(double t) override;
  void report(nlohmann::ordered_json& summary) const override;
  [[nodiscard]] std::vector<const output::SeriesMark*> series() const override { return {&series_.mark()}; }
  [[nodiscard]] const std::shared_ptr<Statistics>& collected() const { return collected_; }

 private:
  void write(double t);

  Simulation& simulation_;
  config::StatisticsOptions options_;
  bool of_sheets_;
  bool of_walls_;
  std::shared_ptr<Statistics> collected_;
  Cadence due_;
  output::FlowSeries series_;
};

}  // namespace luff::simulation
