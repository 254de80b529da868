// SPDX-License-Identifier: BSD-3-Clause
// What a run counts from its start on, for its summary.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/profile.hpp"
#include "output/earlier_output.hpp"

namespace luff::simulation {

struct Tally {
  double largest_divergence = 0.0;
  double largest_cfl = 0.0;
  std::int64_t coupling_iterations = 0;
  std::int64_t most_coupling_iterations = 0;
  std::int64_t pressure_iterations = 0;
  std::int64_t halvings = 0;
  std::int64_t steps_beyond_limits = 0;
  std::int64_t most_pairs = 0;
  double smallest_gap = std::numeric_limits<double>::infinity();
  std::int64_t crossings = 0;
  double seconds = 0.0;  ///< since the start, without the time between a stop and a restart
  double seconds_stepping = 0.0;
  std::array<double, phase_names.size()> phases{};
  std::int64_t restarts = 0;
  std::vector<double> audit;  ///< ForceAudit::numbers()
};

struct Statistics;

/// What a recorder has to know to go on.
struct Record {
  Tally tally;
  output::EarlierOutput output;
  std::shared_ptr<Statistics> statistics = {};  ///< null where none were collected
};

/// When the last file of a series was written; nothing where there is none, or in a run that does not go on.
[[nodiscard]] inline std::optional<double> last_instant(const Record* earlier, const std::string& series)
{
  const output::SeriesMark* mark = earlier != nullptr ? earlier->output.of(series) : nullptr;
  return mark != nullptr && !mark->instants.empty() ? std::optional(mark->instants.back().time) : std::nullopt;
}

}  // namespace luff::simulation
