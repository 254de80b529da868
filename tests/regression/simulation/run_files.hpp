// SPDX-License-Identifier: BSD-3-Clause
// Reads what a run left: tables, summary, time series.
#pragma once

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace luff::test {

/// A CSV file: its head, and a row of numbers per line (NaN where a place is empty).
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<double>> rows;

  [[nodiscard]] std::vector<double> column(const std::string& name) const
  {
    std::size_t n = 0;
    while (n < head.size() && head[n] != name)
      ++n;
    EXPECT_LT(n, head.size()) << "no column '" << name << "'";
    std::vector<double> values;
    for (const auto& row : rows)
      if (n < row.size())
        values.push_back(row[n]);
    return values;
  }
};

inline std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');)
    cells.push_back(cell);
  return cells;
}

/// Expects as many numbers in every line as in the head, and an end of line after the last.
inline Table read_table(const std::filesystem::path& file)
{
  const std::string text = contents_of(file);
  EXPECT_TRUE(text.ends_with('\n')) << file << " ends within a line";
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  Table table{split(line), {}};
  while (std::getline(in, line)) {
    std::vector<double> row;
    for (const std::string& cell : split(line))
      row.push_back(cell.empty() ? std::nan("") : std::stod(cell));
    EXPECT_EQ(row.size(), table.head.size()) << file << ": " << line;
    table.rows.push_back(row);
  }
  return table;
}

inline nlohmann::json read_summary(const std::filesystem::path& run)
{
  return nlohmann::json::parse(contents_of(run / "summary.json"));
}

/// Times of a .pvd file; every file that it names must be there and whole.
inline std::vector<double> read_series(const std::filesystem::path& pvd)
{
  const std::string text = contents_of(pvd);
  EXPECT_NE(text.find("</VTKFile>"), std::string::npos) << pvd << " is cut short";
  std::vector<double> times;
  const std::string time_key = "timestep=\"";
  const std::string file_key = "file=\"";
  for (auto at = text.find(time_key); at != std::string::npos; at = text.find(time_key, at + 1)) {
    times.push_back(std::stod(text.substr(at + time_key.size())));
    const auto name = text.find(file_key, at) + file_key.size();
    const auto file = pvd.parent_path() / text.substr(name, text.find('"', name) - name);
    EXPECT_NE(contents_of(file).find("</VTKFile>"), std::string::npos) << file << " is cut short";
  }
  return times;
}

/// Waits until the run has made steps; false if it ended before.
inline bool wait_for_rows(const std::filesystem::path& table)
{
  for (int n = 0; n < 2000; ++n) {
    std::ifstream in(table);
    std::string line;
    int lines = 0;
    while (std::getline(in, line))
      ++lines;
    if (lines > 3)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace luff::test
