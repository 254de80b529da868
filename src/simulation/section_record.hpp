// SPDX-License-Identifier: BSD-3-Clause
// Force of the flow on strips of a surface.
#pragma once

#include "config/options.hpp"
#include "output/run_folder.hpp"
#include "simulation/cadence.hpp"
#include "simulation/late_loads.hpp"
#include "simulation/observer.hpp"
#include "simulation/simulation.hpp"
#include "simulation/tally.hpp"

namespace luff::simulation {

/// Strips of equal width of an undeformed surface, between planes normal to an axis.
class Strips {
 public:
  Strips(const surface::TriangleMesh& reference, const Vec3& axis, int count);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double width() const { return width_; }
  /// Distance along the axis from the origin to where strip n begins.
  [[nodiscard]] double begin(int n) const { return first_ + n * width_; }
  /// The vertices' forces by strip: each is spread like the area of the triangles around its vertex, so that the sum
  /// over strips is that over vertices.
  [[nodiscard]] std::vector<Vec3> forces(std::span<const Vec3> by_vertex) const;

 private:
  struct Share {
    int vertex = 0;
    int strip = 0;
    double part = 0.0;  ///< of the vertex's force
  };

  int count_;
  double first_ = 0.0;
  double width_ = 0.0;
  std::vector<Share> shares_;
};

/// section-<name>.csv: a row for each strip and instant, written a step later.
class SectionRecord : public Observer {
 public:
  SectionRecord(const output::RunFolder& folder, const config::SectionOptions& options, Simulation& simulation,
                const Record* earlier);

  void record(const TimeStep& step) override;
  void write_waiting() override;
  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const override { return {&table_}; }

 private:
  [[nodiscard]] std::vector<double> sums(const immersed::SheetLoads& loads) const;
  void write_rows(double t, const std::vector<double>& forces);

  Simulation& simulation_;
  const SheetRange& sheet_;
  Strips strips_;
  Cadence due_;
  output::CsvWriter table_;
};

}  // namespace luff::simulation
