// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values, flushed line by line.
#include "output/csv.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace luff::output {

namespace {

std::string head(const Column& column)
{
  return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

std::string digits(double value)
{
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

template <class Range, class Text>
std::string joined(const Range& range, Text text)
{
  std::vector<std::string> cells;
  for (const auto& x : range)
    cells.push_back(text(x));
  return fmt::format("{}", fmt::join(cells, ","));
}

}  // namespace

CsvWriter::CsvWriter(const RunFolder& folder, const std::string& file_name, std::vector<Column> columns)
    : path_(folder.file(file_name)), columns_(std::move(columns))
{
  if (!folder.writes())
    return;
  file_.open(path_);
  write_line(joined(columns_, head));
}

void CsvWriter::row(std::span<const double> values)
{
  ensure(values.size() == columns_.size(), "a row has one value per column");
  if (file_.is_open())
    write_line(joined(values, digits));
}

void CsvWriter::write_line(const std::string& line)
{
  file_ << line << '\n' << std::flush;
  if (!file_)
    fail_run("{}: cannot be written; is the disk full, or the folder gone?", path_.string());
}

std::vector<Column> vector_columns(const std::string& name, const std::string& unit)
{
  return {{name + "_x", unit}, {name + "_y", unit}, {name + "_z", unit}};
}

}  // namespace luff::output
