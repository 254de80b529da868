// SPDX-License-Identifier: BSD-3-Clause
// The words a case file uses for the enumerators of its options.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "config/options.hpp"

namespace luff::config {

/// The word of each enumerator, and the words of the case-file language that this version cannot run yet.
template <class Enum>
struct Words {
  std::vector<std::pair<Enum, std::string>> available;
  std::vector<std::string> later = {};
};

inline Words<TimeScheme> words(TimeScheme)
{
  return {{{TimeScheme::Rk3, "rk3"}, {TimeScheme::NewtonKrylov, "newton-krylov"}}, {"sbdf2"}};
}

inline Words<GridKind> words(GridKind)
{
  return {{{GridKind::Box, "box"},
           {GridKind::MappedBox, "mapped-box"},
           {GridKind::Pipe, "pipe"},
           {GridKind::BentPipe, "bent-pipe"},
           {GridKind::Aorta, "aorta"},
           {GridKind::Annulus, "annulus"},
           {GridKind::Channel, "channel"},
           {GridKind::File, "file"}}};
}

inline Words<SideType> words(SideType)
{
  return {{{SideType::Velocity, "velocity"},
           {SideType::Wall, "wall"},
           {SideType::Slip, "slip"},
           {SideType::Symmetry, "symmetry"},
           {SideType::Periodic, "periodic"},
           {SideType::Outflow, "outflow"},
           {SideType::Pressure, "pressure"}}};
}

inline Words<InflowShape> words(InflowShape)
{
  return {{{InflowShape::Plug, "plug"}, {InflowShape::Parabolic, "parabolic"}, {InflowShape::Womersley, "womersley"}}};
}

inline Words<EnteringFluid> words(EnteringFluid)
{
  return {{{EnteringFluid::Reservoir, "reservoir"}, {EnteringFluid::Developed, "developed"}}};
}

inline Words<MeshShape> words(MeshShape)
{
  return {{{MeshShape::Rectangle, "rectangle"},
           {MeshShape::Disk, "disk"},
           {MeshShape::Annulus, "annulus"},
           {MeshShape::Cylinder, "cylinder"},
           {MeshShape::SphereCap, "sphere-cap"}},
          {"valve"}};
}

inline Words<MeshPattern> words(MeshPattern)
{
  return {{{MeshPattern::Diagonal, "diagonal"},
           {MeshPattern::Alternating, "alternating"},
           {MeshPattern::Irregular, "irregular"},
           {MeshPattern::Delaunay, "delaunay"}}};
}

inline Words<MaterialModel> words(MaterialModel)
{
  return {{{MaterialModel::SaintVenantKirchhoff, "saint-venant-kirchhoff"},
           {MaterialModel::Hencky, "hencky"},
           {MaterialModel::NeoHookean, "neo-hookean"},
           {MaterialModel::MayNewmanYin, "may-newman-yin"},
           {MaterialModel::LeeSacks, "lee-sacks"},
           {MaterialModel::Fung, "fung"},
           {MaterialModel::HolzapfelGasserOgden, "holzapfel-gasser-ogden"}}};
}

inline Words<BendingElement> words(BendingElement)
{
  return {{{BendingElement::Qavg, "qavg"}, {BendingElement::Patch4, "patch4"}, {BendingElement::Hinge, "hinge"}}};
}

inline Words<WettedSurface> words(WettedSurface)
{
  return {{{WettedSurface::Middle, "middle"}, {WettedSurface::Faces, "faces"}}};
}

inline Words<MembraneElement> words(MembraneElement)
{
  return {{{MembraneElement::Cst, "cst"}, {MembraneElement::Smoothed, "smoothed"}}};
}

inline Words<SupportType> words(SupportType)
{
  return {{{SupportType::Clamped, "clamped"},
           {SupportType::Hinged, "hinged"},
           {SupportType::Symmetry, "symmetry"},
           {SupportType::Elastic, "elastic"}}};
}

inline Words<Component> words(Component)
{
  return {{{Component::X, "x"}, {Component::Y, "y"}, {Component::Z, "z"}}};
}

inline Words<MotionType> words(MotionType)
{
  return {{{MotionType::Fixed, "fixed"}, {MotionType::Prescribed, "prescribed"}, {MotionType::Free, "free"}}};
}

inline Words<Freedom> words(Freedom)
{
  return {{{Freedom::X, "x"},
           {Freedom::Y, "y"},
           {Freedom::Z, "z"},
           {Freedom::TurnX, "turn_x"},
           {Freedom::TurnY, "turn_y"},
           {Freedom::TurnZ, "turn_z"}}};
}

inline Words<Analysis> words(Analysis)
{
  return {{{Analysis::Dynamic, "dynamic"},
           {Analysis::Static, "static"},
           {Analysis::ArcLength, "arc-length"},
           {Analysis::DisplacementControl, "displacement-control"},
           {Analysis::Modes, "modes"}}};
}

inline Words<StructureStabilisation> words(StructureStabilisation)
{
  return {{{StructureStabilisation::None, "none"}, {StructureStabilisation::Damping, "damping"}}};
}

inline Words<StructureSolver> words(StructureSolver)
{
  return {{{StructureSolver::Direct, "direct"}, {StructureSolver::Cg, "cg"}, {StructureSolver::CgIc, "cg-ic"}}};
}

inline Words<StructureScheme> words(StructureScheme)
{
  return {{{StructureScheme::Auto, "auto"},
           {StructureScheme::Newmark, "newmark"},
           {StructureScheme::GeneralisedAlpha, "generalised-alpha"},
           {StructureScheme::Midpoint, "midpoint"}}};
}

inline Words<MassMatrix> words(MassMatrix)
{
  return {{{MassMatrix::Consistent, "consistent"}, {MassMatrix::Lumped, "lumped"}}};
}

inline Words<PressureSolver> words(PressureSolver)
{
  return {{{PressureSolver::Multigrid, "multigrid"}, {PressureSolver::Petsc, "petsc"}}};
}

inline Words<PressureTolerance> words(PressureTolerance)
{
  return {{{PressureTolerance::Default, "default"}, {PressureTolerance::Fast, "fast"}}};
}

inline Words<ImmersedScheme> words(ImmersedScheme)
{
  return {{{ImmersedScheme::CutLink, "cut-link"}, {ImmersedScheme::Curvib, "curvib"}}};
}

inline Words<EdgeCover> words(EdgeCover)
{
  return {{{EdgeCover::Whole, "whole"}, {EdgeCover::Partial, "partial"}}};
}

inline Words<CouplingScheme> words(CouplingScheme)
{
  return {{{CouplingScheme::Strong, "strong"}, {CouplingScheme::Loose, "loose"}}};
}

inline Words<CouplingAcceleration> words(CouplingAcceleration)
{
  return {{{CouplingAcceleration::QuasiNewton, "quasi-newton"},
           {CouplingAcceleration::Aitken, "aitken"},
           {CouplingAcceleration::Constant, "constant"}}};
}

inline Words<FlowField> words(FlowField)
{
  return {{{FlowField::Velocity, "velocity"},
           {FlowField::Pressure, "pressure"},
           {FlowField::Vorticity, "vorticity"},
           {FlowField::QCriterion, "q_criterion"}}};
}

/// The word of one enumerator.
template <class Enum>
std::string name_of(Enum value)
{
  for (const auto& [enumerator, word] : words(Enum{}).available)
    if (enumerator == value)
      return word;
  return "?";
}

}  // namespace luff::config
