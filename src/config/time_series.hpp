// SPDX-License-Identifier: BSD-3-Clause
// A piecewise linear function of time, read from two columns of a CSV file.
#pragma once

#include <filesystem>
#include <vector>

namespace luff::config {

/// A value that changes linearly between given instants and keeps its first (last) value before (after) them.
class TimeSeries {
 public:
  /// Precondition: at least one instant, as many values, instants increasing.
  TimeSeries(std::vector<double> times, std::vector<double> values);

  double operator()(double t) const;

 private:
  std::vector<double> times_;
  std::vector<double> values_;
};

/// Read "time, value" lines. Lines that start with '#' and one header line are skipped; the separator is a comma, a
/// semicolon or blanks. \throws InputError with file, line and what is wrong with it.
TimeSeries read_time_series(const std::filesystem::path& file);

}  // namespace luff::config
