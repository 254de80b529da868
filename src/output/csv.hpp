// SPDX-License-Identifier: BSD-3-Clause
// Tables that grow by a line at a time: probes, forces, steps.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "output/earlier_output.hpp"
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
  /// Writes the head, or continues the table of an earlier run from where its mark stands: rows after that are dropped.
  /// Throws RunError if the file cannot be written.
  CsvWriter(const RunFolder& folder, const std::string& file_name, std::vector<Column> columns,
            const EarlierOutput* earlier = nullptr);

  /// One value per column; NaN leaves the place empty. Throws RunError if the disk refuses.
  void row(std::span<const double> values);

  /// Numbers that a row which is not written yet is made of; a run that goes on finds them again, on all ranks.
  void wait_with(std::vector<double> numbers) { waiting_ = std::move(numbers); }
  [[nodiscard]] const std::vector<double>& waiting() const { return waiting_; }

  /// How far the table has come; meaningful on the rank that writes.
  [[nodiscard]] TableMark mark() const;
  /// Makes the rows so far last on disk, beyond a failure of power; false if it refuses.
  [[nodiscard]] bool flush() const;
  /// False if an earlier run's table had a mark that could not be continued from: it was lost, cut, or had other
  /// columns.
  [[nodiscard]] bool whole() const { return whole_; }
  /// The rows so far, on the rank that writes; an empty place is NaN.
  [[nodiscard]] std::vector<std::vector<double>> rows() const;

 private:
  [[nodiscard]] bool take_over(const EarlierOutput& earlier, const TableMark& mark) const;
  void write_line(const std::string& line);

  std::filesystem::path path_;
  std::vector<Column> columns_;
  std::ofstream file_;  // open on the rank that writes
  std::vector<double> waiting_;
  bool whole_ = true;
};

/// Appends three columns name_x, name_y, name_z of one unit.
void add_vector(std::vector<Column>& columns, const std::string& name, const std::string& unit);
/// Appends their values to a row.
void add_vector(std::vector<double>& row, const Vec3& v);

}  // namespace luff::output
