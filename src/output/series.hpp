// SPDX-License-Identifier: BSD-3-Clause
// Series of snapshots over time in VTK's files, which ParaView opens together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/earlier_output.hpp"
#include "output/run_folder.hpp"
#include "output/snapshot.hpp"

namespace luff::output {

/// <name>.pvd, the list of instants; rewritten whole after each, so that an interrupted run stays readable.
class TimeIndex {
 public:
  /// Of a new series, or of one that an earlier run began; then the first rank writes the list as it stood at its mark.
  TimeIndex(const RunFolder& folder, std::string name, const EarlierOutput* earlier);

  /// `file` is relative to the list's folder. Throws RunError if the list cannot be written.
  void add(double time, const std::string& file);

  /// Instants so far; the same on every rank.
  [[nodiscard]] const SeriesMark& mark() const { return series_; }
  [[nodiscard]] int count() const { return static_cast<int>(series_.instants.size()); }

 private:
  void write() const;

  std::filesystem::path pvd_file_;
  bool writes_;
  SeriesMark series_;
};

/// <name>.pvd with <name>/<name>_000012.vtr: rectilinear grids with data by cell; .vts: curvilinear ones.
/// On several ranks each writes its own piece, listed by <name>_000012.pvtr or .pvts.
class FlowSeries {
 public:
  explicit FlowSeries(const RunFolder& folder, std::string name = "fields", const EarlierOutput* earlier = nullptr);

  /// Collective. Throws RunError on every rank if any piece cannot be written.
  void write(double time, const FlowSnapshot& snapshot);
  [[nodiscard]] const SeriesMark& mark() const { return index_.mark(); }

 private:
  std::string write_pieces(const std::string& stem, double time, const FlowSnapshot& snapshot);

  RunFolder folder_;
  std::string name_;
  TimeIndex index_;
};

/// <name>.pvd with <name>/<name>_000012.vtp: a surface with data by point and by face, written by the first rank.
class SurfaceSeries {
 public:
  SurfaceSeries(const RunFolder& folder, std::string name, const EarlierOutput* earlier = nullptr);

  /// Throws RunError if the file cannot be written.
  void write(double time, const SurfaceSnapshot& snapshot);
  [[nodiscard]] const SeriesMark& mark() const { return index_.mark(); }

 private:
  void write_file(const std::string& file, double time, const SurfaceSnapshot& snapshot) const;

  RunFolder folder_;
  std::string name_;
  TimeIndex index_;
};

}  // namespace luff::output
