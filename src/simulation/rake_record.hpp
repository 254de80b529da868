// SPDX-License-Identifier: BSD-3-Clause
// Velocity and pressure at points in a row.
#pragma once

#include "config/options.hpp"
#include "grid/locate.hpp"
#include "output/run_folder.hpp"
#include "simulation/cadence.hpp"
#include "simulation/observer.hpp"
#include "simulation/simulation.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// rake-<name>.csv: a row for each point and instant.
class RakeRecord : public Observer {
 public:
  /// Its points lie in the grid.  Collective.
  RakeRecord(const output::RunFolder& folder, const config::RakeOptions& options, Simulation& simulation,
             const Record* earlier);

  void start() override;
  void record(const TimeStep& step) override;
  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const override { return {&table_}; }

 private:
  void write(double t);

  Simulation& simulation_;
  std::vector<Vec3> points_;
  std::vector<grid::Location> locations_;
  Cadence due_;
  output::CsvWriter table_;
};

/// Evenly spaced, both ends among them.
[[nodiscard]] std::vector<Vec3> points_of(const config::RakeOptions& rake);

}  // namespace luff::simulation
