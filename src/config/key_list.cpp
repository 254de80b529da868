// SPDX-License-Identifier: BSD-3-Clause
#include "config/key_list.hpp"

#include <fmt/core.h>

#include "config/value_text.hpp"

namespace luff::config {

void KeyList::visit_key(std::string_view name, const Value& value, const Spec& /*spec*/)
{
  if (!std::holds_alternative<std::filesystem::path*>(value))
    keys_.push_back({tables_.back() + std::string(name), to_toml(value)});
}

bool KeyList::open_table(std::string_view name, const TableSpec& /*spec*/)
{
  tables_.push_back(fmt::format("{}{}.", tables_.back(), name));
  return true;
}

bool KeyList::open_item(std::string_view name, std::size_t i, const TableSpec& /*spec*/)
{
  tables_.push_back(fmt::format("{}{}.{}.", tables_.back(), name, i));
  return true;
}

}  // namespace luff::config
