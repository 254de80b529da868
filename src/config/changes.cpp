// SPDX-License-Identifier: BSD-3-Clause
#include "config/changes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include <fmt/core.h>

#include "config/describe.hpp"
#include "config/document.hpp"
#include "config/issues.hpp"
#include "config/key_list.hpp"

namespace luff::config {

namespace {

/// Keys, and tables (with a dot at their end), that say how long and how closely a run is computed and what is written
/// of it: not what it is.
constexpr std::array free_to_change{"title",
                                    "time.end",
                                    "time.step",
                                    "time.cfl",
                                    "output.",
                                    "pressure.",
                                    "structure.solver",
                                    "structure.fold_limit",
                                    "structure.stabilisation",
                                    "structure.max_steps",
                                    "coupling."};

bool may_change(const std::string& key)
{
  return std::any_of(free_to_change.begin(), free_to_change.end(), [&](const std::string& free) {
    return free.ends_with('.') ? key.starts_with(free) : key == free;
  });
}

std::string what_may_change()
{
  std::string text;
  for (std::string key : free_to_change) {
    if (key.ends_with('.'))
      key = fmt::format("[{}]", key.substr(0, key.size() - 1));
    text += (text.empty() ? "" : ", ") + key;
  }
  return text;
}

constexpr std::string_view equals = " = ";

using Values = std::map<std::string, std::string>;

Values values_of(const std::string& list)
{
  Values values;
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(equals); at != std::string::npos)
      values[line.substr(0, at)] = line.substr(at + equals.size());
  return values;
}

/// Where the last part of "shell.0.thickness" was written that is written at all.
Place place_in(const Document& document, const std::string& key)
{
  Place place = document.place();
  const toml::node* node = &document.root();
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    const toml::node* next = nullptr;
    if (const toml::table* table = node->as_table())
      next = table->get(part);
    else if (const toml::array* list = node->as_array())
      next = list->get(std::stoul(part));
    if (next == nullptr)
      break;
    node = next;
    place = place_of(*node);
  }
  return place;
}

struct Change {
  std::string key;
  std::string text;
};

std::vector<Change> changes(const Values& before, const Values& now)
{
  std::vector<Change> all;
  for (const auto& [key, value] : now)
    if (const auto earlier = before.find(key); earlier == before.end())
      all.push_back({key, fmt::format("{} = {}, which the checkpoint's run did not have", key, value)});
    else if (earlier->second != value)
      all.push_back({key, fmt::format("{} = {}, and {} in the checkpoint's run", key, value, earlier->second)});
  for (const auto& [key, value] : before)
    if (!now.contains(key))
      all.push_back({key, fmt::format("{} is missing, and {} in the checkpoint's run", key, value)});
  return all;
}

}  // namespace

std::string list_keys(const Case& options)
{
  Case copy = options;
  std::string list;
  for (const KeyValue& entry : KeyList().of(copy))
    list += fmt::format("{}{}{}\n", entry.key, equals, entry.value);
  return list;
}

std::vector<std::string> accept_changes(const std::string& earlier_list, const Case& options,
                                        const std::filesystem::path& file, const Overrides& overrides)
{
  Document document(file);
  for (const auto& assignment : overrides.sets)
    document.set(assignment);
  Issues issues;
  std::vector<std::string> accepted;
  for (const Change& change : changes(values_of(earlier_list), values_of(list_keys(options))))
    if (may_change(change.key))
      accepted.push_back(change.text);
    else
      issues.add(place_in(document, change.key), change.text + ": only these may change: " + what_may_change());
  issues.throw_if_any();
  return accepted;
}

}  // namespace luff::config
