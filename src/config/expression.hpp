// SPDX-License-Identifier: BSD-3-Clause
// Values of a case that may depend on place and time: a number, a formula, or a column of a file.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "core/vec3.hpp"

namespace luff::config {

/// A formula in x, y, z, t (and pi), in muParser's language.
struct Formula {
  std::string text;
  bool operator==(const Formula&) const = default;
};

/// `scale` times the function of time in a two-column CSV file.
struct ScaledFile {
  std::filesystem::path file;
  double scale = 1.0;
  bool smooth = false;    ///< monotone cubics between the instants, not straight lines
  bool periodic = false;  ///< repeated with the period from the first instant to the last
  bool operator==(const ScaledFile&) const = default;
};

/// The names that a formula may use: x, y, z, t; or s, which stands in the place of t.
enum class Variables { PlaceAndTime, ArcLength };

/// A scalar that may depend on (x, t). What does not depend on them ("2*pi") is evaluated once, when it is made.
///
/// Copies share their compiled formula, whose variables are set by each evaluation: evaluate from one thread.
class Expression {
 public:
  using Source = std::variant<double, Formula, ScaledFile>;

  Expression(double constant = 0.0);  // NOLINT(google-explicit-constructor): a number is an expression

  /// \throws InputError naming the character of a formula that is wrong, or the line of the file.
  explicit Expression(Formula formula, Variables allowed = Variables::PlaceAndTime);
  explicit Expression(ScaledFile file);

  bool is_constant() const { return function_ == nullptr; }
  /// Whether the value changes with place (with time).
  bool depends_on_place() const { return variables_.find_first_of("xyz") != std::string::npos; }
  bool depends_on_time() const { return variables_.find('t') != std::string::npos; }
  /// Those with which the value changes, one letter each.
  const std::string& variables() const { return variables_; }

  double evaluate(const Vec3& x, double t) const { return function_ ? function_->evaluate(x, t) : constant_; }

  /// As the user wrote it.
  const Source& source() const { return source_; }
  bool operator==(const Expression& other) const { return source_ == other.source_; }

  struct Function {
    virtual ~Function() = default;
    virtual double evaluate(const Vec3& x, double t) = 0;
  };

 private:
  Source source_;
  double constant_ = 0.0;
  std::string variables_;
  std::shared_ptr<Function> function_;
};

/// A vector of Cartesian components that may each depend on (x, t).
struct VectorExpression {
  std::array<Expression, 3> component;

  bool is_constant() const;
  bool depends_on_time() const;
  Vec3 evaluate(const Vec3& x, double t) const;
  bool operator==(const VectorExpression&) const = default;
};

}  // namespace luff::config
