// SPDX-License-Identifier: BSD-3-Clause
// The same case on a finer or coarser grid.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "config/schema.hpp"

namespace luff::config {

/// Scales every option whose Spec says so by the resolution factor F. Expects a valid case.
class Resolution : public Schema {
 public:
  /// \throws InputError unless 0 < F < infinity.
  explicit Resolution(double factor);

  void exactly_one_of(std::initializer_list<std::string_view> /*keys*/) override {}
  void rule(bool, std::string_view, std::string_view, const std::string&) override {}
  void later(std::initializer_list<std::string_view> /*keys*/) override {}

 protected:
  /// \throws InputError if a count becomes too large for an int, or a size zero or infinite.
  void visit_key(std::string_view name, const Value& value, const Spec& spec) override;
  bool enter_optional(std::string_view /*name*/, bool has_value) override { return has_value; }
  bool open_table(std::string_view /*name*/, const TableSpec& /*spec*/) override { return true; }
  void close_table() override {}
  std::size_t open_list(std::string_view /*name*/, std::size_t size, const TableSpec& /*spec*/) override
  {
    return size;
  }
  bool open_item(std::string_view /*name*/, std::size_t /*i*/, const TableSpec& /*spec*/) override { return true; }

 private:
  int scaled_count(int count) const;
  double scaled_size(double size) const;

  double factor_;
};

}  // namespace luff::config
