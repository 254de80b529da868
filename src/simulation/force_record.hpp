// SPDX-License-Identifier: BSD-3-Clause
// Force of the flow on each shell and body.
#pragma once

#include "simulation/late_loads.hpp"
#include "simulation/observer.hpp"

namespace luff::simulation {

/// forces-<name>.csv of every sheet: a row for each step, written when the next one is done.
class ForceRecord : public Observer {
 public:
  ForceRecord(const output::RunFolder& folder, Simulation& simulation, const output::EarlierOutput* earlier);

  void record(const TimeStep& step) override;
  void write_waiting() override;
  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const override;

 private:
  [[nodiscard]] std::vector<double> sums(const SheetRange& sheet, const TimeStep& step,
                                         const immersed::SheetLoads& loads) const;

  Simulation& simulation_;
  std::vector<output::CsvWriter> tables_;  ///< by sheet
};

}  // namespace luff::simulation
