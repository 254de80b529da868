// SPDX-License-Identifier: BSD-3-Clause
// Where the time of a step goes.
#pragma once

#include <array>
#include <chrono>

namespace luff {

/// The parts of a coupled step that are timed.
enum class Phase { Search, Momentum, CutCells, Pressure, Loads, Shell, Output };
inline constexpr std::array<const char*, 7> phase_names{"search", "momentum", "cut_cells", "pressure",
                                                        "loads",  "shell",    "output"};

/// Wall-clock seconds spent in each phase since the last reset.
class Profile {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds(Phase phase) const { return seconds_[static_cast<int>(phase)]; }
  [[nodiscard]] const std::array<double, phase_names.size()>& all() const { return seconds_; }
  void add(Phase phase, double seconds) { seconds_[static_cast<int>(phase)] += seconds; }
  void reset() { seconds_.fill(0.0); }

  /// Counts the time until the end of its scope.
  class Timer {
   public:
    Timer(Profile& profile, Phase phase) : profile_(profile), phase_(phase), start_(Clock::now()) {}
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer()
    {
      profile_.seconds_[static_cast<int>(phase_)] += std::chrono::duration<double>(Clock::now() - start_).count();
    }

   private:
    Profile& profile_;
    Phase phase_;
    Clock::time_point start_;
  };
  [[nodiscard]] Timer time(Phase phase) { return {*this, phase}; }

 private:
  std::array<double, phase_names.size()> seconds_{};
};

}  // namespace luff
