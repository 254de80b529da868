// SPDX-License-Identifier: BSD-3-Clause
// Options as TOML.
#include "config/writer.hpp"

#include <fmt/core.h>

#include "config/value_text.hpp"

namespace luff::config {

std::string Writer::path_of(std::string_view name) const
{
  const auto& path = tables_.back().path;
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

void Writer::visit_key(std::string_view name, const Value& value, const Spec& /*spec*/)
{
  tables_.back().keys += fmt::format("{} = {}\n", name, to_toml(value));
}

bool Writer::open_table(std::string_view name, const TableSpec& /*spec*/)
{
  const auto path = path_of(name);
  tables_.push_back({path, fmt::format("\n[{}]\n", path)});
  return true;
}

bool Writer::open_item(std::string_view name, std::size_t /*i*/, const TableSpec& /*spec*/)
{
  const auto path = path_of(name);
  tables_.push_back({path, fmt::format("\n[[{}]]\n", path), true});
  return true;
}

void Writer::close_table()
{
  Table closed = tables_.back();
  tables_.pop_back();
  if (closed.keys.empty() && !closed.children.empty() && !closed.is_item)
    closed.header.clear();
  tables_.back().children += closed.header + closed.keys + closed.children;
}

}  // namespace luff::config
