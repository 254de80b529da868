// SPDX-License-Identifier: BSD-3-Clause
// All keys of a case, one after the other.
#pragma once

#include <string>
#include <vector>

#include "config/schema.hpp"

namespace luff::config {

/// A key by its path, "shell.0.thickness", and its value in TOML.
struct KeyValue {
  std::string key;
  std::string value;
};

/// Collects every key, given or default. Left out are names of files: they say where something is, not what.
class KeyList : public Schema {
 public:
  template <class T>
  std::vector<KeyValue> of(T& options)
  {
    describe(*this, options);
    return std::move(keys_);
  }

  void exactly_one_of(std::initializer_list<std::string_view> /*keys*/) override {}
  void rule(bool, std::string_view, std::string_view, const std::string&) override {}
  void later(std::initializer_list<std::string_view> /*keys*/) override {}

 protected:
  void visit_key(std::string_view name, const Value& value, const Spec& spec) override;
  bool enter_optional(std::string_view /*name*/, bool has_value) override { return has_value; }
  bool open_table(std::string_view name, const TableSpec& spec) override;
  void close_table() override { tables_.pop_back(); }
  std::size_t open_list(std::string_view /*name*/, std::size_t size, const TableSpec& /*spec*/) override
  {
    return size;
  }
  bool open_item(std::string_view name, std::size_t i, const TableSpec& spec) override;

 private:
  std::vector<std::string> tables_{""};  ///< paths of the open ones, each with a dot at its end
  std::vector<KeyValue> keys_;
};

}  // namespace luff::config
