// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/modes_run.hpp"

#include <numbers>

#include "output/csv.hpp"
#include "output/series.hpp"
#include "shell/modes.hpp"
#include "shell/proportional_load.hpp"
#include "shell/statics.hpp"
#include "simulation/refusal.hpp"
#include "simulation/still_run.hpp"

namespace luff::simulation {

namespace {

/// What the modes vibrate about.
struct Base {
  Eigen::VectorXd positions;
  shell::BlockMatrix stiffness;
};

Base base_state(const LoadedShell& loaded, const config::StructureOptions& structure, spdlog::logger& log)
{
  const shell::Shell& shell = *loaded.shell;
  Base base{shell.reference_positions(), shell::BlockMatrix(shell.pattern())};
  if (!structure.preload) {
    shell.add_tangent(base.positions, base.stiffness);
    return base;
  }
  const auto say = [&](const shell::StaticStep& step) {
    log.info("shell '{}': load factor {:.4g}, {} Newton iterations", shell.name(), step.load_factor, step.iterations);
  };
  base.positions = shell::solve_static(shell, loaded.loads, static_options(structure), say).positions;
  shell::ProportionalLoad(shell, loaded.loads, end_of_loading).add_tangent(base.positions, 1.0, base.stiffness);
  return base;
}

/// The shell displaced from its base by a mode, so far that the vertex that moves most moves a tenth of the shell's
/// size.
output::SurfaceSnapshot mode_snapshot(const shell::Shell& shell, const Base& base, const Eigen::VectorXd& shape)
{
  constexpr double visible = 0.1;
  double largest = 0.0;
  for (int v = 0; v < shell.n_vertices(); ++v)
    largest = std::max(largest, shape.segment<3>(3 * v).norm());
  const Eigen::VectorXd u = visible * shell.size() / largest * shape;
  output::SurfaceSnapshot snapshot = displaced(shell.reference(), base.positions + u);
  snapshot.point_fields.front().values = std::vector<double>(u.data(), u.data() + u.size());
  return snapshot;
}

void write_table(const output::RunFolder& folder, const shell::Shell& shell, const shell::Modes& modes)
{
  output::CsvWriter csv(folder, "frequencies-" + shell.name() + ".csv",
                        {{"mode", ""},
                         {"angular_frequency", "1/time"},
                         {"frequency", "1/time"},
                         {"mass_share_x", ""},
                         {"mass_share_y", ""},
                         {"mass_share_z", ""}});
  for (int k = 0; k < modes.count(); ++k) {
    const double omega = modes.angular_frequency(k);
    const Vec3 share = modes.mass_share(shell, k);
    csv.row(
        std::array<double, 6>{double(k + 1), omega, omega / (2.0 * std::numbers::pi), share[0], share[1], share[2]});
  }
}

void say_table(spdlog::logger& log, const shell::Shell& shell, const shell::Modes& modes)
{
  log.info("shell '{}': mode, angular frequency, frequency, shares of the mass along x, y, z", shell.name());
  for (int k = 0; k < modes.count(); ++k) {
    const double omega = modes.angular_frequency(k);
    const Vec3 share = modes.mass_share(shell, k);
    log.info("{:5d} {:14.6e} {:14.6e} {:7.3f} {:7.3f} {:7.3f}", k + 1, omega, omega / (2.0 * std::numbers::pi),
             share[0], share[1], share[2]);
  }
  if (modes.omega_squared[0] < 0.0)
    log.info("below zero: round-off of a rigid motion, or the rate at which an unstable state is left");
}

}  // namespace

std::vector<LoadedShell> build_modes(const config::Case& options)
{
  std::vector<LoadedShell> shells;
  for (const config::ShellOptions& shell_options : options.shells) {
    shells.push_back(build_shell({shell_options}));
    refusing_at(shell_options.mark, [&] {
      shell::check_modes(*shells.back().shell, options.structure.modes);
      if (options.structure.preload)
        shell::check_supported(*shells.back().shell);
    });
  }
  return shells;
}

void run_modes(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log, const config::Case& options,
               const std::vector<LoadedShell>& shells)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  summarise(folder, *log, summary, "frequencies-*.csv", [&] {
    for (const LoadedShell& loaded : shells) {
      const shell::Shell& shell = *loaded.shell;
      const Base base = base_state(loaded, options.structure, *log);
      const shell::Modes modes = shell::natural_modes(shell, base.stiffness, options.structure.modes);
      say_table(*log, shell, modes);
      write_table(folder, shell, modes);
      output::SurfaceSeries series(folder, "shell-" + shell.name());
      for (int k = 0; k < modes.count(); ++k) {
        series.write(k + 1, mode_snapshot(shell, base, modes.shapes.col(k)));
        summary["angular_frequencies"][shell.name()].push_back(modes.angular_frequency(k));
      }
      log->info("open in ParaView, the time is the number of the mode: {}",
                folder.file("shell-" + shell.name() + ".pvd").string());
    }
  });
}

}  // namespace luff::simulation
