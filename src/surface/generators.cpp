// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made from a few numbers.
#include "surface/generators.hpp"

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/round_shapes.hpp"

namespace luff::surface {

namespace {

void check(const Rectangle& shape)
{
  check_divisions("rectangle", shape.divisions);
  check_grading("rectangle", shape.grading, shape.pattern);
  if (!shape.origin.allFinite() || !shape.a.allFinite() || !shape.b.allFinite())
    fail_input("rectangle: origin, a and b must be finite numbers");
  // Below this sine of the angle between the sides the triangles have no usable area.
  constexpr double smallest_sine = 1e-6;
  if (!(shape.a.cross(shape.b).norm() > smallest_sine * shape.a.norm() * shape.b.norm()))
    fail_input("rectangle: sides a = [{}, {}, {}] and b = [{}, {}, {}] must be longer than zero and not parallel",
               shape.a.x(), shape.a.y(), shape.a.z(), shape.b.x(), shape.b.y(), shape.b.z());
}

MarkedMesh made(const Rectangle& shape)
{
  check(shape);
  const auto point = [&](double u, double v) -> Vec3 {
    return shape.origin + graded(u / shape.divisions[0], shape.grading[0]) * shape.a +
           graded(v / shape.divisions[1], shape.grading[1]) * shape.b;
  };
  return triangulate(grid_layout(shape.divisions, Around::Open), plane(point, shape.origin, shape.a.cross(shape.b)),
                     {shape.pattern, shape.displacement, shape.seed}, "rectangle",
                     {{"u_min", "a_min"}, {"u_max", "a_max"}, {"v_min", "b_min"}, {"v_max", "b_max"}});
}

}  // namespace

MarkedMesh make(const Shape& shape)
{
  return std::visit([](const auto& s) { return made(s); }, shape);
}

TriangleMesh rectangle(const Rectangle& shape)
{
  return make(shape).mesh;
}

TriangleMesh disk(const Disk& shape)
{
  return make(shape).mesh;
}

TriangleMesh annulus(const Annulus& shape)
{
  return make(shape).mesh;
}

TriangleMesh cylinder(const Cylinder& shape)
{
  return make(shape).mesh;
}

TriangleMesh sphere_cap(const SphereCap& shape)
{
  return make(shape).mesh;
}

}  // namespace luff::surface
