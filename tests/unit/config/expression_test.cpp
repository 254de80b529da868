// SPDX-License-Identifier: BSD-3-Clause
// Expressions: constants, formulas, columns of files.
#include "config/expression.hpp"

#include <numbers>

#include "case_text.hpp"

namespace luff::config {
namespace {

double value_of(const std::string& formula, const Vec3& x = Vec3::Zero(), double t = 0.0)
{
  return Expression(Formula{formula}).evaluate(x, t);
}

std::string complaint_about_formula(const std::string& formula)
{
  try {
    const Expression expression(Formula{formula});
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Expressions, EvaluateFormulasOfPlaceAndTime)
{
  const Vec3 x(2.0, 3.0, 5.0);
  EXPECT_DOUBLE_EQ(value_of("x + 10*y + 100*z + 1000*t", x, 7.0), 7532.0);
  EXPECT_DOUBLE_EQ(value_of("1 - cos(2*pi*t)", x, 0.25), 1.0 - std::cos(std::numbers::pi / 2.0));
  EXPECT_DOUBLE_EQ(value_of("t < 1 ? 3 : 4", x, 2.0), 4.0);
  EXPECT_DOUBLE_EQ(value_of("x == 2", x), 1.0);
  EXPECT_DOUBLE_EQ(value_of("x >= 3 || y <= 3", x), 1.0);
}

TEST(Expressions, KnowWhatTheyDependOn)
{
  const Expression number(3.0);
  const Expression constant(Formula{"2*pi"});
  const Expression place(Formula{"sin(y)"});
  const Expression time(Formula{"exp(-t)"});
  EXPECT_TRUE(number.is_constant() && constant.is_constant());
  EXPECT_TRUE(!place.is_constant() && place.depends_on_place() && !place.depends_on_time());
  EXPECT_TRUE(!time.is_constant() && !time.depends_on_place() && time.depends_on_time());
  EXPECT_DOUBLE_EQ(constant.evaluate(Vec3::Zero(), 0.0), 2.0 * std::numbers::pi);
}

TEST(Expressions, KeepTheirValuesWhenCopiedAndMoved)
{
  Expression original(Formula{"x*t"});
  const Expression copy = original;
  const Expression moved = std::move(original);
  EXPECT_DOUBLE_EQ(copy.evaluate(Vec3(2.0, 0.0, 0.0), 3.0), 6.0);
  EXPECT_DOUBLE_EQ(moved.evaluate(Vec3(5.0, 0.0, 0.0), 3.0), 15.0);
  EXPECT_DOUBLE_EQ(copy.evaluate(Vec3(2.0, 0.0, 0.0), 3.0), 6.0);
}

TEST(Expressions, AreEqualIfWrittenAlike)
{
  EXPECT_EQ(Expression(Formula{"x"}), Expression(Formula{"x"}));
  EXPECT_NE(Expression(Formula{"x"}), Expression(Formula{"y"}));
  EXPECT_NE(Expression(Formula{"1"}), Expression(1.0));
}

TEST(Expressions, ScaleAColumnOfAFile)
{
  const Expression wave(ScaledFile{data_folder / "wave.csv", 3.0});
  EXPECT_FALSE(wave.is_constant());
  EXPECT_TRUE(wave.depends_on_time());
  EXPECT_FALSE(wave.depends_on_place());
  EXPECT_DOUBLE_EQ(wave.evaluate(Vec3::Zero(), 0.5), 3.0);
}

TEST(VectorExpressions, EvaluateTheirComponents)
{
  const VectorExpression v{{Expression(1.0), Expression(Formula{"y"}), Expression(Formula{"t"})}};
  EXPECT_EQ(v.evaluate(Vec3(0.0, 4.0, 0.0), 9.0), Vec3(1.0, 4.0, 9.0));
  EXPECT_TRUE(!v.is_constant() && v.depends_on_time());
  EXPECT_TRUE(VectorExpression{}.is_constant());
}

TEST(WrongFormulas, AreToldWithTheCharacterAndTheNearestName)
{
  const std::pair<const char*, const char*> table[] = {
      {"1 + sni(y)", "unknown name 'sni' at character 5 (did you mean 'sin'?)"},
      {"velocity",
       "unknown name 'velocity' at character 1 (known: x, y, z, t, pi, abs, acos, acosh, asin, asinh, atan, "
       "atan2, atanh, avg, cos, cosh, exp, ln, log, log10, log2, max, min, rint, sign, sin, sinh, sqrt, sum, "
       "tan, tanh)"},
      {"1 +", "Unexpected end of expression at character 5"},
      {"sin(x", "Missing parenthesis at character 7"},
      {"2 x", "Unexpected variable \"x\" at character 3"},
      {"sin()", "Too few parameters for function \"sin\" at character 5"},
      {"x = 3", "unexpected '=' at character 3 (equality is ==)"},
      {"1, 2", "has 2 values separated by commas; one is needed"},
      {"1/0", "its value is inf; it must be finite"},
      {"", "Expression is empty."},
  };
  for (const auto& [formula, complaint] : table)
    EXPECT_EQ(complaint_about_formula(formula), complaint) << formula;
}

}  // namespace
}  // namespace luff::config
