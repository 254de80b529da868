// SPDX-License-Identifier: BSD-3-Clause
// Keys of [[shell]] and [[body]].
#include "config/describe.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>

namespace luff::config {
namespace {

constexpr auto surface_name =
    "Its name in messages and in the names of output files; no two shells or bodies share one.";

}  // namespace

void describe_name(Schema& s, std::string& name, std::string_view doc)
{
  s.key("name", name, {.doc = doc, .required = true});
  const bool fit = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  });
  s.rule(fit, "name", "must be made of letters, digits, '-' and '_': files are named after it");
}

namespace {

void describe_placement(Schema& s, PlacementOptions& placement)
{
  s.key("scale", placement.scale, {.doc = "Factor on the mesh's coordinates; applied first.", .range = positive});
  s.table("rotate", placement.rotate, {.doc = "Rotation of the mesh; applied after `scale`."});
  s.key("translate", placement.translate, {.doc = "Translation of the mesh; applied last.", .unit = "m"});
}

}  // namespace

void describe(Schema& s, ShellOptions& shell)
{
  s.mark(shell.mark);
  describe_name(s, shell.name, surface_name);
  s.table("mesh", shell.mesh, {.doc = "Triangles of the middle surface, free of stress as placed.", .required = true});
  describe_placement(s, shell.placement);
  s.key("thickness", shell.thickness, {.doc = "Thickness.", .unit = "m", .range = positive, .required = true});
  s.key("density", shell.density,
        {.doc = "Density of the material.", .unit = "kg/m^3", .range = positive, .required = true});
  s.table("material", shell.material, {.doc = "Law of stress and strain.", .required = true});
  s.key("bending", shell.bending,
        {.doc = "How curvature is found: `qavg`, slopes averaged over the edges, right on every mesh; `patch4`, the "
                "quadratic of four triangles, and `hinge`, angles between triangles, are for comparison and right on "
                "`diagonal` meshes only."});
  s.key("mass", shell.mass,
        {.doc = "Mass matrix: `consistent` with the element, or `lumped`, a third of each triangle's at each corner: "
                "less accurate."});
  s.key("membrane", shell.membrane,
        {.doc = "How the strain in the surface is found: `cst`, constant in a triangle, or `smoothed`, averaged over "
                "pairs of triangles, which is far better where the surface bends in its own plane."});
  s.key(
      "wetted", shell.wetted,
      {.doc = "What the flow sees: `middle`, the middle surface, a sheet without thickness; or `faces`, two faces half "
              "the thickness off it and a rim around them, for shells thicker than two cells or so."});
  s.table("damping", shell.damping, {.doc = "Rayleigh damping."});
  s.key("gravity", shell.gravity, {.doc = "Acceleration of gravity acting on the shell.", .unit = "m/s^2"});
  s.list("support", shell.supports, {.doc = "Vertices that are held; edges without support are free."});
  s.list("load", shell.loads, {.doc = "Loads besides gravity and the flow's."});
}

void describe(Schema& s, RotateOptions& rotate)
{
  s.key("axis", rotate.axis, {.doc = "Direction of the axis, of any length.", .required = true});
  s.key("angle", rotate.angle, {.doc = "Angle, right-handed about the axis.", .unit = "degrees", .required = true});
  s.key("about", rotate.about, {.doc = "A point on the axis.", .unit = "m"});
  s.rule(!rotate.axis.isZero(0.0), "axis", "must not be zero");
}

void describe(Schema& s, DampingOptions& damping)
{
  s.key("mass", damping.mass,
        {.doc = "Factor f_m of the mass matrix in C = f_m M + f_k K.", .unit = "1/s", .range = not_negative});
  s.key("stiffness", damping.stiffness,
        {.doc = "Factor f_k of the stiffness matrix.", .unit = "s", .range = not_negative});
}

void describe(Schema& s, SupportOptions& support)
{
  s.mark(support.mark);
  s.table("where", support.where, {.doc = "The vertices held.", .required = true});
  s.exactly_one_of({"type", "fixed"});
  s.key("type", support.type,
        {.doc = "`clamped`: neither moves nor turns; `hinged`: does not move; `symmetry`: stays in the plane of "
                "symmetry, of any direction, and normal to it; `elastic`: moves and turns against springs."});
  s.key("fixed", support.fixed, {.doc = "Components of the displacement that are zero, or those of `motion`."});
  const bool is_elastic = support.type == SupportType::Elastic;
  s.when(is_elastic, "`type = \"elastic\"`", [&] {
    s.key("stiffness", support.stiffness,
          {.doc = "Of the springs along x, y and z, of all vertices together: shared by the length of the boundary "
                  "edges between them, or equally.",
           .unit = "N/m"});
    s.key("turning_stiffness", support.turning_stiffness,
          {.doc = "Moment per length of boundary edge and angle by which it turns about its direction.",
           .unit = "N/rad",
           .range = not_negative});
    s.rule((support.stiffness.array() >= 0.0).all(), "stiffness", "must be three numbers >= 0");
    s.rule(!is_elastic || !support.stiffness.isZero(0.0) || support.turning_stiffness > 0.0, "stiffness",
           "or turning_stiffness must be greater than 0");
  });
  s.when(support.type != SupportType::Symmetry && !is_elastic, "a clamped, hinged or fixed support", [&] {
    s.table(
        "motion", support.motion,
        {.doc = "Where the support takes what it holds; a clamped edge turns with the rotation. Absent: it rests."});
  });
}

void describe(Schema& s, SupportMotionOptions& motion)
{
  s.key("translation", motion.translation,
        {.doc = "Displacement, zero at t = 0; applied after the rotation, and turns nothing. In a static analysis it "
                "grows in proportion to what it is at t = 1.",
         .unit = "m"});
  s.table("rotation", motion.rotation, {.doc = "Rotation about a fixed axis, likewise."});
}

void describe(Schema& s, LoadOptions& load)
{
  s.mark(load.mark);
  s.table("where", load.where,
          {.doc = "The vertices loaded; `pressure` and `traction` act on triangles with all corners among them, "
                  "`edge_force` and `edge_moment` on boundary edges with both ends among them.",
           .required = true});
  s.exactly_one_of({"force", "pressure", "traction", "edge_force", "edge_moment"});
  s.key("force", load.force, {.doc = "Total force, shared by the vertices; keeps its direction.", .unit = "N"});
  s.key("pressure", load.pressure,
        {.doc = "Force per area along the normal (a x b of a rectangle); follows the surface.", .unit = "Pa"});
  s.key("traction", load.traction,
        {.doc = "Force per area of the reference configuration; keeps its direction.", .unit = "Pa"});
  s.key("edge_force", load.edge_force,
        {.doc = "Force per length of boundary edges of the reference configuration; keeps its direction.",
         .unit = "N/m"});
  s.key("edge_moment", load.edge_moment,
        {.doc = "Moment per length of boundary edges about the direction that each has in the reference "
                "configuration; raises the edge towards the normal and turns with it.",
         .unit = "N"});
}

void describe(Schema& s, BodyOptions& body)
{
  s.mark(body.mark);
  describe_name(s, body.name, surface_name);
  s.table("mesh", body.mesh,
          {.doc = "Triangles of a thin rigid sheet, or of the surface of a closed body.", .required = true});
  describe_placement(s, body.placement);
  s.key("closed", body.closed,
        {.doc = "Whether there is no fluid inside. The mesh may then have edges only on `symmetry`, `slip` and "
                "`periodic` sides of the grid. Absent: true for a mesh without edges, false for others."});
  s.table("motion", body.motion, {.doc = "How it moves from where it is placed. Absent: it doesn't."});
}

namespace {

void describe_free_motion(Schema& s, MotionOptions& motion)
{
  const bool free = motion.type == MotionType::Free;
  s.key("density", motion.density,
        {.doc = "Of a closed body: gives mass, centre and inertia.", .unit = "kg/m^3", .range = positive});
  s.key("mass", motion.mass, {.doc = "Mass, instead of `density`.", .unit = "kg", .range = positive});
  s.rule(!free || motion.density.has_value() != motion.mass.has_value(), "mass",
         "must be given, or else `density`, not both");
  s.key("centre", motion.centre,
        {.doc = "Centre of mass, as placed. Absent: that of the volume of a closed body.", .unit = "m"});
  s.key("inertia", motion.inertia,
        {.doc = "Moments of inertia about the axes of space through the centre, as placed. Absent: those of a closed "
                "body of even density.",
         .unit = "kg m^2"});
  s.rule(!motion.inertia || (motion.inertia->array() > 0.0).all(), "inertia", "must be three numbers > 0");
  s.key("freedoms", motion.freedoms,
        {.doc = "Which of its six degrees of freedom it has: displacement of its centre along, turns about the axes of "
                "space. The others are held. A part of the turns makes sense if one is left, or all."});
  s.rule(!free || !motion.freedoms.empty(), "freedoms", "must not be empty");
  s.key("stiffness", motion.stiffness,
        {.doc = "Of springs along x, y and z, at rest where it is placed.", .unit = "N/m"});
  s.key("damping", motion.damping, {.doc = "Of dampers along x, y and z.", .unit = "N s/m"});
  s.key("turning_stiffness", motion.turning_stiffness,
        {.doc = "Of springs about x, y and z: moment per component of the rotation vector.", .unit = "N m/rad"});
  s.key("turning_damping", motion.turning_damping, {.doc = "Of dampers about x, y and z.", .unit = "N m s/rad"});
  for (const auto& [key, value] :
       {std::pair("stiffness", motion.stiffness), std::pair("damping", motion.damping),
        std::pair("turning_stiffness", motion.turning_stiffness), std::pair("turning_damping", motion.turning_damping)})
    s.rule((value.array() >= 0.0).all(), key, "must be three numbers >= 0");
  s.key("gravity", motion.gravity,
        {.doc = "Acts on its mass. Buoyancy comes from the pressure, when `fluid.body_force` has gravity too.",
         .unit = "m/s^2"});
  s.key("velocity", motion.velocity, {.doc = "Of the centre at t = 0.", .unit = "m/s"});
  s.key("spin", motion.spin, {.doc = "Angular velocity at t = 0.", .unit = "rad/s"});
}

}  // namespace

void describe(Schema& s, MotionOptions& motion)
{
  s.key(
      "type", motion.type,
      {.doc = "`fixed`; `prescribed` by the keys below; or `free`, moved by the flow, gravity, springs and dampers."});
  s.when(motion.type == MotionType::Prescribed, "`type = \"prescribed\"`", [&] {
    s.key("translation", motion.translation,
          {.doc = "Displacement, of t; applied after the rotation.", .unit = "m", .time_only = true});
    s.table("rotation", motion.rotation, {.doc = "Rotation about a fixed axis."});
  });
  s.when(motion.type == MotionType::Free, "`type = \"free\"`", [&] { describe_free_motion(s, motion); });
}

void describe(Schema& s, RotationOptions& rotation)
{
  s.key("axis", rotation.axis, {.doc = "Direction of the axis, of any length.", .required = true});
  s.key("about", rotation.about, {.doc = "A point on the axis.", .unit = "m"});
  s.key("angle", rotation.angle,
        {.doc = "Angle, of t, right-handed about the axis.", .unit = "degrees", .required = true, .time_only = true});
  s.rule(!rotation.axis.isZero(0.0), "axis", "must not be zero");
}

}  // namespace luff::config
