// SPDX-License-Identifier: BSD-3-Clause
// Tables that grow by a line at a time: probes, forces, steps.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "output/run_folder.hpp"

namespace luff::output {

/// A column's head reads `name [unit]`; without a unit, `name`.
struct Column {
  std::string name;
  std::string unit;  ///< in words: time, length, velocity, force, ...; empty for a pure number
};

/// Comma-separated values. Each row is on disk when row() returns; numbers have all their digits.
class CsvWriter {
 public:
  /// Writes the head. Throws RunError if the file cannot be written.
  CsvWriter(const RunFolder& folder, const std::string& file_name, std::vector<Column> columns);

  /// One value per column; NaN leaves the place empty. Throws RunError if the disk refuses.
  void row(std::span<const double> values);

 private:
  void write_line(const std::string& line);

  std::filesystem::path path_;
  std::vector<Column> columns_;
  std::ofstream file_;  // open on the rank that writes
};

/// Three columns name_x, name_y, name_z of one unit.
std::vector<Column> vector_columns(const std::string& name, const std::string& unit);

}  // namespace luff::output
