// SPDX-License-Identifier: BSD-3-Clause
// The options of a case, as plain data. Each key's meaning, unit, range and rules are stated once, in describe_*.cpp.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/expression.hpp"
#include "config/grid_options.hpp"
#include "config/mark.hpp"
#include "core/vec3.hpp"

namespace luff::config {

// ---- time, fluid, grid and its boundary ------------------------------------------------------------------------

enum class TimeScheme { Rk3, NewtonKrylov };

/// [time]; not used by a static analysis.
struct TimeOptions {
  double end = 0.0;
  double step = 0.0;          ///< with cfl: the largest step
  std::optional<double> cfl;  ///< max over cells of sum_d |U_d| dt / h_d
  TimeScheme scheme = TimeScheme::Rk3;

  bool operator==(const TimeOptions&) const = default;
};

struct InitialOptions {
  VectorExpression velocity;
  Mark mark = {};

  bool operator==(const InitialOptions&) const = default;
};

/// [fluid]
struct FluidOptions {
  double density = 0.0;
  double viscosity = 0.0;       ///< dynamic
  VectorExpression body_force;  ///< per volume
  InitialOptions initial;

  bool operator==(const FluidOptions&) const = default;
};

enum class SideType { Velocity, Wall, Slip, Symmetry, Periodic, Outflow, Pressure };
enum class InflowShape { Plug, Parabolic, Womersley };
enum class EnteringFluid { Reservoir, Developed };

struct SideOptions {
  SideType type = SideType::Wall;
  std::optional<VectorExpression> value;              ///< velocity of the fluid (Velocity) or of the wall (Wall)
  std::optional<Expression> flow_rate;                ///< Velocity, instead of `value`: volume per time into the domain
  InflowShape profile = InflowShape::Plug;            ///< of flow_rate
  double period = 0.0;                                ///< of flow_rate with profile Womersley
  Expression pressure;                                ///< Pressure
  EnteringFluid entering = EnteringFluid::Reservoir;  ///< Pressure

  bool operator==(const SideOptions&) const = default;
};

/// The side at the low and the high end of each axis.
inline constexpr std::array<const char*, 6> side_names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
/// The same of a curvilinear grid.
inline constexpr std::array<const char*, 6> curvilinear_side_names{"xi_min",  "xi_max",   "eta_min",
                                                                   "eta_max", "zeta_min", "zeta_max"};

/// [boundary]; only with a fluid. Periodic sides come in pairs.
struct BoundaryOptions {
  std::array<SideOptions, 6> sides;  ///< in the order of names()
  bool curvilinear = false;          ///< as the grid is
  Mark mark = {};

  [[nodiscard]] const std::array<const char*, 6>& names() const
  {
    return curvilinear ? curvilinear_side_names : side_names;
  }
  bool operator==(const BoundaryOptions&) const = default;
};

// ---- shells and bodies -----------------------------------------------------------------------------------------

enum class MeshShape { Rectangle, Disk, Annulus, Cylinder, SphereCap };
enum class MeshPattern { Diagonal, Alternating, Irregular, Delaunay };

/// Part of a half-circle from pole to pole, degrees from the axis.
struct PolarOptions {
  double from = 0.0;
  double to = 90.0;

  bool operator==(const PolarOptions&) const = default;
};

/// A surface made from a few numbers (see surface/generators.hpp), or the triangles of a file: exactly one of `shape`
/// and `file`.
struct MeshOptions {
  std::optional<MeshShape> shape;
  Vec3 origin = Vec3::Zero();  ///< Rectangle: parallelogram origin + s a + t b, 0 <= s, t <= 1
  Vec3 a = Vec3::Zero();
  Vec3 b = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< the other shapes
  Vec3 axis = Vec3::UnitZ();
  std::optional<Vec3> start;  ///< where angles about the axis start
  double radius = 0.0;
  double inner_radius = 0.0;  ///< Annulus
  double length = 0.0;        ///< Cylinder
  AngleOptions angle;
  PolarOptions polar;                   ///< SphereCap
  std::array<int, 2> divisions{0, 0};   ///< along a and b; around and across
  std::array<double, 2> grading{1, 1};  ///< Rectangle, Cylinder, SphereCap: growth of the spacing along each
  int rings = 0;                        ///< Disk, SphereCap with a pole
  MeshPattern pattern = MeshPattern::Diagonal;
  int seed = 1;

  std::optional<std::filesystem::path> file;  ///< absolute once read
  bool repair = true;                         ///< of what is read
  Mark mark = {};

  bool operator==(const MeshOptions&) const = default;
};

/// Made of rings about a pole, not of rows and columns.
inline bool has_rings(const MeshOptions& mesh)
{
  return mesh.shape == MeshShape::Disk ||
         (mesh.shape == MeshShape::SphereCap && (mesh.polar.from <= 0.0 || mesh.polar.to >= 180.0));
}

struct RotateOptions {
  Vec3 axis = Vec3::Zero();
  double angle = 0.0;  ///< degrees, right-handed about the axis
  Vec3 about = Vec3::Zero();

  bool operator==(const RotateOptions&) const = default;
};

/// Where a mesh is put: x = R(scale X - about) + about + translate.
struct PlacementOptions {
  double scale = 1.0;
  std::optional<RotateOptions> rotate;
  Vec3 translate = Vec3::Zero();

  bool operator==(const PlacementOptions&) const = default;
};

enum class MaterialModel {
  SaintVenantKirchhoff,
  Hencky,
  NeoHookean,
  MayNewmanYin,
  LeeSacks,
  Fung,
  HolzapfelGasserOgden
};

/// Around an axis.
struct CircumferenceOptions {
  Vec3 axis = Vec3::Zero();
  Vec3 through = Vec3::Zero();

  bool operator==(const CircumferenceOptions&) const = default;
};

/// Direction of the fibres in space, where the mesh is put: exactly one of the three.
struct FibreOptions {
  std::optional<Vec3> direction;
  std::optional<CircumferenceOptions> circumference;
  std::optional<std::string> field;  ///< array of the mesh file, one vector per triangle; turned with the mesh
  Mark mark = {};

  bool operator==(const FibreOptions&) const = default;
};

/// Each model uses some of the constants; formulas: docs/numerics/materials.md.
struct MaterialOptions {
  MaterialModel model = MaterialModel::SaintVenantKirchhoff;
  double young = 0.0;
  double poisson = 0.0;
  double shear_modulus = 0.0;
  double c0 = 0.0;
  double c1 = 0.0;
  double c2 = 0.0;
  double c10 = 0.0;
  double c3 = 0.0;
  double weight = 0.0;
  bool tension_only = false;
  double c = 0.0;  ///< Fung's, with its exponents a11 ... a23
  double a11 = 0.0;
  double a22 = 0.0;
  double a33 = 0.0;
  double a12 = 0.0;
  double a13 = 0.0;
  double a23 = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double dispersion = 0.0;
  double angle = 0.0;  ///< degrees, between each family and the fibre
  double largest_exponent = 10.0;
  std::optional<int> thickness_points = std::nullopt;  ///< none: what the model recommends
  std::optional<FibreOptions> fibre = std::nullopt;

  bool operator==(const MaterialOptions&) const = default;
};

/// Rayleigh damping C = mass M + stiffness K.
struct DampingOptions {
  double mass = 0.0;
  double stiffness = 0.0;

  bool operator==(const DampingOptions&) const = default;
};

struct PlaneOptions {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();

  bool operator==(const PlaneOptions&) const = default;
};

/// Vertices of a shell chosen by their place in the reference configuration or by name: exactly one of the six.
struct WhereOptions {
  std::optional<std::array<Vec3, 2>> edge;  ///< on the line between two points
  std::optional<std::array<Vec3, 2>> box;   ///< lowest and highest corner
  std::optional<PlaneOptions> plane;
  std::optional<Vec3> point;       ///< the nearest vertex
  std::optional<std::string> set;  ///< of the mesh
  std::optional<bool> all;         ///< true

  bool operator==(const WhereOptions&) const = default;
};

struct RotationOptions {
  Vec3 axis = Vec3::Zero();
  Vec3 about = Vec3::Zero();
  Expression angle;  ///< degrees, of t

  bool operator==(const RotationOptions&) const = default;
};

/// Where a support goes: rotation about a fixed axis, then translation.
struct SupportMotionOptions {
  VectorExpression translation;  ///< of place in the reference configuration and t
  std::optional<RotationOptions> rotation;

  bool operator==(const SupportMotionOptions&) const = default;
};

enum class SupportType { Clamped, Hinged, Symmetry, Elastic };
enum class Component { X, Y, Z };

/// [[shell.support]]: exactly one of `type` and `fixed`.
struct SupportOptions {
  WhereOptions where;
  std::optional<SupportType> type;
  std::optional<std::vector<Component>> fixed;  ///< displacement components held
  Vec3 stiffness = Vec3::Zero();                ///< of an elastic support along x, y, z, in all
  double turning_stiffness = 0.0;               ///< of an elastic support, per length of edge
  std::optional<SupportMotionOptions> motion;   ///< none: at rest
  Mark mark = {};

  bool operator==(const SupportOptions&) const = default;
};

/// [[shell.load]]: exactly one of the five.
struct LoadOptions {
  WhereOptions where;
  std::optional<VectorExpression> force;       ///< total, shared by the vertices
  std::optional<Expression> pressure;          ///< follower, per current area, along the normal
  std::optional<VectorExpression> traction;    ///< dead, per reference area
  std::optional<VectorExpression> edge_force;  ///< dead, per reference length of boundary edges
  std::optional<Expression> edge_moment;       ///< follower, per reference length of boundary edges
  Mark mark = {};

  bool operator==(const LoadOptions&) const = default;
};

enum class BendingElement { Qavg, Patch4, Hinge };
enum class MembraneElement { Cst, Smoothed };

enum class MassMatrix { Consistent, Lumped };

/// What of a shell the flow sees.
enum class WettedSurface { Middle, Faces };

/// [[shell]]
struct ShellOptions {
  std::string name;
  MeshOptions mesh;
  PlacementOptions placement;
  double thickness = 0.0;
  double density = 0.0;
  MaterialOptions material;
  BendingElement bending = BendingElement::Qavg;
  MassMatrix mass = MassMatrix::Consistent;
  MembraneElement membrane = MembraneElement::Cst;
  WettedSurface wetted = WettedSurface::Middle;
  DampingOptions damping;
  Vec3 gravity = Vec3::Zero();
  std::vector<SupportOptions> supports;
  std::vector<LoadOptions> loads;
  Mark mark = {};

  bool operator==(const ShellOptions&) const = default;
};

enum class MotionType { Fixed, Prescribed, Free };
/// Displacements of a body's centre of mass and turns about it, along and about the axes of space.
enum class Freedom { X, Y, Z, TurnX, TurnY, TurnZ };

/// Rigid motion from where the mesh is put.  Prescribed: rotation about a fixed axis, then translation, functions of t
/// alone.  Free: by the forces of the flow, of gravity, of springs and dampers.
struct MotionOptions {
  MotionType type = MotionType::Fixed;
  VectorExpression translation;
  std::optional<RotationOptions> rotation;

  std::optional<double> density;  ///< of a closed body: gives mass, centre and inertia; or else
  std::optional<double> mass;
  std::optional<Vec3> centre;   ///< of mass
  std::optional<Vec3> inertia;  ///< about the axes through the centre
  std::vector<Freedom> freedoms{Freedom::X, Freedom::Y, Freedom::Z, Freedom::TurnX, Freedom::TurnY, Freedom::TurnZ};
  Vec3 stiffness = Vec3::Zero();
  Vec3 damping = Vec3::Zero();
  Vec3 turning_stiffness = Vec3::Zero();
  Vec3 turning_damping = Vec3::Zero();
  Vec3 gravity = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  ///< at t = 0
  Vec3 spin = Vec3::Zero();      ///< at t = 0, rad/s

  bool operator==(const MotionOptions&) const = default;
};

/// [[body]]: rigid; a thin sheet, or the surface of a closed body.
struct BodyOptions {
  std::string name;
  MeshOptions mesh;
  PlacementOptions placement;
  std::optional<bool> closed;  ///< none: when the mesh has no edges
  MotionOptions motion;
  Mark mark = {};

  bool operator==(const BodyOptions&) const = default;
};

// ---- how it is solved ------------------------------------------------------------------------------------------

enum class Analysis { Dynamic, Static, ArcLength, DisplacementControl, Modes };
enum class StructureStabilisation { None, Damping };
enum class StructureSolver { Direct, Cg, CgIc };
enum class StructureScheme { Auto, Newmark, GeneralisedAlpha, Midpoint };

/// The displacement prescribed in displacement control: the mean of one component over vertices of the only shell.
struct ControlOptions {
  WhereOptions where;
  Component component = Component::Z;
  double displacement = 0.0;  ///< at the end
  Mark mark = {};

  bool operator==(const ControlOptions&) const = default;
};

/// [structure]
struct StructureOptions {
  Analysis analysis = Analysis::Dynamic;
  int steps = 20;                                                       ///< of load or displacement
  int max_steps = 1000;                                                 ///< of arc-length
  StructureStabilisation stabilisation = StructureStabilisation::None;  ///< of load control
  ControlOptions control;
  int modes = 10;        ///< how many of the lowest
  bool preload = false;  ///< modes about the equilibrium under the loads
  StructureSolver solver = StructureSolver::Direct;
  StructureScheme scheme = StructureScheme::Auto;
  double numerical_damping = 0.0;  ///< of Newmark's scheme
  double rho_inf = 0.8;            ///< of the generalised-alpha scheme
  double fold_limit = 75.0;        ///< degrees

  bool operator==(const StructureOptions&) const = default;
};

/// [contact] of shells with each other, with themselves and with bodies
struct ContactOptions {
  double distance = 0.0;   ///< where the repulsion begins
  double stiffness = 0.0;  ///< pressure at about half that distance
  bool self = true;        ///< also between parts of one surface
  Mark mark = {};

  bool operator==(const ContactOptions&) const = default;
};

enum class PressureSolver { Multigrid, Petsc };
enum class PressureTolerance { Default, Fast };

/// [pressure]
struct PressureOptions {
  PressureSolver solver = PressureSolver::Multigrid;
  PressureTolerance tolerance = PressureTolerance::Default;
  int max_iterations = 200;

  bool operator==(const PressureOptions&) const = default;
};

enum class ImmersedScheme { CutLink, Curvib };
enum class EdgeCover { Whole, Partial };

/// [immersed]
struct ImmersedOptions {
  ImmersedScheme scheme = ImmersedScheme::CutLink;
  EdgeCover edges = EdgeCover::Whole;

  bool operator==(const ImmersedOptions&) const = default;
};

enum class CouplingScheme { Strong, Loose };
enum class CouplingAcceleration { QuasiNewton, Aitken, Constant };

/// [coupling]
struct CouplingOptions {
  CouplingScheme scheme = CouplingScheme::Strong;
  CouplingAcceleration acceleration = CouplingAcceleration::QuasiNewton;
  double relaxation = 0.5;  ///< of `constant`; first factor of the other two
  double tolerance = 1e-8;  ///< relative, of the un-relaxed residual, L-inf
  int max_iterations = 30;

  bool operator==(const CouplingOptions&) const = default;
};

// ---- output ----------------------------------------------------------------------------------------------------

enum class FlowField { Velocity, Pressure, Vorticity, QCriterion };

struct FieldOutputOptions {
  double every = 0.0;
  std::vector<FlowField> what{FlowField::Velocity, FlowField::Pressure, FlowField::Vorticity, FlowField::QCriterion};

  bool operator==(const FieldOutputOptions&) const = default;
};

struct ShellOutputOptions {
  double every = 0.0;

  bool operator==(const ShellOutputOptions&) const = default;
};

struct WallOutputOptions {
  double every = 0.0;

  bool operator==(const WallOutputOptions&) const = default;
};

struct CheckpointOutputOptions {
  double every = 0.0;  ///< time; under a growing load a number of equilibria

  bool operator==(const CheckpointOutputOptions&) const = default;
};

/// [[output.probe]]: the vertex of `shell` nearest to `point` in the reference configuration, or a point in the flow.
struct ProbeOptions {
  std::string name;
  std::optional<std::string> shell;
  Vec3 point = Vec3::Zero();

  bool operator==(const ProbeOptions&) const = default;
};

/// [output.statistics]: means over time, of the flow and of the shear on walls and surfaces.
struct StatisticsOptions {
  double start = 0.0;
  std::optional<double> every;  ///< none: written when the run ends

  bool operator==(const StatisticsOptions&) const = default;
};

/// [[output.rake]]: points in a row in the flow, both ends among them.
struct RakeOptions {
  std::string name;
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  int points = 2;
  double every = 0.0;

  bool operator==(const RakeOptions&) const = default;
};

/// [[output.section]]: forces on the strips of a surface between planes normal to an axis.
struct SectionOptions {
  std::string name;
  std::string shell;  ///< or body
  Vec3 axis = Vec3::UnitZ();
  int bins = 1;
  double every = 0.0;

  bool operator==(const SectionOptions&) const = default;
};

/// [[output.slice]]: the flow in a plane.
struct SliceOptions {
  std::string name;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  std::vector<FlowField> what{FlowField::Velocity, FlowField::Pressure};
  double every = 0.0;

  bool operator==(const SliceOptions&) const = default;
};

/// [[output.isosurface]]: where a field, or the magnitude of a vector, has one value.
struct IsosurfaceOptions {
  std::string name;
  FlowField of = FlowField::QCriterion;
  double value = 0.0;
  std::vector<FlowField> what{FlowField::Velocity};
  double every = 0.0;

  bool operator==(const IsosurfaceOptions&) const = default;
};

/// [output]
struct OutputOptions {
  std::optional<FieldOutputOptions> fields;           ///< none: not written
  std::optional<ShellOutputOptions> shells;           ///< none: not written
  std::optional<WallOutputOptions> walls;             ///< none: not written
  std::optional<CheckpointOutputOptions> checkpoint;  ///< none: only when the run is stopped or fails
  int audit = 10;                                     ///< steps between audits of forces; 0: none
  bool plots = false;                                 ///< make the pictures of `luff plot` when the run ends
  std::vector<ProbeOptions> probes;
  std::optional<StatisticsOptions> statistics;  ///< none: not accumulated
  std::vector<RakeOptions> rakes;
  std::vector<SectionOptions> sections;
  std::vector<SliceOptions> slices;
  std::vector<IsosurfaceOptions> isosurfaces;

  bool operator==(const OutputOptions&) const = default;
};

/// Everything a case file says.
struct Case {
  std::string title;
  StructureOptions structure;
  TimeOptions time;
  std::optional<FluidOptions> fluid;  ///< none: a structure alone
  GridOptions grid;
  BoundaryOptions boundary;
  std::vector<ShellOptions> shells;
  std::vector<BodyOptions> bodies;
  std::optional<ContactOptions> contact;  ///< none: surfaces pass through each other
  PressureOptions pressure;
  ImmersedOptions immersed;
  CouplingOptions coupling;
  OutputOptions output;

  bool operator==(const Case&) const = default;
};

}  // namespace luff::config
