// SPDX-License-Identifier: BSD-3-Clause
// Parse TOML and apply assignments from the command line.
#include "config/document.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

#include <fmt/core.h>

#include "core/nearest.hpp"
#include "config/value_text.hpp"
#include "core/error.hpp"

namespace luff::config {
namespace {

std::string contents_of(const std::filesystem::path& file)
{
  if (std::filesystem::is_directory(file))
    fail_input("{}: is a folder; give the case file in it", file.string());
  std::ifstream in(file, std::ios::binary);
  if (!in)
    fail_input("{}: {}", file.string(), std::filesystem::exists(file) ? "cannot be read" : "there is no such file");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What toml++ says, in plainer words where a key or a table is given twice.
std::string explained(const std::string& description)
{
  static const std::regex twice("cannot redefine existing .* '(.*)'( as .*)?$");
  std::smatch name;
  if (std::regex_search(description, name, twice))
    return fmt::format("'{}' is given twice; keep one", name[1].str());
  return description;
}

toml::table parse(std::string_view text, const std::string& source)
{
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    const Place place{source, static_cast<int>(error.source().begin.line)};
    fail_input("{}: {}", place.text(), explained(std::string(error.description())));
  }
}

std::string trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::vector<std::string> split_path(const std::string& path)
{
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');)
    parts.push_back(trimmed(part));
  return parts;
}

/// Words may come without the quotes that a shell would swallow.
bool is_word(const std::string& text)
{
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.' || c == '/'; });
}

/// The single key and value of "path = value".
toml::table parse_assignment(const std::string& path, const std::string& value, const std::string& source)
{
  const auto parsed = [&](const std::string& text) { return parse(path + " = " + text, source); };
  const bool is_literal = value == "true" || value == "false" || value == "inf" || value == "nan";
  auto table = is_word(value) && !is_literal ? parsed('"' + value + '"') : parsed(value);
  if (table.size() != 1)
    fail_input("{}: must be one key and one value", source);
  return table;
}

/// Index of the entry that `part` names by number or by its key `name`.
std::size_t index_of(const toml::array& entries, const std::string& part, const std::string& source)
{
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error == std::errc{} && end == part.data() + part.size() && index < entries.size())
    return index;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto* entry = entries[i].as_table();
    const auto name = entry ? (*entry)["name"].value<std::string>() : std::nullopt;
    if (name == part)
      return i;
    names.push_back(name.value_or(std::to_string(i)));
  }
  fail_input("{}: there is no entry '{}': the case has {}, numbered from 0{}", source, part, entries.size(),
             suggestion(part, names));
}

/// The node below `node` that `part` names; none if a table has no such key. \throws InputError if it cannot have any.
toml::node* child(toml::node& node, const std::string& part, const std::string& source)
{
  if (auto* table = node.as_table())
    return table->get(part);
  if (auto* array = node.as_array())
    return array->get(index_of(*array, part, source));
  fail_input("{}: '{}' cannot be set inside {}, which is not a table", source, part, shown(node));
}

std::string inline_toml(const toml::node& node);

std::string inline_table(const toml::table& table)
{
  std::vector<std::string> entries;
  for (auto&& [key, value] : table)
    entries.push_back(fmt::format("{} = {}", key.str(), inline_toml(value)));
  return fmt::format("{{ {} }}", joined(entries));
}

std::string inline_array(const toml::array& array)
{
  std::vector<std::string> entries;
  for (const toml::node& value : array)
    entries.push_back(inline_toml(value));
  return fmt::format("[{}]", joined(entries));
}

/// Unlike toml++'s own formatters: on one line, and numbers with the fewest digits that tell them apart.
std::string inline_toml(const toml::node& node)
{
  if (const auto* table = node.as_table())
    return inline_table(*table);
  if (const auto* array = node.as_array())
    return inline_array(*array);
  if (const auto* text = node.as_string())
    return toml_string(text->get());
  if (const auto* number = node.as_floating_point())
    return fmt::format("{}", number->get());
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << toml::toml_formatter{value}; });
  return out.str();
}

std::string join_path(const std::vector<std::string>& parts, std::size_t first)
{
  std::string path;
  for (std::size_t i = first; i < parts.size(); ++i)
    path += (i == first ? "" : ".") + parts[i];
  return path;
}

void replace_entry(toml::array& array, const std::string& part, const std::string& value, const std::string& source)
{
  const auto index = static_cast<std::ptrdiff_t>(index_of(array, part, source));
  auto assigned = parse_assignment("entry", value, source);
  array.replace(array.cbegin() + index, std::move(*assigned.get("entry")));
}

/// `path` starts with `key`, a key of the holder; nodes are moved because copies forget where they were written.
void replace_key(toml::node& holder, const std::string& path, const std::string& key, const std::string& value,
                 const std::string& source)
{
  child(holder, key, source);
  auto assigned = parse_assignment(path, value, source);
  auto& table = *holder.as_table();
  table.erase(key);
  for (auto&& [name, node] : assigned)
    table.insert(name, std::move(node));
}

}  // namespace

Document::Document(const std::filesystem::path& file)
    : file_(file.string()),
      folder_(std::filesystem::absolute(file).parent_path()),
      root_(parse(contents_of(file), file_))
{
}

void Document::set(const std::string& assignment)
{
  const std::string source = "--set " + assignment;
  const auto equals = std::min(assignment.find('='), assignment.size());
  const auto path = split_path(assignment.substr(0, equals));
  const auto value = trimmed(std::string_view(assignment).substr(std::min(equals + 1, assignment.size())));
  if (path.empty() || value.empty())
    fail_input("{}: must be key=value, as in time.end=2", source);

  toml::node* holder = &root_;
  std::size_t depth = 0;
  for (; depth + 1 < path.size(); ++depth) {
    toml::node* next = child(*holder, path[depth], source);
    if (next == nullptr)
      break;  // the rest of the path makes new tables
    holder = next;
  }
  if (auto* array = holder->as_array())
    replace_entry(*array, path.back(), value, source);
  else
    replace_key(*holder, join_path(path, depth), path[depth], value, source);
}

Place place_of(const toml::node& node)
{
  const auto& source = node.source();
  return {source.path ? *source.path : "", static_cast<int>(source.begin.line)};
}

Place place_of(const toml::table& table, std::string_view key)
{
  const auto entry = table.find(key);
  if (entry == table.end())
    return place_of(table);
  const auto& source = entry->first.source();
  if (!source.path || source.begin.line == 0)
    return place_of(entry->second);
  return {*source.path, static_cast<int>(source.begin.line)};
}

std::string shown(const toml::node& node)
{
  constexpr std::size_t longest = 60;
  const auto text = inline_toml(node);
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

}  // namespace luff::config
