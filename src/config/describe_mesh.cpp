// SPDX-License-Identifier: BSD-3-Clause
// Keys of a shell's or body's mesh, and of `where` on it.
#include "config/describe.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>

namespace luff::config {
namespace {

bool is_readable_mesh(const std::filesystem::path& file)
{
  std::string kind = file.extension();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* readable : {".stl", ".obj", ".ply", ".vtp", ".vtu", ".msh"})
    if (kind == readable)
      return true;
  return false;
}

void describe_parallelogram(Schema& s, MeshOptions& mesh)
{
  s.key("origin", mesh.origin, {.doc = "A corner.", .unit = "m", .required = true});
  s.key("a", mesh.a, {.doc = "First side, from the corner.", .unit = "m", .required = true});
  s.key("b", mesh.b,
        {.doc = "Second side, from the corner; the normal points along a x b.", .unit = "m", .required = true});
  s.rule(mesh.a.cross(mesh.b).norm() > 0.0, "b", "must not be parallel to `a`, and neither may be zero");
}

void describe_round(Schema& s, MeshOptions& mesh)
{
  s.key("centre", mesh.centre, {.doc = "Centre; of a cylinder, of its first end.", .unit = "m"});
  s.key("axis", mesh.axis,
        {.doc = "Direction of the axis, of any length. The normal of `disk` and `annulus` points along it, that of "
                "`cylinder` and `sphere-cap` away from axis or centre."});
  s.key("start", mesh.start,
        {.doc = "Direction of angle 0 about the axis; its part along the axis is of no account. Absent: x, or y where "
                "the axis is x."});
  s.key("radius", mesh.radius,
        {.doc = "Radius, of an annulus the outer one.", .unit = "m", .range = positive, .required = true});
  s.table("angle", mesh.angle, {.doc = "A sector about the axis. Absent: all round, closed without a seam."});
  s.rule(!mesh.axis.isZero(0.0), "axis", "must not be zero");
  s.rule(!mesh.start || mesh.start->cross(mesh.axis).norm() > 0.0, "start", "must not be zero or parallel to `axis`");
}

void describe_parts(Schema& s, MeshOptions& mesh)
{
  const bool rings = has_rings(mesh);
  s.when(mesh.shape && !rings, "`rectangle`, `annulus`, `cylinder`, or `sphere-cap` without a pole", [&] {
    s.key("divisions", mesh.divisions,
          {.doc = "Quadrilaterals along `a` and `b`; around, and inwards or along the axis. Two triangles each.",
           .range = at_least_one,
           .required = true,
           .scaling = Scaling::Count});
  });
  s.when(rings, "`disk`, or `sphere-cap` with a pole", [&] {
    s.key("rings", mesh.rings,
          {.doc = "Rings of triangles from the centre to the rim, from the pole to the edge or the other pole. As many "
                  "sectors as keep the triangles near-equilateral: six in a disk, four in a half or whole sphere.",
           .range = at_least_one,
           .required = true,
           .scaling = Scaling::Count});
  });
  s.key("pattern", mesh.pattern,
        {.doc = "`diagonal`: all quadrilaterals are cut the same way (with `rings`: the regular mesh); `alternating`: "
                "neighbours are cut the other way (not with `rings`); `irregular`: inner vertices are moved at random "
                "by up to 28 % of the spacing and joined by Delaunay's rule; `delaunay`: as many inner vertices "
                "anywhere, evenly spread by Lloyd's iteration. Boundary vertices stay where they are."});
  s.rule(!rings || mesh.pattern != MeshPattern::Alternating, "pattern", "must be another one with `rings`");
  const bool zone = mesh.shape == MeshShape::SphereCap && !rings;
  const bool parallelogram = mesh.shape == MeshShape::Rectangle;
  s.when(
      parallelogram || mesh.shape == MeshShape::Cylinder || zone,
      "`rectangle`, `cylinder`, or `sphere-cap` without a pole", [&] {
        s.key(
            "grading", mesh.grading,
            {.doc =
                 "Growth of the spacing along each of the `divisions`, from their start to their end, by a constant "
                 "factor from one to the next: 10 makes the last spacing ten times the first, 0.1 the first ten times "
                 "the last.",
             .range = positive});
        s.rule(mesh.pattern != MeshPattern::Delaunay || mesh.grading == std::array{1.0, 1.0}, "grading",
               "goes with every pattern but \"delaunay\", which spreads vertices evenly");
        s.rule(parallelogram || mesh.grading[0] == 1 || mesh.angle.to - mesh.angle.from < 360, "grading",
               "must begin with 1 around a whole circle, which has no ends");
      });
  s.when(mesh.pattern == MeshPattern::Irregular || mesh.pattern == MeshPattern::Delaunay,
         "`pattern = \"irregular\"` or `\"delaunay\"`", [&] {
           s.key("seed", mesh.seed,
                 {.doc = "Start of the random numbers: same seed, same mesh.", .range = not_negative});
         });
}

}  // namespace

void describe(Schema& s, MeshOptions& mesh)
{
  s.mark(mesh.mark);
  s.exactly_one_of({"shape", "file"});
  s.key("shape", mesh.shape,
        {.doc = "Make the mesh: `rectangle`, the parallelogram of `a` and `b` at `origin`; `disk`; `annulus`; "
                "`cylinder`, its lateral surface; `sphere-cap`, the zone of a sphere between two angles from its "
                "axis, up to the whole sphere."});
  s.when(mesh.shape == MeshShape::Rectangle, "`shape = \"rectangle\"`", [&] { describe_parallelogram(s, mesh); });
  s.when(mesh.shape && mesh.shape != MeshShape::Rectangle, "`disk`, `annulus`, `cylinder` or `sphere-cap`",
         [&] { describe_round(s, mesh); });
  s.when(mesh.shape == MeshShape::Annulus, "`shape = \"annulus\"`", [&] {
    s.key("inner_radius", mesh.inner_radius,
          {.doc = "Radius of the hole.", .unit = "m", .range = positive, .required = true});
    s.rule(mesh.inner_radius < mesh.radius, "inner_radius", "must be less than `radius`");
  });
  s.when(mesh.shape == MeshShape::Cylinder, "`shape = \"cylinder\"`", [&] {
    s.key("length", mesh.length, {.doc = "Length along the axis.", .unit = "m", .range = positive, .required = true});
  });
  s.when(mesh.shape == MeshShape::SphereCap, "`shape = \"sphere-cap\"`", [&] {
    s.table("polar", mesh.polar, {.doc = "The zone's edges. 0 to 180: the whole sphere.", .required = true});
  });
  s.when(mesh.shape.has_value(), "`shape`", [&] { describe_parts(s, mesh); });
  s.key("file", mesh.file, {.doc = "Read the mesh from an STL, OBJ, PLY, VTP, VTU or Gmsh (.msh) file."});
  s.rule(!mesh.file || is_readable_mesh(*mesh.file), "file", "must end in .stl, .obj, .ply, .vtp, .vtu or .msh");
  s.when(mesh.file.has_value(), "`file`", [&] {
    s.key("repair", mesh.repair,
          {.doc =
               "Unite vertices at the same place, drop unused vertices and repeated triangles, and turn triangles that "
               "face against their neighbours; the run tells how many. `false`: refuse such a mesh."});
  });
}

void describe(Schema& s, PolarOptions& polar)
{
  constexpr Range pole_to_pole{.low = 0.0, .high = 180.0};
  s.key("from", polar.from, {.doc = "Angle from the axis; 0 is the pole.", .unit = "degrees", .range = pole_to_pole});
  s.key("to", polar.to, {.doc = "Where it ends.", .unit = "degrees", .range = pole_to_pole, .required = true});
  s.rule(polar.from < polar.to, "to", "must be above `from`");
}

void describe(Schema& s, WhereOptions& where)
{
  s.exactly_one_of({"edge", "box", "plane", "point", "set", "all"});
  s.key("edge", where.edge, {.doc = "On the straight line between these two points.", .unit = "m"});
  s.key("box", where.box, {.doc = "In the box with this lowest and this highest corner.", .unit = "m"});
  s.table("plane", where.plane, {.doc = "On a plane."});
  s.key("point", where.point, {.doc = "The one vertex nearest to this point.", .unit = "m"});
  s.key("set", where.set,
        {.doc = "The members of this set of the mesh: an edge of a made mesh, or a set of a VTP, VTU or Gmsh file."});
  s.key("all", where.all, {.doc = "`true`: everywhere."});
  if (where.box)
    s.rule(((*where.box)[0].array() <= (*where.box)[1].array()).all(), "box",
           "must be [lowest corner, highest corner]");
  if (where.all)
    s.rule(*where.all, "all", "must be true");
  if (where.edge)
    s.rule((*where.edge)[0] != (*where.edge)[1], "edge", "must have two different end points");
}

void describe(Schema& s, PlaneOptions& plane)
{
  s.key("point", plane.point, {.doc = "A point of the plane.", .unit = "m", .required = true});
  s.key("normal", plane.normal, {.doc = "Its normal, of any length.", .required = true});
  s.rule(!plane.normal.isZero(0.0), "normal", "must not be zero");
}

}  // namespace luff::config
