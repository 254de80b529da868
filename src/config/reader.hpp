// SPDX-License-Identifier: BSD-3-Clause
// Options from a TOML document, with everything that is wrong in it.
#pragma once

#include <string>
#include <vector>

#include "config/document.hpp"
#include "config/issues.hpp"
#include "config/schema.hpp"

namespace luff::config {

class Reader : public Schema {
 public:
  explicit Reader(const Document& document);

  /// Read the whole document. Meaningful only if no issue was found.
  void read(Case& options);
  const Issues& issues() const { return issues_; }

  void exactly_one_of(std::initializer_list<std::string_view> keys) override;
  void rule(bool holds, std::string_view key, std::string_view text, const std::string& detail) override;
  void later(std::initializer_list<std::string_view> keys) override;
  void mark(Mark& mark) override { mark.text = place_of_key("").text(); }

 protected:
  void visit_key(std::string_view name, const Value& value, const Spec& spec) override;
  bool enter_optional(std::string_view name, bool has_value) override;
  bool open_table(std::string_view name, const TableSpec& spec) override;
  void close_table() override;
  std::size_t open_list(std::string_view name, std::size_t size, const TableSpec& spec) override;
  bool open_item(std::string_view name, std::size_t i, const TableSpec& spec) override;
  bool open_condition(bool holds, std::string_view condition) override;
  void close_condition() override { conditions_.pop_back(); }

 private:
  /// A table being read.
  struct Frame {
    const toml::table* table;
    std::string path;
    std::size_t issues_before;
    std::vector<std::string> known = {};
    std::vector<std::string> later = {};
  };
  struct Condition {
    bool holds;
    bool is_certain;  ///< nothing was wrong in the table when the condition was stated
    std::string text;
  };

  const toml::node* find(std::string_view name);
  bool is_forbidden(std::string_view name);
  bool belong_here() const;
  void report_missing(std::string_view name, const std::string& remedy);
  void report_unknown(std::string_view name);
  void report_wrong(std::string_view name, const std::string& text);
  std::string path_of(std::string_view name) const;
  Place place_of_key(std::string_view name) const;
  void push(const toml::table& table, const std::string& path);

  const Document& document_;
  Issues issues_;
  std::vector<Frame> frames_;
  std::vector<Condition> conditions_;
};

}  // namespace luff::config
