// SPDX-License-Identifier: BSD-3-Clause
// Slices and isosurfaces of a run's flow, at cadences of their own.
#pragma once

#include <functional>

#include "config/options.hpp"
#include "output/cut_surface.hpp"
#include "output/run_folder.hpp"
#include "simulation/cadence.hpp"
#include "simulation/observer.hpp"
#include "simulation/simulation.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// A series of surfaces through the flow.
class CutRecord : public Observer {
 public:
  /// slice-<name>.pvd
  CutRecord(const output::RunFolder& folder, const config::SliceOptions& options, Simulation& simulation,
            const Record* earlier);
  /// iso-<name>.pvd
  CutRecord(const output::RunFolder& folder, const config::IsosurfaceOptions& options, Simulation& simulation,
            const Record* earlier);

  void start() override;
  void record(const TimeStep& step) override;
  void finish(double t) override;
  [[nodiscard]] std::vector<const output::SeriesMark*> series() const override { return {&series_.mark()}; }

 private:
  /// This rank's piece.
  using Cut = std::function<output::SurfaceSnapshot(const fluid::FlowSolver& flow, bool bodies)>;
  CutRecord(const output::RunFolder& folder, const std::string& name, double every, Cut cut, Simulation& simulation,
            const Record* earlier);
  void write(double t);

  MPI_Comm comm_;
  Simulation& simulation_;
  Cut cut_;
  Cadence due_;
  output::SurfaceSeries series_;
};

}  // namespace luff::simulation
