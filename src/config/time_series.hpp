// SPDX-License-Identifier: BSD-3-Clause
// A function of time, read from two columns of a CSV file.
#pragma once

#include <filesystem>
#include <vector>

namespace luff::config {

struct SeriesOptions {
  bool smooth = false;    ///< monotone cubics instead of straight lines
  bool periodic = false;  ///< repeated with the period from the first instant to the last
};

/// A value between given instants.  It changes linearly, or smoothly: by the monotone cubics ("PCHIP") of
/// [fritsch_1984_method], which have a continuous slope and overshoot none of the values.  Before the first instant and
/// after the last it keeps its value there, unless it is periodic.
class TimeSeries {
 public:
  /// Precondition: at least one instant, as many values, instants increasing; periodic: two instants at least, the last
  /// value is the first.
  TimeSeries(std::vector<double> times, std::vector<double> values, const SeriesOptions& options = {});

  double operator()(double t) const;

 private:
  [[nodiscard]] double slope_between(std::size_t before) const;
  [[nodiscard]] double slope_at(std::size_t i) const;

  std::vector<double> times_;
  std::vector<double> values_;
  std::vector<double> slopes_;  ///< at the instants; empty: straight lines
  bool periodic_;
};

/// Read "time, value" lines. Lines that start with '#' and one header line are skipped; the separator is a comma, a
/// semicolon or blanks. \throws InputError with file, line and what is wrong with it.
TimeSeries read_time_series(const std::filesystem::path& file, const SeriesOptions& options = {});

}  // namespace luff::config
