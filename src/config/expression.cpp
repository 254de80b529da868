// SPDX-License-Identifier: BSD-3-Clause
// Formulas by muParser, and columns of files.
#include "config/expression.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <regex>

#include <fmt/core.h>
#include <muParser.h>

#include "core/nearest.hpp"
#include "config/time_series.hpp"
#include "core/error.hpp"

namespace luff::config {
namespace {

/// A formula whose variables are x, y, z, t; or s.
class CompiledFormula : public Expression::Function {
 public:
  CompiledFormula(const std::string& text, Variables allowed);

  double evaluate(const Vec3& x, double t) override;
  /// One letter each.
  std::string used() const
  {
    std::string letters;
    for (const auto& [name, value] : parser_.GetUsedVar())
      letters += name;
    return letters;
  }

 private:
  [[noreturn]] void explain(const mu::Parser::exception_type& error) const;

  mu::Parser parser_;
  std::vector<std::string> names_;
  std::array<double, 4> variables_{};
};

/// The first '=' that is not part of ==, <=, >=, !=: muParser would assign to a variable there.
std::size_t find_assignment(const std::string& text)
{
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=')
      continue;
    if (i + 1 < text.size() && text[i + 1] == '=')
      ++i;
    else if (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos)
      return i;
  }
  return std::string::npos;
}

CompiledFormula::CompiledFormula(const std::string& text, Variables allowed)
    : names_(allowed == Variables::ArcLength ? std::vector<std::string>{"", "", "", "s"}
                                             : std::vector<std::string>{"x", "y", "z", "t"})
{
  if (const auto position = find_assignment(text); position != std::string::npos)
    fail_input("unexpected '=' at character {} (equality is ==)", position + 1);
  try {
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (!names_[i].empty())
        parser_.DefineVar(names_[i], &variables_[i]);
    parser_.DefineConst("pi", std::numbers::pi);
    parser_.SetExpr(text);
    parser_.Eval();
  } catch (const mu::Parser::exception_type& error) {
    explain(error);
  }
  if (parser_.GetNumResults() != 1)
    fail_input("has {} values separated by commas; one is needed", parser_.GetNumResults());
}

/// Turn muParser's account into ours: characters are counted from 1, unknown names get a suggestion.
void CompiledFormula::explain(const mu::Parser::exception_type& error) const
{
  const auto where = error.GetPos() < 0 ? "" : fmt::format(" at character {}", error.GetPos() + 1);
  const std::string token = error.GetToken();
  const bool is_name = !token.empty() && std::isalpha(static_cast<unsigned char>(token.front()));
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && is_name) {
    std::vector<std::string> known;
    std::copy_if(names_.begin(), names_.end(), std::back_inserter(known), [](const auto& n) { return !n.empty(); });
    known.emplace_back("pi");
    for (const auto& [name, function] : parser_.GetFunDef())
      known.push_back(name);
    if (std::find(known.begin(), known.end(), token) == known.end())
      fail_input("unknown name '{}'{}{}", token, where, suggestion(token, known));
  }
  static const std::regex position(R"(\s*(found )?at (expression )?position -?\d+\.?)");
  const auto text = std::regex_replace(error.GetMsg(), position, "");
  fail_input("{}{}", text, where);
}

double CompiledFormula::evaluate(const Vec3& x, double t)
{
  variables_ = {x[0], x[1], x[2], t};
  return parser_.Eval();
}

class ScaledSeries : public Expression::Function {
 public:
  ScaledSeries(TimeSeries series, double scale) : series_(std::move(series)), scale_(scale) {}
  double evaluate(const Vec3& /*x*/, double t) override { return scale_ * series_(t); }

 private:
  TimeSeries series_;
  double scale_;
};

}  // namespace

Expression::Expression(double constant) : source_(constant), constant_(constant) {}

Expression::Expression(Formula formula, Variables allowed)
{
  auto compiled = std::make_shared<CompiledFormula>(formula.text, allowed);
  variables_ = compiled->used();
  if (!variables_.empty()) {
    function_ = std::move(compiled);
  } else {
    constant_ = compiled->evaluate(Vec3::Zero(), 0.0);
    if (!std::isfinite(constant_))
      fail_input("its value is {}; it must be finite", constant_);
  }
  source_ = std::move(formula);
}

Expression::Expression(ScaledFile file)
    : source_(file),
      variables_("t"),
      function_(std::make_shared<ScaledSeries>(read_time_series(file.file, {file.smooth, file.periodic}), file.scale))
{
}

bool VectorExpression::is_constant() const
{
  return std::all_of(component.begin(), component.end(), [](const auto& c) { return c.is_constant(); });
}

bool VectorExpression::depends_on_time() const
{
  return std::any_of(component.begin(), component.end(), [](const auto& c) { return c.depends_on_time(); });
}

Vec3 VectorExpression::evaluate(const Vec3& x, double t) const
{
  return {component[0].evaluate(x, t), component[1].evaluate(x, t), component[2].evaluate(x, t)};
}

}  // namespace luff::config
