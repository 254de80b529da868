// SPDX-License-Identifier: BSD-3-Clause
// What looks at a run's accepted steps and leaves something of them.
#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/time_step.hpp"
#include "output/csv.hpp"
#include "output/series.hpp"

namespace luff::simulation {

/// All functions are collective.
class Observer {
 public:
  virtual ~Observer() = default;

  /// The start of a run that does not go on from an earlier one; halos of the flow are filled.
  virtual void start() {}
  /// An accepted step; halos of the flow are filled.
  virtual void record(const TimeStep& step) = 0;
  /// The run ends, well or not, after its checkpoint: rows that wait for one more step.  Each rank by itself.
  virtual void write_waiting() {}
  /// The last instant t of a run that ends well, after its checkpoint: what is written here is no part of a series that
  /// goes on.
  virtual void finish(double /*t*/) {}
  virtual void report(nlohmann::ordered_json& /*summary*/) const {}

  [[nodiscard]] virtual std::vector<const output::CsvWriter*> tables() const { return {}; }
  [[nodiscard]] virtual std::vector<const output::SeriesMark*> series() const { return {}; }
};

}  // namespace luff::simulation
