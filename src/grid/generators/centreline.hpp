// SPDX-License-Identifier: BSD-3-Clause
// Curves in space along which pipes are drawn.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace luff::grid {

/// A point of a curve with a right-handed orthonormal frame (e1, e2, t), t along the curve.
struct CurvePoint {
  Vec3 x = Vec3::Zero();  ///< [L]
  Vec3 e1 = Vec3::UnitX();
  Vec3 e2 = Vec3::UnitY();
  Vec3 t = Vec3::UnitZ();
};

/// The frame at `x` along `direction` (of any length but zero) whose e1 lies nearest to the coordinate axis that is
/// most across.
[[nodiscard]] CurvePoint frame_along(const Vec3& x, const Vec3& direction);

/// A chain of straight pieces and arcs of circles, each of which begins in the direction where the last one ends.  The
/// frame does not turn about the tangent (Bishop's frame) [bishop_1975_there]:
///
///   dt/ds = k1 e1 + k2 e2,   de1/ds = -k1 t,   de2/ds = -k2 t,
///
/// k1 and k2 constant along a piece, so that points and frames are exact.
class Centreline {
 public:
  explicit Centreline(const CurvePoint& start) : end_(start) {}

  /// Through points, at least two [L]: a cubic spline by chord length (of lower degree for two or three points), which
  /// pairs of arcs follow that share its points and tangents; 32 pairs between two points.  Throws InputError, naming
  /// the points by number, when two neighbours coincide.
  [[nodiscard]] static Centreline through(const std::vector<Vec3>& points);

  /// Adds a piece of this length [L] with curvature (k1, k2) [1/L] in its own frame.
  void add(double length, const Eigen::Vector2d& curvature);
  void add_straight(double length) { add(length, Eigen::Vector2d::Zero()); }
  /// Adds an arc of a circle [L, radians] that turns towards a direction, of which only the part across the tangent
  /// counts.  Throws InputError when there is none.
  void add_bend(double radius, double angle, const Vec3& towards);

  [[nodiscard]] double length() const { return length_; }
  /// At arc length 0 <= s <= length() from the start.
  [[nodiscard]] CurvePoint at(double s) const;
  /// Curvature [1/L] at s; where pieces meet, that of the next one.
  [[nodiscard]] double curvature(double s) const;

 private:
  struct Piece {
    double s = 0.0;  ///< where it begins
    CurvePoint start;
    Eigen::Vector2d curvature = Eigen::Vector2d::Zero();
  };
  [[nodiscard]] const Piece& piece_at(double s) const;
  void add_arc_to(const Vec3& x);
  void add_biarc(const Vec3& x, const Vec3& t);

  std::vector<Piece> pieces_;
  CurvePoint end_;
  double length_ = 0.0;
};

}  // namespace luff::grid
