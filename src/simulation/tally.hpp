// SPDX-License-Identifier: BSD-3-Clause
// What a run counts from its start on, for its summary.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
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

/// What a recorder has to know to go on.
struct Record {
  Tally tally;
  output::EarlierOutput output;
};

}  // namespace luff::simulation
