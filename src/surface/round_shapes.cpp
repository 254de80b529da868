// SPDX-License-Identifier: BSD-3-Clause
// Disks, annuli, cylinders and zones of spheres.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/round_shapes.hpp"

namespace luff::surface {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double quarter_turn = 0.5 * std::numbers::pi;

void check_length(std::string_view shape, std::string_view name, double value)
{
  if (!(value > 0) || !std::isfinite(value))
    fail_input("{}: {} = {} must be a number > 0", shape, name, value);
}

/// Right-handed: z along the frame's axis, x towards angle 0.
struct Axes {
  Vec3 x, y, z;

  /// Unit vector normal to z.
  Vec3 radial(double angle) const { return std::cos(angle) * x + std::sin(angle) * y; }
};

Axes axes_of(std::string_view shape, const Frame& frame)
{
  constexpr double smallest_sine = 1e-6;
  if (!frame.centre.allFinite())
    fail_input("{}: centre must be three finite numbers", shape);
  if (!frame.axis.allFinite() || !(frame.axis.norm() > 0))
    fail_input("{}: axis = [{}, {}, {}] must have a length", shape, frame.axis.x(), frame.axis.y(), frame.axis.z());
  const Vec3 z = frame.axis.normalized();
  const bool along_x = z.cross(Vec3::UnitX()).norm() < smallest_sine;
  const Vec3 start = frame.start.value_or(along_x ? Vec3::UnitY() : Vec3::UnitX());
  const Vec3 x = start - start.dot(z) * z;
  if (!start.allFinite() || !(x.norm() > smallest_sine * start.norm()))
    fail_input("{}: start = [{}, {}, {}] must have a length and not be parallel to the axis", shape, start.x(),
               start.y(), start.z());
  return {x.normalized(), z.cross(x).normalized(), z};
}

/// Angle [rad] at a fraction of a sector.
double along(const Sector& sector, double fraction)
{
  return (sector.from + (sector.to - sector.from) * fraction) * degree;
}

Around around(std::string_view shape, const Sector& angle)
{
  constexpr double turn = 360;
  constexpr double round_off = 1e-12;
  const double extent = angle.to - angle.from;
  if (!(extent > 0) || !(extent <= turn * (1 + round_off)))
    fail_input("{}: angle from {} to {} degrees must increase, by 360 at most", shape, angle.from, angle.to);
  return extent < turn * (1 - round_off) ? Around::Open : Around::Closed;
}

/// Rows and columns about an axis; u counts around.
Layout round_grid(std::string_view shape, const std::array<int, 2>& divisions, const Sector& angle, Pattern pattern)
{
  check_divisions(shape, divisions);
  const Around kind = around(shape, angle);
  if (kind == Around::Closed && divisions[0] < 3)
    fail_input("{}: divisions = [{}, {}] must have at least 3 around a whole circle", shape, divisions[0],
               divisions[1]);
  if (kind == Around::Closed && pattern == Pattern::Alternating && divisions[0] % 2 != 0)
    fail_input("{}: divisions = [{}, {}] must have an even number around a whole circle for the alternating pattern",
               shape, divisions[0], divisions[1]);
  return grid_layout(divisions, kind);
}

/// Rings about a pole out to the angle `opening` [rad], 0 for a flat disk. The sectors are as many as make the
/// intervals of the longest ring nearest to the distance between rings: six in a disk, four in a hemisphere.
Layout round_fan(std::string_view shape, int rings, const Sector& angle, double opening)
{
  check_divisions(shape, {rings, rings});
  const Around kind = around(shape, angle);
  const double to_longest = std::min(opening, quarter_turn);
  const double widening = to_longest > 0 ? std::sin(to_longest) / to_longest : 1;
  const long sectors = std::lround((angle.to - angle.from) * degree * widening);
  const long to_far_pole = opening > quarter_turn ? std::lround(rings * 2 * quarter_turn / opening) : 2L * rings;
  const bool reaches_far_pole = opening >= 2 * quarter_turn;
  if (reaches_far_pole && rings < 2)
    fail_input("{}: rings = {} must be at least 2 from pole to pole", shape, rings);
  return fan_layout({.rings = rings,
                     .rings_to_far_pole = reaches_far_pole ? rings : std::max(static_cast<int>(to_far_pole), rings + 1),
                     .sectors = std::max(static_cast<int>(sectors), kind == Around::Closed ? 3 : 1),
                     .around = kind});
}

/// Points of a sphere by their direction from its centre.
ParametricSurface sphere(const Vec3& centre, double radius, std::function<Vec3(double, double)> direction)
{
  return {[=](double u, double v) -> Vec3 { return centre + radius * direction(u, v); },
          [=](const Vec3& x) -> Vec3 { return centre + radius * (x - centre).normalized(); },
          [=](const Vec3& x) -> Vec3 { return x - centre; }};
}

MarkedMesh triangulated(const Layout& layout, const ParametricSurface& surface, const auto& shape,
                        std::string_view name, const SideNames& sides)
{
  return triangulate(layout, surface, {shape.pattern, shape.displacement, shape.seed}, name, sides);
}

/// u counts around, v from `v_min` to `v_max`.
SideNames around_and(std::string v_min, std::string v_max)
{
  return {{"u_min", "angle_min"}, {"u_max", "angle_max"}, {"v_min", std::move(v_min)}, {"v_max", std::move(v_max)}};
}

void check(const SphereCap& shape)
{
  check_length("sphere-cap", "radius", shape.radius);
  if (!(shape.polar.from >= 0 && shape.polar.from < shape.polar.to && shape.polar.to <= 180))
    fail_input("sphere-cap: polar from {} to {} degrees must increase between 0 and 180", shape.polar.from,
               shape.polar.to);
}

MarkedMesh zone_with_pole(const SphereCap& shape)
{
  Axes axes = axes_of("sphere-cap", shape.frame);
  Sector angle = shape.angle;
  double opening = shape.polar.to * degree;
  SideNames sides = {{"u_min", "polar_min"}, {"u_max", "polar_max"}, {"v_min", "angle_min"}, {"v_max", "angle_max"}};
  if (shape.polar.from > 0) {  // The other pole: half a turn about x puts it first.
    axes = {axes.x, -axes.y, -axes.z};
    angle = {-shape.angle.to, -shape.angle.from};
    opening = (180 - shape.polar.from) * degree;
    sides = {{"u_min", "polar_max"}, {"u_max", "polar_min"}, {"v_min", "angle_max"}, {"v_max", "angle_min"}};
  }
  const auto direction = [&](double u, double v) -> Vec3 {
    const double polar = opening * u / shape.rings;
    // The pole is one point whatever v.
    return u > 0 ? Vec3(std::cos(polar) * axes.z + std::sin(polar) * axes.radial(along(angle, v))) : axes.z;
  };
  return triangulated(round_fan("sphere-cap", shape.rings, angle, opening),
                      sphere(shape.frame.centre, shape.radius, direction), shape, "sphere-cap", sides);
}

void check_round_grading(std::string_view name, const auto& shape)
{
  check_grading(name, shape.grading, shape.pattern);
  if (shape.grading[0] != 1 && around(name, shape.angle) == Around::Closed)
    fail_input("{}: grading = [{}, {}] around a whole circle, which has no ends, must be 1", name, shape.grading[0],
               shape.grading[1]);
}

MarkedMesh zone_without_pole(const SphereCap& shape)
{
  check_round_grading("sphere-cap", shape);
  const Axes axes = axes_of("sphere-cap", shape.frame);
  // Rows from the far edge to the near one: so the normal points outwards.
  const auto direction = [&](double u, double v) -> Vec3 {
    const double polar = along(shape.polar, 1 - graded(v / shape.divisions[1], shape.grading[1]));
    const double angle = along(shape.angle, graded(u / shape.divisions[0], shape.grading[0]));
    return std::cos(polar) * axes.z + std::sin(polar) * axes.radial(angle);
  };
  return triangulated(round_grid("sphere-cap", shape.divisions, shape.angle, shape.pattern),
                      sphere(shape.frame.centre, shape.radius, direction), shape, "sphere-cap",
                      around_and("polar_max", "polar_min"));
}

}  // namespace

MarkedMesh made(const Disk& shape)
{
  check_length("disk", "radius", shape.radius);
  const Axes axes = axes_of("disk", shape.frame);
  const auto point = [&](double u, double v) -> Vec3 {
    return shape.frame.centre + u / shape.rings * shape.radius * axes.radial(along(shape.angle, v));
  };
  return triangulated(
      round_fan("disk", shape.rings, shape.angle, 0), plane(point, shape.frame.centre, axes.z), shape, "disk",
      {{"u_min", "radius_min"}, {"u_max", "radius_max"}, {"v_min", "angle_min"}, {"v_max", "angle_max"}});
}

MarkedMesh made(const Annulus& shape)
{
  check_length("annulus", "inner_radius", shape.inner_radius);
  check_length("annulus", "radius", shape.radius);
  if (!(shape.inner_radius < shape.radius))
    fail_input("annulus: inner_radius = {} must be below radius = {}", shape.inner_radius, shape.radius);
  const Axes axes = axes_of("annulus", shape.frame);
  // Rows from the outer edge to the inner one: so the normal points along the axis.
  const auto point = [&](double u, double v) -> Vec3 {
    const double r = shape.radius + (shape.inner_radius - shape.radius) * v / shape.divisions[1];
    return shape.frame.centre + r * axes.radial(along(shape.angle, u / shape.divisions[0]));
  };
  return triangulated(round_grid("annulus", shape.divisions, shape.angle, shape.pattern),
                      plane(point, shape.frame.centre, axes.z), shape, "annulus",
                      around_and("radius_max", "radius_min"));
}

MarkedMesh made(const Cylinder& shape)
{
  check_length("cylinder", "radius", shape.radius);
  check_length("cylinder", "length", shape.length);
  check_round_grading("cylinder", shape);
  const Axes axes = axes_of("cylinder", shape.frame);
  const Vec3& centre = shape.frame.centre;
  const auto outwards = [&](const Vec3& x) -> Vec3 { return x - centre - axes.z.dot(x - centre) * axes.z; };
  const ParametricSurface surface{
      [&](double u, double v) -> Vec3 {
        return centre +
               shape.radius * axes.radial(along(shape.angle, graded(u / shape.divisions[0], shape.grading[0]))) +
               graded(v / shape.divisions[1], shape.grading[1]) * shape.length * axes.z;
      },
      [&](const Vec3& x) -> Vec3 { return x + (shape.radius / outwards(x).norm() - 1) * outwards(x); }, outwards};
  return triangulated(round_grid("cylinder", shape.divisions, shape.angle, shape.pattern), surface, shape, "cylinder",
                      around_and("length_min", "length_max"));
}

bool has_pole(const SphereCap& shape)
{
  return shape.polar.from <= 0 || shape.polar.to >= 180;
}

MarkedMesh made(const SphereCap& shape)
{
  check(shape);
  return has_pole(shape) ? zone_with_pole(shape) : zone_without_pole(shape);
}

}  // namespace luff::surface
