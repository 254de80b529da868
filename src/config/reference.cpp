// SPDX-License-Identifier: BSD-3-Clause
// The manual's page of all keys, as text and as Markdown.
#include "config/reference.hpp"

#include <algorithm>
#include <regex>

#include <fmt/core.h>

#include "core/nearest.hpp"
#include "config/value_text.hpp"

namespace luff::config {
namespace {

const std::string introduction =
    "This page is written by `luff options` from the descriptions that also check a case file. Units are examples: any "
    "consistent set will do, or none if the case is non-dimensional. A formula is text in quotes such as \"1 - "
    "cos(2*pi*t)\", in the language of muParser with `pi`; `{ file = \"wave.csv\", scale = 1 }` is a function of time: "
    "two columns, time and value, joined by straight lines and constant before the first and after the last; with "
    "`smooth = true` joined by monotone cubics, with `periodic = true` repeated.";

std::string in_backticks(const std::vector<std::string>& names)
{
  std::string text;
  for (const auto& name : names)
    text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name);
  return text;
}

/// Break a paragraph at blanks so that lines with this indent stay below 100 columns.
std::string wrapped(const std::string& paragraph, const std::string& indent)
{
  constexpr std::size_t width = 100;
  std::string text;
  std::string line = indent;
  for (std::size_t begin = 0; begin < paragraph.size();) {
    const auto end = std::min(paragraph.find(' ', begin), paragraph.size());
    const auto word = paragraph.substr(begin, end - begin);
    if (line.size() + 1 + word.size() > width) {
      text += line + '\n';
      line = indent;
    }
    line += (line.size() == indent.size() ? "" : " ") + word;
    begin = end + 1;
  }
  return text + line + '\n';
}

std::string escaped_for_table(const std::string& text)
{
  return std::regex_replace(text, std::regex(R"(\|)"), "\\|");
}

}  // namespace

std::string Reference::path_of(std::string_view name) const
{
  const auto& path = sections_[open_.back()].path;
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

void Reference::open(const std::string& path, const std::string& title, const std::string& doc)
{
  open_.push_back(sections_.size());
  sections_.push_back({path, title, doc});
}

void Reference::close_table()
{
  open_.pop_back();
}

void Reference::visit_key(std::string_view name, const Value& value, const Spec& spec)
{
  Row row{std::string(name), allowed(value, spec), to_toml(value), std::string(spec.unit), std::string(spec.doc)};
  if (spec.required)
    row.preset = "required";
  else if (is_optional())
    row.preset = "";
  row.doc += condition();
  if (const auto* choice = std::get_if<Choice>(&value); choice && !choice->later.empty())
    row.doc += fmt::format(" Not in this version: {}.", in_backticks(choice->later));
  sections_[open_.back()].rows.push_back(row);
}

bool Reference::enter_optional(std::string_view /*name*/, bool /*has_value*/)
{
  return true;
}

bool Reference::open_table(std::string_view name, const TableSpec& spec)
{
  const auto path = path_of(name);
  open(path, fmt::format("[{}]", path), std::string(spec.doc) + condition());
  return true;
}

bool Reference::open_sibling(const std::vector<std::string>& names, std::size_t i, const TableSpec& spec)
{
  if (i > 0)
    return false;
  std::vector<std::string> titles;
  for (const auto& name : names)
    titles.push_back(fmt::format("[{}]", path_of(name)));
  open(path_of(names.front()), joined(titles), std::string(spec.doc));
  return true;
}

std::size_t Reference::open_list(std::string_view /*name*/, std::size_t /*size*/, const TableSpec& /*spec*/)
{
  return 1;
}

bool Reference::open_item(std::string_view name, std::size_t /*i*/, const TableSpec& spec)
{
  const auto path = path_of(name);
  open(path, fmt::format("[[{}]]", path), std::string(spec.doc));
  return true;
}

bool Reference::open_condition(bool /*holds*/, std::string_view condition)
{
  conditions_.push_back({open_.size(), std::string(condition)});
  return true;
}

void Reference::close_condition()
{
  conditions_.pop_back();
}

/// " Only with ...", if a condition was stated in the table that is open now.
std::string Reference::condition() const
{
  if (conditions_.empty() || conditions_.back().depth != open_.size())
    return "";
  return fmt::format(" Only with {}.", conditions_.back().text);
}

void Reference::exactly_one_of(std::initializer_list<std::string_view> keys)
{
  const std::vector<std::string> names(keys.begin(), keys.end());
  sections_[open_.back()].notes.push_back(fmt::format("Exactly one of {} must be given.", in_backticks(names)));
}

void Reference::rule(bool /*holds*/, std::string_view key, std::string_view text, const std::string& /*detail*/)
{
  sections_[open_.back()].notes.push_back(fmt::format("`{}` {}.", key, text));
}

void Reference::later(std::initializer_list<std::string_view> keys)
{
  const std::vector<std::string> names(keys.begin(), keys.end());
  sections_[open_.back()].notes.push_back(fmt::format("Not in this version: {}.", in_backticks(names)));
}

/// Do not repeat the keys of a table (a mesh, a place) that stands in several others.
void Reference::fold_alike()
{
  for (auto section = sections_.begin(); section != sections_.end(); ++section) {
    const auto earlier = std::find_if(sections_.begin(), section, [&](const Section& other) {
      return !other.rows.empty() && other.rows == section->rows && other.notes == section->notes;
    });
    if (earlier == section)
      continue;
    section->alike = earlier->title;
    section->rows.clear();
    section->notes.clear();
  }
}

std::string Reference::text() const
{
  std::string all = format_ == Format::Markdown ? "# Options of a case file\n\n" + introduction + "\n\n"
                                                : wrapped(introduction, "") + '\n';
  for (const auto& section : sections_)
    all += format_ == Format::Markdown ? as_markdown(section) : as_text(section);
  return all;
}

std::string Reference::as_text(const Section& section)
{
  std::string text = section.title + '\n';
  if (!section.doc.empty())
    text += wrapped(section.doc, "");
  if (!section.alike.empty())
    text += fmt::format("The keys are those of {}.\n", section.alike);
  for (const auto& row : section.rows) {
    const auto unit = row.unit.empty() ? "" : fmt::format(", in {}", row.unit);
    const auto preset = row.preset == "required" ? "; required"
                        : row.preset.empty()     ? "; may be left out"
                                                 : fmt::format("; default {}", row.preset);
    text += fmt::format("\n  {}: {}{}{}\n", row.key, row.allowed, unit, preset) + wrapped(row.doc, "      ");
  }
  for (const auto& note : section.notes)
    text += '\n' + wrapped(note, "  ");
  return text + '\n';
}

std::string Reference::as_markdown(const Section& section)
{
  std::string text = fmt::format("## {}\n\n", section.path.empty() ? section.title : '`' + section.title + '`');
  if (!section.doc.empty())
    text += section.doc + "\n\n";
  if (!section.alike.empty())
    text += fmt::format("The keys are those of `{}`.\n\n", section.alike);
  if (!section.rows.empty())
    text += "| key | value | default | unit | meaning |\n|---|---|---|---|---|\n";
  for (const auto& row : section.rows) {
    const auto preset = row.preset == "required" || row.preset.empty() ? row.preset : '`' + row.preset + '`';
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.key, escaped_for_table(row.allowed),
                        escaped_for_table(preset), row.unit, escaped_for_table(row.doc));
  }
  for (const auto& note : section.notes)
    text += fmt::format("\n{}\n", note);
  return text + (section.rows.empty() && section.notes.empty() ? "" : "\n");
}

}  // namespace luff::config
