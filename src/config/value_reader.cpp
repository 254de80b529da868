// SPDX-License-Identifier: BSD-3-Clause
// One TOML value into one option.
#include "config/value_reader.hpp"

#include <algorithm>
#include <optional>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/nearest.hpp"
#include "config/value_text.hpp"
#include "core/error.hpp"

namespace luff::config {
namespace {

/// Reads the value of a node into any kind of option. Arrays make a reader for each of their entries.
class ValueReader {
 public:
  ValueReader(const toml::node& node, const ValueContext& context) : node_(node), context_(context) {}

  void operator()(bool* v) const { assign(v, node_.value_exact<bool>()); }
  void operator()(int* v) const;
  void operator()(double* v) const;
  void operator()(std::string* v) const { assign(v, node_.value_exact<std::string>()); }
  void operator()(std::filesystem::path* v) const;
  void operator()(std::array<int, 2>* v) const { read_entries(v->data(), 2, v); }
  void operator()(std::array<double, 2>* v) const { read_entries(v->data(), 2, v); }
  void operator()(Vec3* v) const { read_entries(v->data(), 3, v); }
  void operator()(std::array<Vec3, 2>* v) const { read_entries(v->data(), 2, v); }
  void operator()(Expression* v) const;
  void operator()(VectorExpression* v) const { read_entries(v->component.data(), 3, v); }
  void operator()(const Choice& choice) const;
  void operator()(const ChoiceList& list) const;

 private:
  template <class T>
  void assign(T* target, const std::optional<T>& value) const;
  template <class T, class Whole>
  void read_entries(T* entries, std::size_t size, Whole* whole) const;

  std::optional<std::size_t> word_index(const toml::node& node, const std::vector<std::string>& words,
                                        const std::vector<std::string>& later, const Value& value) const;
  std::optional<Expression> scaled_file(const toml::table& table) const;
  std::optional<std::filesystem::path> existing_file(const toml::node& node) const;
  ValueContext entry(const toml::node& node, const std::string& suffix) const;

  void report(const std::string& text) const
  {
    context_.issues.add(context_.place, fmt::format("{} = {} {}", context_.path, shown(node_), text));
  }
  void refuse(const Value& value) const { report("must be " + allowed(value, context_.spec)); }

  const toml::node& node_;
  const ValueContext& context_;
};

template <class T>
void ValueReader::assign(T* target, const std::optional<T>& value) const
{
  if (value)
    *target = *value;
  else
    refuse(target);
}

void ValueReader::operator()(int* v) const
{
  const auto value = node_.value_exact<std::int64_t>();
  constexpr std::int64_t largest = std::numeric_limits<int>::max();
  if (!value || !context_.spec.range.contains(static_cast<double>(*value)))
    return refuse(v);
  if (*value > largest || *value < -largest)
    return report(fmt::format("must not be beyond {}", largest));
  *v = static_cast<int>(*value);
}

void ValueReader::operator()(double* v) const
{
  const auto value = node_.is_number() ? node_.value<double>() : std::nullopt;
  if (!value || !context_.spec.range.contains(*value))
    return refuse(v);
  *v = *value;
}

void ValueReader::operator()(std::filesystem::path* v) const
{
  if (!node_.is_string())
    return refuse(v);
  if (const auto file = existing_file(node_))
    *v = *file;
}

void ValueReader::operator()(Expression* v) const
{
  try {
    std::optional<Expression> read;
    if (node_.is_number() && any_number.contains(*node_.value<double>()))
      read = Expression(*node_.value<double>());
    else if (const auto formula = node_.value_exact<std::string>())
      read = Expression(Formula{*formula}, context_.spec.of == "s" ? Variables::ArcLength : Variables::PlaceAndTime);
    else if (const auto* table = node_.as_table(); table && context_.spec.of.empty())
      read = scaled_file(*table);
    else
      refuse(v);
    if (read && context_.spec.time_only && read->depends_on_place())
      return report("may change with t, but not with x, y, z");
    if (read && !context_.spec.of.empty())
      for (const char variable : read->variables())
        if (context_.spec.of.find(variable) == std::string_view::npos)
          return report(
              fmt::format("may change with {}, but not with {}", fmt::join(context_.spec.of, ", "), variable));
    if (read)
      *v = *read;
  } catch (const InputError& error) {
    context_.issues.add(context_.place, fmt::format("{} = {}: {}", context_.path, shown(node_), error.what()));
  }
}

std::optional<Expression> ValueReader::scaled_file(const toml::table& table) const
{
  static const std::vector<std::string> keys{"file", "scale", "smooth", "periodic"};
  const std::size_t issues_before = context_.issues.count();
  for (auto&& [key, node] : table)
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
      context_.issues.add(place_of(node),
                          fmt::format("{}.{} is not a key{}", context_.path, key.str(), suggestion(key.str(), keys)));
  ScaledFile source;
  if (const auto* file = table.get("file"))
    std::visit(ValueReader(*file, entry(*file, ".file")), Value{&source.file});
  else
    context_.issues.add(context_.place, fmt::format("{}.file is missing: give the path of a file", context_.path));
  const Spec any{.doc = ""};
  const auto read_if_given = [&](const char* key, const Value& value) {
    const auto* given = table.get(key);
    if (given == nullptr)
      return;
    const auto place = entry(*given, std::string(".") + key);
    read_value(*given, value, {place.path, place.place, place.folder, any, place.issues});
  };
  read_if_given("scale", &source.scale);
  read_if_given("smooth", &source.smooth);
  read_if_given("periodic", &source.periodic);
  if (context_.issues.count() > issues_before)
    return std::nullopt;
  return Expression(source);
}

std::optional<std::filesystem::path> ValueReader::existing_file(const toml::node& node) const
{
  const auto path = (context_.folder / *node.value<std::string>()).lexically_normal();
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error))
    return path;
  report(fmt::format("must be the path of a file: there is no {}", path.string()));
  return std::nullopt;
}

void ValueReader::operator()(const Choice& choice) const
{
  if (const auto index = word_index(node_, choice.words, choice.later, choice))
    choice.set(*index);
}

void ValueReader::operator()(const ChoiceList& list) const
{
  const auto* array = node_.as_array();
  if (array == nullptr || array->empty())
    return refuse(list);
  std::vector<std::size_t> indices;
  for (const toml::node& item : *array) {
    const auto index = word_index(item, list.words, {}, list);
    if (!index)
      return;
    if (std::find(indices.begin(), indices.end(), *index) != indices.end())
      return report(fmt::format("names {} twice", shown(item)));
    indices.push_back(*index);
  }
  list.set(indices);
}

/// Place of a word in `words`; an issue if it is none of them, with the nearest one.
std::optional<std::size_t> ValueReader::word_index(const toml::node& node, const std::vector<std::string>& words,
                                                   const std::vector<std::string>& later, const Value& value) const
{
  const auto word = node.value_exact<std::string>();
  if (!word) {
    refuse(value);
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end())
    return static_cast<std::size_t>(found - words.begin());
  if (std::find(later.begin(), later.end(), *word) != later.end()) {
    report(fmt::format("is known but not available in this version; it must be {}", allowed(value, context_.spec)));
    return std::nullopt;
  }
  const auto near = nearest_name(*word, words);
  report(fmt::format("must be {}{}", allowed(value, context_.spec),
                     near ? fmt::format(" (did you mean {}?)", toml_string(*near)) : ""));
  return std::nullopt;
}

template <class T, class Whole>
void ValueReader::read_entries(T* entries, std::size_t size, Whole* whole) const
{
  const auto* array = node_.as_array();
  if (array == nullptr || array->size() != size)
    return refuse(whole);
  for (std::size_t i = 0; i < size; ++i) {
    const toml::node& item = *array->get(i);
    const auto context = entry(item, fmt::format("[{}]", i));
    ValueReader(item, context)(&entries[i]);
  }
}

ValueContext ValueReader::entry(const toml::node& node, const std::string& suffix) const
{
  return {context_.path + suffix, place_of(node), context_.folder, context_.spec, context_.issues};
}

}  // namespace

void read_value(const toml::node& node, const Value& value, const ValueContext& context)
{
  std::visit(ValueReader(node, context), value);
}

}  // namespace luff::config
