// SPDX-License-Identifier: BSD-3-Clause
// How far a run has come: one line that renews itself on a terminal, plain lines elsewhere.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace luff::output {

/// What the line says about the step just accepted; what is not there is left out.
struct StepProgress {
  long step = 0;
  double t = 0;  ///< [T]
  std::optional<double> cfl = {};
  std::optional<int> pressure_iterations = {};
  std::optional<int> coupling_iterations = {};
  std::string probe_name = {};
  std::optional<double> probe = {};
};

enum class ProgressStyle { Live, Plain };

struct ProgressOptions {
  double t_start = 0;  ///< [T]
  double t_end = 0;    ///< [T]
  double cells = 0;    ///< of the flow; 0 for a structure alone
  ProgressStyle style = ProgressStyle::Plain;
  double every = 10;  ///< seconds between lines
  int width = 0;      ///< columns a live line may take; 0: any number
};

/// The style and width of standard output, a line every fifth of a second on a terminal and every ten seconds
/// elsewhere.
ProgressOptions progress_on_standard_output(double t_start, double t_end, double cells);

/// A word of the line; where the line is too narrow the least important are left out.
struct ProgressPart {
  int importance;
  std::string text;
};

/// Measures seconds per step itself, as a mean that forgets slowly.
class Progress {
 public:
  using Clock = std::function<double()>;  ///< seconds since whenever

  Progress(std::ostream& out, const ProgressOptions& options);
  Progress(std::ostream& out, const ProgressOptions& options, Clock clock);

  /// Call after every accepted step; writes when it is time to, and always for the first.
  void step(const StepProgress& progress);
  /// Writes the last step and ends the live line, so that other output can follow.
  void finish();

  /// The line as it is written, without the end of line.
  std::string line(const StepProgress& progress) const;

 private:
  void measure(double t, double now);
  void add_speed(const StepProgress& progress, std::vector<ProgressPart>& parts) const;
  void show(const StepProgress& progress);

  std::ostream& out_;
  ProgressOptions options_;
  Clock clock_;
  double last_clock_;
  double last_t_;
  std::optional<double> seconds_per_step_;
  double time_per_step_ = 0;
  std::optional<double> last_shown_;
  std::optional<StepProgress> pending_;
};

}  // namespace luff::output
