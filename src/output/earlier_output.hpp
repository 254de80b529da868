// SPDX-License-Identifier: BSD-3-Clause
// How far tables and series had come when a checkpoint was written: a run that goes on from there continues them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace luff::output {

/// A table and how long it was.
struct TableMark {
  std::string file;
  std::int64_t bytes = 0;
  std::vector<double> waiting = {};  ///< CsvWriter::waiting()
};

/// One file of a series.
struct Instant {
  double time = 0;   ///< [T]
  std::string file;  ///< relative to the folder of the series' .pvd
};

struct SeriesMark {
  std::string name;
  std::vector<Instant> instants;
};

/// What a run had written, and where it lies.
struct EarlierOutput {
  std::filesystem::path folder;
  std::vector<TableMark> tables;
  std::vector<SeriesMark> series;

  /// Null where there was no such table or series.
  [[nodiscard]] const TableMark* table(const std::string& file) const;
  [[nodiscard]] const SeriesMark* of(const std::string& series_name) const;
};

/// Marks as lines of text, every number with all its digits, and back.
[[nodiscard]] std::string text_of_marks(const EarlierOutput& output);
[[nodiscard]] EarlierOutput marks_of_text(const std::string& text);

}  // namespace luff::output
