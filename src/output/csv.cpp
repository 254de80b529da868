// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values, flushed line by line.
#include "output/csv.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "output/integrity.hpp"

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

CsvWriter::CsvWriter(const RunFolder& folder, const std::string& file_name, std::vector<Column> columns,
                     const EarlierOutput* earlier)
    : path_(folder.file(file_name)), columns_(std::move(columns))
{
  const TableMark* mark = earlier != nullptr ? earlier->table(file_name) : nullptr;
  if (mark != nullptr)
    waiting_ = mark->waiting;
  if (!folder.writes())
    return;
  whole_ = mark == nullptr || take_over(*earlier, *mark);
  if (mark != nullptr && whole_) {
    file_.open(path_, std::ios::app);
    return;
  }
  file_.open(path_);
  write_line(joined(columns_, head));
}

/// Makes the first rows of an earlier table those of this one.
bool CsvWriter::take_over(const EarlierOutput& earlier, const TableMark& mark) const
{
  const std::filesystem::path from = earlier.folder / mark.file;
  std::error_code error;
  if (const auto bytes = std::filesystem::file_size(from, error);
      error || bytes < static_cast<std::uintmax_t>(mark.bytes))
    return false;
  std::string first;
  std::getline(std::ifstream(from), first);
  if (first != joined(columns_, head))
    return false;
  const bool in_place = std::filesystem::equivalent(from, path_, error);
  error.clear();
  if (!in_place)
    std::filesystem::copy_file(from, path_, std::filesystem::copy_options::overwrite_existing, error);
  if (!error)
    std::filesystem::resize_file(path_, mark.bytes, error);
  return !error;
}

TableMark CsvWriter::mark() const
{
  std::error_code ignored;
  return {path_.filename().string(),
          file_.is_open() ? static_cast<std::int64_t>(std::filesystem::file_size(path_, ignored)) : 0, waiting_};
}

bool CsvWriter::flush() const
{
  return !file_.is_open() || flush_to_disk(path_);
}

std::vector<std::vector<double>> CsvWriter::rows() const
{
  std::vector<std::vector<double>> rows;
  if (!file_.is_open())
    return rows;
  std::ifstream in(path_);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<double>& row = rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');)
      row.push_back(cell.empty() ? std::nan("") : std::strtod(cell.c_str(), nullptr));
    row.resize(columns_.size(), std::nan(""));
  }
  return rows;
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

void add_vector(std::vector<Column>& columns, const std::string& name, const std::string& unit)
{
  for (const char* end : {"_x", "_y", "_z"})
    columns.push_back({name + end, unit});
}

void add_vector(std::vector<double>& row, const Vec3& v)
{
  row.insert(row.end(), v.data(), v.data() + 3);
}

}  // namespace luff::output
