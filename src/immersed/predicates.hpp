// SPDX-License-Identifier: BSD-3-Clause
// Determinants of coordinates whose sign is that of exact arithmetic.
#pragma once

#include <array>
#include <cmath>

#include "core/vec3.hpp"

namespace luff::immersed {

[[nodiscard]] inline int sign(double value)
{
  return (value > 0.0) - (value < 0.0);
}

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
  void add_product(double a, double b, double c)
  {
    const double product = a * b;
    add_product(std::fma(a, b, -product), c);
    add_product(product, c);
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
using Corners = std::array<Vec3, 3>;

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

/// Coordinates b and c, the next two after `axis` in cyclic order.
[[nodiscard]] inline Point2 projected(const Vec3& x, int axis)
{
  return {x[(axis + 1) % 3], x[(axis + 2) % 3]};
}

/// Sign of component `axis` of the normal (x1 - x0) x (x2 - x0).
[[nodiscard]] inline int sign_of_normal(const Corners& x, int axis)
{
  return sign(area(projected(x[1], axis), projected(x[2], axis), projected(x[0], axis)));
}

/// Sign of component `axis` of (to - from) x (n - p).
[[nodiscard]] inline int sign_of_cross(const Vec3& from, const Vec3& to, const Vec3& p, const Vec3& n, int axis)
{
  ExactSum<16> sum;
  const auto add = [&](int b, int c, double sign) {
    const ExactDifference edge(to[b], from[b]);
    const ExactDifference link(n[c], p[c]);
    sum.add_product(sign * edge.tail, link.tail);
    sum.add_product(sign * edge.head, link.tail);
    sum.add_product(sign * edge.tail, link.head);
    sum.add_product(sign * edge.head, link.head);
  };
  add((axis + 1) % 3, (axis + 2) % 3, 1.0);
  add((axis + 2) % 3, (axis + 1) % 3, -1.0);
  return sign(sum.value());
}

/// (a - d) . ((b - d) x (c - d)) without rounding, to a few units in the last place.
[[nodiscard]] inline double exact_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  ExactSum<192> sum;
  const auto add = [&](const Vec3& x, const Vec3& y, const Vec3& z, double sign) {
    const ExactDifference u(x[0], d[0]);
    const ExactDifference v(y[1], d[1]);
    const ExactDifference w(z[2], d[2]);
    for (const double s : {u.tail, u.head})
      for (const double t : {v.tail, v.head}) {
        sum.add_product(sign * s, t, w.tail);
        sum.add_product(sign * s, t, w.head);
      }
  };
  add(a, b, c, 1.0);
  add(b, c, a, 1.0);
  add(c, a, b, 1.0);
  add(a, c, b, -1.0);
  add(b, a, c, -1.0);
  add(c, b, a, -1.0);
  return sum.value();
}

/// Six times the volume of a tetrahedron in plain arithmetic, and the sum of the absolute values of its products.
struct PlainVolume {
  double value;
  double size;

  /// (a - d) . ((b - d) x (c - d))
  PlainVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) : value(0.0), size(0.0)
  {
    const Vec3 u = a - d;
    const Vec3 v = b - d;
    const Vec3 w = c - d;
    for (int m = 0; m < 3; ++m) {
      const double left = v[(m + 1) % 3] * w[(m + 2) % 3];
      const double right = v[(m + 2) % 3] * w[(m + 1) % 3];
      value += u[m] * (left - right);
      size += std::abs(u[m]) * (std::abs(left) + std::abs(right));
    }
  }
  /// Bound of |value - exact value|, (7 + 56 eps) eps size with eps = 2^-53: \cite shewchuk_1997_adaptive, section 4.3.
  [[nodiscard]] double error() const { return 0x1p-50 * size; }
};

/// Sign of (a - d) . ((b - d) x (c - d)), exact.
[[nodiscard]] inline int sign_of_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const PlainVolume plain(a, b, c, d);
  return sign(std::abs(plain.value) > plain.error() ? plain.value : exact_volume(a, b, c, d));
}

/// (a - d) . ((b - d) x (c - d)) with an error of `error` at most, or of round-off.
[[nodiscard]] inline double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double error)
{
  const PlainVolume plain(a, b, c, d);
  return plain.error() <= error ? plain.value : exact_volume(a, b, c, d);
}

}  // namespace luff::immersed
