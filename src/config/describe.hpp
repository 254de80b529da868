// SPDX-License-Identifier: BSD-3-Clause
// The keys of every struct of options: their names, meaning, units, ranges, and the rules between them.
#pragma once

#include "config/options.hpp"
#include "config/schema.hpp"

namespace luff::config {

void describe(Schema& s, Case& options);

/// The key `name` of what has files named after it.
void describe_name(Schema& s, std::string& name, std::string_view doc);

// Flow (describe_flow.cpp).
void describe(Schema& s, TimeOptions& time);
void describe(Schema& s, FluidOptions& fluid);
void describe(Schema& s, InitialOptions& initial);
void describe(Schema& s, BoundaryOptions& boundary);
void describe(Schema& s, SideOptions& side);

// Where it is computed (describe_grid.cpp).
void describe(Schema& s, GridOptions& grid);
void describe(Schema& s, AxisOptions& axis);
void describe(Schema& s, CellsOptions& direction);
void describe(Schema& s, RefineOptions& refine);
void describe(Schema& s, PieceOptions& piece);
void describe(Schema& s, BendOptions& bend);
void describe(Schema& s, AngleOptions& angle);

// Surfaces that move in it (describe_structure.cpp).
void describe(Schema& s, ShellOptions& shell);
void describe(Schema& s, MeshOptions& mesh);
void describe(Schema& s, PolarOptions& polar);
void describe(Schema& s, RotateOptions& rotate);
void describe(Schema& s, DampingOptions& damping);
void describe(Schema& s, SupportMotionOptions& motion);
void describe(Schema& s, SupportOptions& support);
void describe(Schema& s, LoadOptions& load);
void describe(Schema& s, WhereOptions& where);
void describe(Schema& s, PlaneOptions& plane);
void describe(Schema& s, BodyOptions& body);
void describe(Schema& s, MotionOptions& motion);
void describe(Schema& s, RotationOptions& rotation);

// What shells are made of (describe_material.cpp).
void describe(Schema& s, MaterialOptions& material);
void describe(Schema& s, FibreOptions& fibre);
void describe(Schema& s, CircumferenceOptions& circumference);

// How it is solved and what is written (describe_run.cpp).
void describe(Schema& s, StructureOptions& structure);
void describe(Schema& s, ContactOptions& contact);
void describe(Schema& s, ControlOptions& control);
void describe(Schema& s, PressureOptions& pressure);
void describe(Schema& s, ImmersedOptions& immersed);
void describe(Schema& s, CouplingOptions& coupling);
void describe(Schema& s, OutputOptions& output);
void describe(Schema& s, FieldOutputOptions& fields);
void describe(Schema& s, ShellOutputOptions& shells);
void describe(Schema& s, WallOutputOptions& walls);
void describe(Schema& s, CheckpointOutputOptions& checkpoint);
void describe(Schema& s, ProbeOptions& probe);
void describe(Schema& s, StatisticsOptions& statistics);
void describe(Schema& s, RakeOptions& rake);
void describe(Schema& s, SectionOptions& section);
void describe(Schema& s, SliceOptions& slice);
void describe(Schema& s, IsosurfaceOptions& isosurface);

}  // namespace luff::config
