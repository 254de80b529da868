// SPDX-License-Identifier: BSD-3-Clause
#include "output/earlier_output.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace luff::output {

namespace {

constexpr const char *table_word = "table", *waiting_word = "waiting", *series_word = "series",
                     *instant_word = "instant";

std::string rest_of_line(std::istringstream& in)
{
  std::string rest;
  std::getline(in >> std::ws, rest);
  return rest;
}

}  // namespace

const TableMark* EarlierOutput::table(const std::string& file) const
{
  const auto at = std::find_if(tables.begin(), tables.end(), [&](const TableMark& mark) { return mark.file == file; });
  return at == tables.end() ? nullptr : &*at;
}

const SeriesMark* EarlierOutput::of(const std::string& series_name) const
{
  const auto at =
      std::find_if(series.begin(), series.end(), [&](const SeriesMark& mark) { return mark.name == series_name; });
  return at == series.end() ? nullptr : &*at;
}

std::string text_of_marks(const EarlierOutput& output)
{
  std::string text;
  for (const TableMark& table : output.tables) {
    text += fmt::format("{} {} {}\n", table_word, table.bytes, table.file);
    if (!table.waiting.empty())
      text += fmt::format("{} {}\n", waiting_word, fmt::join(table.waiting, " "));
  }
  for (const SeriesMark& series : output.series) {
    text += fmt::format("{} {}\n", series_word, series.name);
    for (const Instant& instant : series.instants)
      text += fmt::format("{} {} {}\n", instant_word, instant.time, instant.file);
  }
  return text;
}

EarlierOutput marks_of_text(const std::string& text)
{
  EarlierOutput output;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if (word == table_word) {
      TableMark table;
      in >> table.bytes;
      table.file = rest_of_line(in);
      output.tables.push_back(table);
    } else if (word == waiting_word && !output.tables.empty()) {
      output.tables.back().waiting.assign(std::istream_iterator<double>(in), {});
    } else if (word == series_word) {
      output.series.push_back({rest_of_line(in), {}});
    } else if (word == instant_word && !output.series.empty()) {
      Instant instant;
      in >> instant.time;
      instant.file = rest_of_line(in);
      output.series.back().instants.push_back(instant);
    }
  }
  return output;
}

}  // namespace luff::output
