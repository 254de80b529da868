// SPDX-License-Identifier: BSD-3-Clause
// The manual's page of all keys.
#pragma once

#include <string>
#include <vector>

#include "config/case.hpp"
#include "config/schema.hpp"

namespace luff::config {

/// Documents every key of every table, whether or not the options have it.
class Reference : public Schema {
 public:
  explicit Reference(Format format) : format_(format) {}

  template <class T>
  std::string write(T& defaults)
  {
    open("", "A case", "");
    describe(*this, defaults);
    close_table();
    fold_alike();
    return text();
  }

  void exactly_one_of(std::initializer_list<std::string_view> keys) override;
  void rule(bool holds, std::string_view key, std::string_view text, const std::string& detail) override;
  void later(std::initializer_list<std::string_view> keys) override;

 protected:
  void visit_key(std::string_view name, const Value& value, const Spec& spec) override;
  bool enter_optional(std::string_view name, bool has_value) override;
  bool open_table(std::string_view name, const TableSpec& spec) override;
  bool open_sibling(const std::vector<std::string>& names, std::size_t i, const TableSpec& spec) override;
  void close_table() override;
  std::size_t open_list(std::string_view name, std::size_t size, const TableSpec& spec) override;
  bool open_item(std::string_view name, std::size_t i, const TableSpec& spec) override;
  bool open_condition(bool holds, std::string_view condition) override;
  void close_condition() override;

 private:
  struct Row {
    std::string key;
    std::string allowed;
    std::string preset;  ///< "required", "may be left out", or the default in TOML
    std::string unit;
    std::string doc;
    bool operator==(const Row&) const = default;
  };
  /// A table of the case file, with what is said below its keys.
  struct Section {
    std::string path;
    std::string title;
    std::string doc;
    std::vector<Row> rows = {};
    std::vector<std::string> notes = {};
    std::string alike = {};  ///< title of an earlier table with the same keys, told only there
  };

  struct Condition {
    std::size_t depth;  ///< of the table it was stated in
    std::string text;
  };

  void open(const std::string& path, const std::string& title, const std::string& doc);
  std::string path_of(std::string_view name) const;
  std::string condition() const;
  void fold_alike();
  std::string text() const;
  static std::string as_text(const Section& section);
  static std::string as_markdown(const Section& section);

  Format format_;
  std::vector<Section> sections_;  ///< in the order in which they are opened
  std::vector<std::size_t> open_;  ///< indices of the open ones, outermost first
  std::vector<Condition> conditions_;
};

}  // namespace luff::config
