// SPDX-License-Identifier: BSD-3-Clause
// Values of options in words and in TOML.
#include "config/value_text.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace luff::config {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

std::string allowed_expression(const Spec& spec)
{
  if (!spec.of.empty())
    return fmt::format("a number, or a formula of {}", fmt::join(spec.of, ", "));
  return fmt::format("a number, a formula of {}, or {{ file, scale }}", spec.time_only ? "t" : "x, y, z, t");
}

std::string number(double value)
{
  return fmt::format("{}", value);
}

std::string vector(const Vec3& v)
{
  return fmt::format("[{}, {}, {}]", number(v[0]), number(v[1]), number(v[2]));
}

std::string expression(const Expression& e)
{
  return std::visit(Overloaded{[](double value) { return number(value); },
                               [](const Formula& formula) { return toml_string(formula.text); },
                               [](const ScaledFile& table) {
                                 return fmt::format("{{ file = {}, scale = {}{}{} }}", toml_string(table.file.string()),
                                                    number(table.scale), table.smooth ? ", smooth = true" : "",
                                                    table.periodic ? ", periodic = true" : "");
                               }},
                    e.source());
}

}  // namespace

std::string alternatives(const std::vector<std::string>& words)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const char* separator = i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += separator + toml_string(words[i]);
  }
  return text;
}

std::string toml_string(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string allowed(const Value& value, const Spec& spec)
{
  const std::string range = spec.range.text();
  return std::visit(
      Overloaded{[](bool*) -> std::string { return "true or false"; }, [&](int*) { return "an integer" + range; },
                 [&](double*) { return "a number" + range; }, [](std::string*) -> std::string { return "a string"; },
                 [](std::filesystem::path*) -> std::string { return "the path of a file"; },
                 [&](std::array<int, 2>*) { return "[m, n], two integers" + range; },
                 [&](std::array<double, 2>*) { return "[a, b], two numbers" + range; },
                 [](Vec3*) -> std::string { return "[x, y, z], three numbers"; },
                 [](std::array<Vec3, 2>*) -> std::string { return "[[x, y, z], [x, y, z]], two points"; },
                 [&](Expression*) { return allowed_expression(spec); },
                 [&](VectorExpression*) { return "[x, y, z], each " + allowed_expression(spec); },
                 [](const Choice& choice) { return alternatives(choice.words); },
                 [](const ChoiceList& list) { return "a list of " + alternatives(list.words); }},
      value);
}

std::string to_toml(const Value& value)
{
  return std::visit(
      Overloaded{[](bool* v) -> std::string { return *v ? "true" : "false"; },
                 [](int* v) { return std::to_string(*v); }, [](double* v) { return number(*v); },
                 [](std::string* v) { return toml_string(*v); },
                 [](std::filesystem::path* v) { return toml_string(v->string()); },
                 [](std::array<int, 2>* v) { return fmt::format("[{}, {}]", (*v)[0], (*v)[1]); },
                 [](std::array<double, 2>* v) { return fmt::format("[{}, {}]", number((*v)[0]), number((*v)[1])); },
                 [](Vec3* v) { return vector(*v); },
                 [](std::array<Vec3, 2>* v) { return fmt::format("[{}, {}]", vector((*v)[0]), vector((*v)[1])); },
                 [](Expression* v) { return expression(*v); },
                 [](VectorExpression* v) {
                   const auto& c = v->component;
                   return fmt::format("[{}, {}, {}]", expression(c[0]), expression(c[1]), expression(c[2]));
                 },
                 [](const Choice& choice) { return toml_string(choice.words[choice.get()]); },
                 [](const ChoiceList& list) {
                   std::vector<std::string> words;
                   for (const std::size_t index : list.get())
                     words.push_back(toml_string(list.words[index]));
                   return fmt::format("[{}]", fmt::join(words, ", "));
                 }},
      value);
}

}  // namespace luff::config
