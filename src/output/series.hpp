// SPDX-License-Identifier: BSD-3-Clause
// Series of snapshots over time in VTK's files, which ParaView opens together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/run_folder.hpp"
#include "output/snapshot.hpp"

namespace luff::output {

/// <name>.pvd, the list of instants; rewritten whole after each, so that an interrupted run stays readable.
class TimeIndex {
 public:
  explicit TimeIndex(std::filesystem::path pvd_file) : pvd_file_(std::move(pvd_file)) {}

  /// `file` is relative to the list's folder. Throws RunError if the list cannot be written.
  void add(double time, const std::string& file);

 private:
  struct Instant {
    double time;
    std::string file;
  };
  std::filesystem::path pvd_file_;
  std::vector<Instant> instants_;
};

/// <name>.pvd with <name>/<name>_000012.vtr: rectilinear grids with data by cell.
/// On several ranks each writes its own piece, listed by <name>_000012.pvtr.
class FlowSeries {
 public:
  explicit FlowSeries(const RunFolder& folder, std::string name = "fields");

  /// Collective. Throws RunError on every rank if any piece cannot be written.
  void write(double time, const FlowSnapshot& snapshot);

 private:
  std::string write_pieces(const std::string& stem, double time, const FlowSnapshot& snapshot);

  RunFolder folder_;
  std::string name_;
  TimeIndex index_;
  int count_ = 0;
};

/// <name>.pvd with <name>/<name>_000012.vtp: a surface with data by point and by triangle, written by the first rank.
class SurfaceSeries {
 public:
  SurfaceSeries(const RunFolder& folder, std::string name);

  /// Throws RunError if the file cannot be written.
  void write(double time, const SurfaceSnapshot& snapshot);

 private:
  RunFolder folder_;
  std::string name_;
  TimeIndex index_;
  int count_ = 0;
};

}  // namespace luff::output
