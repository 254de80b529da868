// SPDX-License-Identifier: BSD-3-Clause
#include "grid/generators/centreline.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <unsupported/Eigen/Splines>

#include "core/error.hpp"

namespace luff::grid {

namespace {

/// Where a piece that starts at p with curvature (k1, k2) is after a length s.
///
///   x = x_0 + sin(k s)/k t + (1 - cos(k s))/k n,   k n = k1 e1 + k2 e2,
///
/// and the frame is turned by the angle k s about t x n.
CurvePoint advanced(const CurvePoint& p, const Eigen::Vector2d& curvature, double s)
{
  const double k = curvature.norm();
  const double angle = k * s;
  if (angle == 0.0)
    return {p.x + s * p.t, p.e1, p.e2, p.t};
  const Vec3 n = (curvature[0] * p.e1 + curvature[1] * p.e2) / k;
  const double half = std::sin(0.5 * angle);
  const Eigen::AngleAxisd turn(angle, p.t.cross(n));
  return {p.x + std::sin(angle) / k * p.t + 2.0 * half * half / k * n, turn * p.e1, turn * p.e2, turn * p.t};
}

using Spline = Eigen::Spline<double, 3>;

Spline spline_through(const std::vector<Vec3>& points, const Eigen::RowVectorXd& parameters)
{
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t n = 0; n < points.size(); ++n)
    columns.col(static_cast<Eigen::Index>(n)) = points[n];
  const int degree = std::min(3, static_cast<int>(points.size()) - 1);
  return Eigen::SplineFitting<Spline>::Interpolate(columns, degree, Spline::KnotVectorType(parameters));
}

/// Chord lengths from the first point, over the whole.
Eigen::RowVectorXd chord_lengths(const std::vector<Vec3>& points)
{
  Eigen::RowVectorXd lengths(points.size());
  lengths[0] = 0.0;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const double chord = (points[n] - points[n - 1]).norm();
    if (!(chord > 0.0))
      fail_input("points {} and {} of the centreline are the same", n - 1, n);
    lengths[static_cast<Eigen::Index>(n)] = lengths[static_cast<Eigen::Index>(n) - 1] + chord;
  }
  return lengths / lengths[lengths.size() - 1];
}

Vec3 tangent(const Spline& spline, double u)
{
  return Vec3(spline.derivatives(u, 1).col(1)).normalized();
}

}  // namespace

CurvePoint frame_along(const Vec3& x, const Vec3& direction)
{
  CurvePoint p;
  p.x = x;
  p.t = direction.normalized();
  Eigen::Index across = 0;
  p.t.cwiseAbs().minCoeff(&across);
  const Vec3 axis = Vec3::Unit(across);
  p.e1 = (axis - axis.dot(p.t) * p.t).normalized();
  p.e2 = p.t.cross(p.e1);
  return p;
}

Centreline Centreline::through(const std::vector<Vec3>& points)
{
  ensure(points.size() >= 2, "a centreline goes through two points at least");
  constexpr int pairs = 32;  // the curve is then within 1e-5 of the distance between points of its spline
  const Eigen::RowVectorXd parameters = chord_lengths(points);
  const Spline spline = spline_through(points, parameters);
  Centreline line(frame_along(points.front(), tangent(spline, 0.0)));
  for (Eigen::Index n = 1; n < parameters.size(); ++n)
    for (int m = 1; m <= pairs; ++m) {
      const double u = parameters[n - 1] + (parameters[n] - parameters[n - 1]) * m / pairs;
      const Vec3 x = m == pairs ? points[n] : Vec3(spline(u));
      line.add_biarc(x, tangent(spline, u));
    }
  return line;
}

void Centreline::add(double length, const Eigen::Vector2d& curvature)
{
  pieces_.push_back({length_, end_, curvature});
  end_ = advanced(end_, curvature, length);
  length_ += length;
}

void Centreline::add_bend(double radius, double angle, const Vec3& towards)
{
  const Eigen::Vector2d across(towards.dot(end_.e1), towards.dot(end_.e2));
  // Along the tangent but for rounding: no side to turn to.
  if (!(across.norm() > 1e-12 * towards.norm()))
    fail_input(
        "a bend towards ({:.6g}, {:.6g}, {:.6g}) where the centreline runs along ({:.6g}, {:.6g}, {:.6g}): must "
        "point to a side",
        towards[0], towards[1], towards[2], end_.t[0], end_.t[1], end_.t[2]);
  add(radius * angle, across.normalized() / radius);
}

/// The circle through the end and x that touches the tangent: its curvature is 2 c_n/|c|^2, c_n the part of the chord c
/// across the tangent, and it turns by twice the angle between tangent and chord.
void Centreline::add_arc_to(const Vec3& x)
{
  const Vec3 chord = x - end_.x;
  const double c = chord.norm();
  const Eigen::Vector2d across(chord.dot(end_.e1), chord.dot(end_.e2));
  const double half = std::atan2(across.norm(), chord.dot(end_.t));
  const double sine = std::sin(half);
  add(sine > 0.0 ? c * half / sine : c, 2.0 * across / (c * c));
}

/// Two arcs to x that end along t, joined halfway between the corners of their control polygons, which lie the same
/// length d from both ends:  (v - d (t_0 + t))^2 = 4 d^2,  v = x - x_0.
void Centreline::add_biarc(const Vec3& x, const Vec3& t)
{
  const Vec3 v = x - end_.x;
  const Vec3 sum = end_.t + t;
  const double b = v.dot(sum);
  const double a = 4.0 - sum.squaredNorm();
  const double d = v.squaredNorm() / (b + std::sqrt(b * b + a * v.squaredNorm()));
  add_arc_to(0.5 * (end_.x + x + d * (end_.t - t)));
  add_arc_to(x);
}

const Centreline::Piece& Centreline::piece_at(double s) const
{
  ensure(!pieces_.empty(), "a centreline has a piece");
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double v, const Piece& p) { return v < p.s; });
  return after == pieces_.begin() ? *after : *std::prev(after);
}

CurvePoint Centreline::at(double s) const
{
  const Piece& piece = piece_at(s);
  return advanced(piece.start, piece.curvature, s - piece.s);
}

double Centreline::curvature(double s) const
{
  return piece_at(s).curvature.norm();
}

}  // namespace luff::grid
