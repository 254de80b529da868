// SPDX-License-Identifier: BSD-3-Clause
// From the options of a case to the objects that a run needs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <mpi.h>

#include "config/case.hpp"
#include "coupling/acceleration.hpp"
#include "shell/path_following.hpp"
#include "simulation/simulation.hpp"

namespace luff::simulation {

/// Everything that can be wrong with a case's meshes, supports, grid and boundary is found here, before anything is
/// written.  All throw InputError.

/// Shells as pieces of one, and what loads them.
struct LoadedShell {
  std::unique_ptr<shell::Shell> shell;
  std::vector<shell::Load> loads;
  std::vector<surface::Marks> marks;  ///< of each shell's mesh
  std::optional<shell::ContactOptions> contact = {};
};
/// At least one shell.
[[nodiscard]] LoadedShell build_shell(const std::vector<config::ShellOptions>& options);
[[nodiscard]] shell::ControlledDisplacement build_control(const config::ControlOptions& options,
                                                          const shell::Shell& shell);
[[nodiscard]] shell::LinearSolverKind build_solver(config::StructureSolver solver);
[[nodiscard]] std::unique_ptr<Structure> build_structure(const config::Case& options);
/// Of a static analysis with [contact]: bodies are where the load factor's part of their motion takes them.
[[nodiscard]] shell::ContactOptions build_static_contact(const config::Case& options);

[[nodiscard]] fluid::TimeScheme time_scheme(config::TimeScheme scheme);
[[nodiscard]] fluid::Boundaries build_boundaries(const config::Case& options);
/// Collective.
[[nodiscard]] std::unique_ptr<grid::Grid> build_grid(MPI_Comm comm, const config::Case& options);
/// Collective.
[[nodiscard]] std::unique_ptr<Surroundings> build_surroundings(MPI_Comm comm, const config::Case& options,
                                                               const Structure& structure);

[[nodiscard]] coupling::AccelerationOptions build_acceleration(const config::CouplingOptions& options);
[[nodiscard]] CouplingPolicy build_policy(const config::CouplingOptions& options);
/// The whole run.  Collective.
[[nodiscard]] std::unique_ptr<Simulation> build_simulation(MPI_Comm comm, const config::Case& options);

}  // namespace luff::simulation
