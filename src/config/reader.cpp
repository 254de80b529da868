// SPDX-License-Identifier: BSD-3-Clause
// Options from a TOML document.
#include "config/reader.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "config/case_rules.hpp"
#include "config/describe.hpp"
#include "core/nearest.hpp"
#include "config/value_reader.hpp"
#include "config/value_text.hpp"

namespace luff::config {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "boundary.x_min" -> {"boundary", "x_min"}: the first step of a path and the rest.
std::pair<std::string_view, std::string_view> split_first(std::string_view path)
{
  const auto dot = path.find('.');
  return dot == std::string_view::npos ? std::pair{path, std::string_view{}}
                                       : std::pair{path.substr(0, dot), path.substr(dot + 1)};
}

/// The node at the end of a path of keys and indices, and where its last existing step was written.
struct Located {
  const toml::node* node;
  Place place;
};

Located locate(const toml::node& start, std::string_view path)
{
  Located found{&start, place_of(start)};
  while (!path.empty()) {
    const auto [step, rest] = split_first(path);
    const toml::node* next = nullptr;
    if (const auto* table = found.node->as_table()) {
      next = table->get(step);
      found.place = next ? place_of(*table, step) : found.place;
    } else if (const auto* array = found.node->as_array()) {
      next = array->get(std::stoul(std::string(step)));
      found.place = next ? place_of(*next) : found.place;
    }
    if (next == nullptr)
      return {nullptr, found.place};
    found.node = next;
    path = rest;
  }
  return found;
}

}  // namespace

Reader::Reader(const Document& document) : document_(document)
{
  push(document.root(), "");
}

void Reader::read(Case& options)
{
  describe(*this, options);
  state_case_rules(*this, options);
  close_table();
}

void Reader::push(const toml::table& table, const std::string& path)
{
  frames_.push_back({&table, path, issues_.count()});
}

std::string Reader::path_of(std::string_view name) const
{
  const auto& path = frames_.back().path;
  return path.empty() || name.empty() ? fmt::format("{}{}", path, name) : fmt::format("{}.{}", path, name);
}

Place Reader::place_of_key(std::string_view name) const
{
  const bool is_root = frames_.size() == 1;
  const auto& table = *frames_.back().table;
  return is_root && !table.contains(name) ? document_.place() : place_of(table, name);
}

/// The key's node, if it is given; from now on the name is a known one.
const toml::node* Reader::find(std::string_view name)
{
  auto& known = frames_.back().known;
  if (!contains(known, name))
    known.emplace_back(name);
  return frames_.back().table->get(name);
}

/// Whether the keys visited now do not belong to the table; it is an issue if one is given.
bool Reader::is_forbidden(std::string_view name)
{
  const auto broken = std::find_if(conditions_.begin(), conditions_.end(), [](const auto& c) { return !c.holds; });
  if (broken == conditions_.end())
    return false;
  if (broken->is_certain && frames_.back().table->contains(name))
    issues_.add(place_of_key(name), fmt::format("{} goes only with {}", path_of(name), broken->text));
  return true;
}

void Reader::report_missing(std::string_view name, const std::string& remedy)
{
  issues_.add(place_of_key(name), fmt::format("{} is missing: {}", path_of(name), remedy));
}

void Reader::report_wrong(std::string_view name, const std::string& text)
{
  issues_.add(place_of_key(name),
              fmt::format("{} = {} {}", path_of(name), shown(*frames_.back().table->get(name)), text));
}

void Reader::visit_key(std::string_view name, const Value& value, const Spec& spec)
{
  const auto* node = find(name);
  if (is_forbidden(name))
    return;
  if (node != nullptr)
    read_value(*node, value, {path_of(name), place_of_key(name), document_.folder(), spec, issues_});
  else if (spec.required)
    report_missing(name, fmt::format("give {}", allowed(value, spec)));
}

bool Reader::enter_optional(std::string_view name, bool /*has_value*/)
{
  return find(name) != nullptr;
}

bool Reader::open_table(std::string_view name, const TableSpec& spec)
{
  const auto* node = find(name);
  if (is_forbidden(name))
    return false;
  if (node == nullptr) {
    if (spec.required)
      report_missing(name, fmt::format("give the table [{}]", path_of(name)));
    return false;
  }
  if (const auto* table = node->as_table()) {
    push(*table, path_of(name));
    return true;
  }
  report_wrong(name, fmt::format("must be one table: [{}] or {{ ... }}", path_of(name)));
  return false;
}

std::size_t Reader::open_list(std::string_view name, std::size_t /*size*/, const TableSpec& /*spec*/)
{
  const auto* node = find(name);
  if (is_forbidden(name) || node == nullptr)
    return 0;
  if (const auto* array = node->as_array())
    return array->size();
  report_wrong(name, fmt::format("must be a list of tables: [[{}]]", path_of(name)));
  return 0;
}

bool Reader::open_item(std::string_view name, std::size_t i, const TableSpec& /*spec*/)
{
  const auto& array = *frames_.back().table->get_as<toml::array>(name);
  if (const auto* table = array[i].as_table()) {
    push(*table, array.size() == 1 ? path_of(name) : fmt::format("{}.{}", path_of(name), i));
    return true;
  }
  issues_.add(place_of(array[i]), fmt::format("{}.{} = {} must be a table", path_of(name), i, shown(array[i])));
  return false;
}

void Reader::close_table()
{
  for (auto&& [key, node] : *frames_.back().table)
    if (!contains(frames_.back().known, key.str()))
      report_unknown(key.str());
  frames_.pop_back();
}

void Reader::report_unknown(std::string_view name)
{
  const Frame& frame = frames_.back();
  const auto path = path_of(name);
  if (contains(frame.later, name))
    issues_.add(place_of_key(name),
                fmt::format("{} is not available in this version (available here: {})", path, joined(frame.known)));
  else
    issues_.add(place_of_key(name), fmt::format("{} is not a key of {}{}", path,
                                                frame.path.empty() ? "a case" : fmt::format("[{}]", frame.path),
                                                suggestion(name, frame.known)));
}

bool Reader::open_condition(bool holds, std::string_view condition)
{
  const bool is_certain = issues_.count() == frames_.back().issues_before;
  conditions_.push_back({holds, is_certain, std::string(condition)});
  return true;
}

void Reader::exactly_one_of(std::initializer_list<std::string_view> keys)
{
  if (!belong_here())
    return;
  std::vector<std::string> given;
  std::vector<std::string> allowed_keys(keys.begin(), keys.end());
  for (const auto& key : allowed_keys)
    if (frames_.back().table->contains(key))
      given.push_back(key);
  if (given.size() == 1)
    return;
  const auto what = fmt::format("{} must have exactly one of {}", path_of(""), joined(allowed_keys));
  if (given.empty())
    issues_.add(place_of_key(""), what + "; it has none");
  else
    issues_.add(place_of_key(given.back()), fmt::format("{}; it has {}", what, joined(given)));
}

/// Whether what is stated now is about the table as it is.
bool Reader::belong_here() const
{
  return std::all_of(conditions_.begin(), conditions_.end(), [](const auto& c) { return c.holds; });
}

/// Rules are about values: they wait until each value of the table can be read.
void Reader::rule(bool holds, std::string_view key, std::string_view text, const std::string& detail)
{
  const Frame& frame = frames_.back();
  if (holds || !belong_here() || issues_.count() > frame.issues_before)
    return;
  const bool is_case = frame.path.empty() && key.empty();
  const auto found = locate(*frame.table, key);
  const auto subject = is_case ? "the case" : path_of(key);
  const auto value = found.node && found.node->is_value() ? fmt::format(" = {}", shown(*found.node)) : "";
  issues_.add(is_case ? document_.place() : found.place, fmt::format("{}{} {}{}", subject, value, text, detail));
}

void Reader::later(std::initializer_list<std::string_view> keys)
{
  frames_.back().later.insert(frames_.back().later.end(), keys.begin(), keys.end());
}

}  // namespace luff::config
