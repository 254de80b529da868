// SPDX-License-Identifier: BSD-3-Clause
// The visitor to which options describe themselves: one description serves reading, writing, scaling and the manual.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "config/expression.hpp"
#include "config/mark.hpp"
#include "config/range.hpp"
#include "config/words.hpp"

namespace luff::config {

/// What the resolution factor F does to a number.
enum class Scaling {
  None,
  Count,  ///< times F, rounded, one at least: cells, divisions
  Size    ///< divided by F: spacings, time steps
};

/// What there is to say about a key besides its name and value. Its default is the option's value when constructed.
struct Spec {
  std::string_view doc;
  std::string_view unit = "";  ///< in SI, as an example of a consistent set
  Range range = any_number;    ///< of a number, of each number of an array
  bool required = false;
  Scaling scaling = Scaling::None;
  bool time_only = false;    ///< an expression of t, not of x, y, z
  std::string_view of = "";  ///< an expression of these variables and no others: "x", "xyz", "s" (arc length); no file
};

struct TableSpec {
  std::string_view doc;
  bool required = false;
};

/// Refers to an option that holds one of a set of words.
struct Choice {
  std::vector<std::string> words;
  std::vector<std::string> later;
  std::function<std::size_t()> get;  ///< index into words
  std::function<void(std::size_t)> set;
};

/// Refers to an option that holds several of a set of words.
struct ChoiceList {
  std::vector<std::string> words;
  std::function<std::vector<std::size_t>()> get;
  std::function<void(const std::vector<std::size_t>&)> set;
};

/// Refers to an option of any of the kinds that a key can hold.
using Value = std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, std::array<int, 2>*,
                           std::array<double, 2>*, Vec3*, std::array<Vec3, 2>*, Expression*, VectorExpression*, Choice,
                           ChoiceList>;

/// Visitor of a tree of options. `describe(Schema&, Options&)`, one function for each struct of options.hpp, names the
/// keys, tables and rules of that struct; what happens with them is up to the visitor:
///
/// | visitor    | key                      | optional, absent | list        | rule             |
/// |------------|--------------------------|------------------|-------------|------------------|
/// | Reader     | file -> option, or issue | skipped          | as in file  | issue if broken  |
/// | Writer     | option -> text           | skipped          | as in case  | -                |
/// | Reference  | documented               | documented       | one item    | documented       |
/// | Resolution | scaled                   | skipped          | as in case  | -                |
class Schema {
 public:
  virtual ~Schema() = default;

  /// A key of the current table. An optional one has no default: it may be left out.
  template <class T>
  void key(std::string_view name, T& value, const Spec& spec)
  {
    visit_key(name, refer_to(value), spec);
  }

  template <class T>
  void key(std::string_view name, std::optional<T>& value, const Spec& spec)
  {
    if (!enter_optional(name, value.has_value()))
      return;
    T content = value.value_or(T{});
    optional_ = true;
    key(name, content, spec);
    optional_ = false;
    value = content;
  }

  /// A table in the current one.
  template <class T>
  void table(std::string_view name, T& options, const TableSpec& spec)
  {
    if (!open_table(name, spec))
      return;
    describe(*this, options);
    close_table();
  }

  template <class T>
  void table(std::string_view name, std::optional<T>& options, const TableSpec& spec)
  {
    if (!enter_optional(name, options.has_value()))
      return;
    T content = options.value_or(T{});
    table(name, content, spec);
    options = content;
  }

  /// Several tables that hold the same keys.
  template <class T, std::size_t N>
  void tables(const std::array<const char*, N>& names, std::array<T, N>& options, const TableSpec& spec)
  {
    const std::vector<std::string> all(names.begin(), names.end());
    for (std::size_t i = 0; i < N; ++i) {
      if (!open_sibling(all, i, spec))
        continue;
      describe(*this, options[i]);
      close_table();
    }
  }

  /// An array of tables: [[name]].
  template <class T>
  void list(std::string_view name, std::vector<T>& items, const TableSpec& spec)
  {
    items.resize(open_list(name, items.size(), spec));
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!open_item(name, i, spec))
        continue;
      describe(*this, items[i]);
      close_table();
    }
  }

  /// Keys that belong to the current table only if a condition, put in words, holds.
  template <class Body>
  void when(bool holds, std::string_view condition, Body body)
  {
    if (!open_condition(holds, condition))
      return;
    body();
    close_condition();
  }

  /// The current table has one and only one of these keys.
  virtual void exactly_one_of(std::initializer_list<std::string_view> keys) = 0;

  /// What must hold for a key (a path from the current table; "" for the table itself): "<key> <text>". The detail
  /// tells more about the case in which it does not.
  virtual void rule(bool holds, std::string_view key, std::string_view text, const std::string& detail = "") = 0;

  /// Keys of the case-file language that this version does not have yet.
  virtual void later(std::initializer_list<std::string_view> keys) = 0;

  /// Where the current table was written; only a Reader knows.
  virtual void mark(Mark& /*mark*/) {}

 protected:
  virtual void visit_key(std::string_view name, const Value& value, const Spec& spec) = 0;
  virtual bool enter_optional(std::string_view name, bool has_value) = 0;
  virtual bool open_table(std::string_view name, const TableSpec& spec) = 0;
  virtual bool open_sibling(const std::vector<std::string>& names, std::size_t i, const TableSpec& spec)
  {
    return open_table(names[i], spec);
  }
  virtual void close_table() = 0;
  virtual std::size_t open_list(std::string_view name, std::size_t size, const TableSpec& spec) = 0;
  virtual bool open_item(std::string_view name, std::size_t i, const TableSpec& spec) = 0;
  virtual bool open_condition(bool holds, std::string_view /*condition*/) { return holds; }
  virtual void close_condition() {}

  /// The key being visited may be left out and has no default.
  bool is_optional() const { return optional_; }

 private:
  template <class T>
  static Value refer_to(T& value);
  template <class Enum>
  static Choice refer_to_word(Enum& value);
  template <class Enum>
  static ChoiceList refer_to_words(std::vector<Enum>& value);

  bool optional_ = false;
};

template <class Enum>
Choice Schema::refer_to_word(Enum& value)
{
  Choice choice;
  choice.later = words(Enum{}).later;
  for (const auto& [enumerator, word] : words(Enum{}).available)
    choice.words.push_back(word);
  choice.get = [&value] {
    std::size_t index = 0;
    while (words(Enum{}).available[index].first != value)
      ++index;
    return index;
  };
  choice.set = [&value](std::size_t index) { value = words(Enum{}).available[index].first; };
  return choice;
}

template <class Enum>
ChoiceList Schema::refer_to_words(std::vector<Enum>& value)
{
  ChoiceList list;
  for (const auto& [enumerator, word] : words(Enum{}).available)
    list.words.push_back(word);
  list.get = [&value] {
    std::vector<std::size_t> indices;
    for (Enum& item : value)
      indices.push_back(refer_to_word(item).get());
    return indices;
  };
  list.set = [&value](const std::vector<std::size_t>& indices) {
    value.clear();
    for (const std::size_t index : indices)
      value.push_back(words(Enum{}).available[index].first);
  };
  return list;
}

template <class T>
Value Schema::refer_to(T& value)
{
  if constexpr (std::is_enum_v<T>)
    return refer_to_word(value);
  else if constexpr (std::is_constructible_v<Value, T*>)
    return Value{&value};
  else
    return refer_to_words(value);
}

}  // namespace luff::config
