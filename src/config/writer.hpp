// SPDX-License-Identifier: BSD-3-Clause
// Options as TOML.
#pragma once

#include <string>
#include <vector>

#include "config/schema.hpp"

namespace luff::config {

/// Writes every key, given or default; what is optional and absent is left out.
class Writer : public Schema {
 public:
  template <class T>
  std::string write(T& options)
  {
    tables_ = {Table{}};
    describe(*this, options);
    return tables_.front().keys + tables_.front().children;
  }

  void exactly_one_of(std::initializer_list<std::string_view> /*keys*/) override {}
  void rule(bool, std::string_view, std::string_view, const std::string&) override {}
  void later(std::initializer_list<std::string_view> /*keys*/) override {}

 protected:
  void visit_key(std::string_view name, const Value& value, const Spec& spec) override;
  bool enter_optional(std::string_view /*name*/, bool has_value) override { return has_value; }
  bool open_table(std::string_view name, const TableSpec& spec) override;
  void close_table() override;
  std::size_t open_list(std::string_view /*name*/, std::size_t size, const TableSpec& /*spec*/) override
  {
    return size;
  }
  bool open_item(std::string_view name, std::size_t i, const TableSpec& spec) override;

 private:
  /// TOML wants the keys of a table before the tables in it.
  struct Table {
    std::string path;
    std::string header = {};
    bool is_item = false;
    std::string keys = {};
    std::string children = {};
  };
  std::string path_of(std::string_view name) const;

  std::vector<Table> tables_;
};

}  // namespace luff::config
