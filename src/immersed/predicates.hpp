// SPDX-License-Identifier: BSD-3-Clause
// Determinants of coordinates whose sign is that of exact arithmetic.
#pragma once

#include <array>
#include <cmath>

namespace luff::immersed {

/// A sum kept exactly, as doubles of increasing magnitude whose bits do not overlap; room for N of them.
/// Source: \cite shewchuk_1997_adaptive, Theorem 10 (grow-expansion) with zeros left out.
template <int N>
class ExactSum {
 public:
  void add(double term)
  {
    if (term == 0.0)
      return;
    int kept = 0;
    for (int m = 0; m < count_; ++m) {
      const double sum = term + terms_[m];
      const double shift = sum - term;
      const double lost = (term - (sum - shift)) + (terms_[m] - shift);
      if (lost != 0.0)
        terms_[kept++] = lost;
      term = sum;
    }
    if (term != 0.0)
      terms_[kept++] = term;
    count_ = kept;
  }
  void add_product(double a, double b)
  {
    if (a == 0.0 || b == 0.0)
      return;
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double term(int m) const { return terms_[m]; }
  /// The sum to a few units in the last place; its sign is exact.
  [[nodiscard]] double value() const
  {
    double sum = 0.0;
    for (int m = 0; m < count_; ++m)
      sum += terms_[m];
    return sum;
  }

 private:
  std::array<double, N> terms_;
  int count_ = 0;
};

/// a - b as the rounded difference and what rounding lost.
struct ExactDifference {
  double head;
  double tail;

  ExactDifference(double a, double b) : head(a - b)
  {
    const double shift = a - head;
    tail = (a - (head + shift)) + (shift - b);
  }
};

using Point2 = std::array<double, 2>;

/// (from - q) x (to - q), twice the area of the triangle (q, from, to), without rounding.
[[nodiscard]] inline ExactSum<16> exact_area(const Point2& from, const Point2& to, const Point2& q)
{
  const ExactDifference ax(from[0], q[0]);
  const ExactDifference ay(from[1], q[1]);
  const ExactDifference bx(to[0], q[0]);
  const ExactDifference by(to[1], q[1]);
  ExactSum<16> sum;
  const auto add = [&sum](const ExactDifference& u, const ExactDifference& v, double sign) {
    sum.add_product(sign * u.tail, v.tail);
    sum.add_product(sign * u.head, v.tail);
    sum.add_product(sign * u.tail, v.head);
    sum.add_product(sign * u.head, v.head);
  };
  add(ax, by, 1.0);
  add(ay, bx, -1.0);
  return sum;
}

/// The same to a relative error below 2^-45, in plain arithmetic where that is enough; zero only when it is zero.
[[nodiscard]] inline double area(const Point2& from, const Point2& to, const Point2& q)
{
  // Plain arithmetic errs by less than (3 + 16 eps) eps (|left| + |right|), eps = 2^-53: \cite shewchuk_1997_adaptive,
  // section 4.2.
  constexpr double cancellation = 0x1p-6;
  const double left = (from[0] - q[0]) * (to[1] - q[1]);
  const double right = (from[1] - q[1]) * (to[0] - q[0]);
  const double plain = left - right;
  if (std::abs(plain) >= cancellation * (std::abs(left) + std::abs(right)))
    return plain;
  return exact_area(from, to, q).value();
}

}  // namespace luff::immersed
