// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/commands.hpp"

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <omp.h>

#include "core/error.hpp"
#include "output/atomic_file.hpp"
#include "output/checkpoint_folder.hpp"
#include "output/log.hpp"
#include "output/series.hpp"
#include "simulation/added_mass.hpp"
#include "simulation/build.hpp"
#include "simulation/build_nodes.hpp"
#include "simulation/check_flow.hpp"
#include "simulation/check_output.hpp"
#include "simulation/grid_snapshot.hpp"
#include "simulation/groups.hpp"
#include "simulation/mark_fields.hpp"
#include "simulation/modes_run.hpp"
#include "simulation/recorder.hpp"
#include "simulation/static_run.hpp"

namespace luff::simulation {

namespace {

std::string case_name(const std::filesystem::path& file)
{
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path().filename();
  return file.stem() == "case" && !folder.empty() ? folder.string() : file.stem().string();
}

/// The folder that a run goes on in; it is ours before its checkpoints are read.
std::optional<output::RunFolder> earlier_folder(MPI_Comm comm, const RunOptions& options)
{
  if (options.restart.empty() || !options.out.empty() || !std::filesystem::exists(options.restart))
    return std::nullopt;
  const std::filesystem::path from = std::filesystem::absolute(options.restart);
  return output::RunFolder::again(comm, std::filesystem::is_directory(from) ? from : from.parent_path());
}

output::RunFolder make_folder(MPI_Comm comm, const std::filesystem::path& file, const RunOptions& options)
{
  return options.out.empty() ? output::RunFolder::numbered(comm, "runs", case_name(file))
                             : output::RunFolder::at(comm, options.out);
}

void echo_case(const output::RunFolder& folder, const config::Case& options)
{
  if (!folder.writes())
    return;
  std::ostringstream text;
  config::write_case(options, text);
  output::write_atomically(folder.file("case.toml"), text.str());
}

/// True on every rank when any was asked to end.
std::function<bool()> anywhere(MPI_Comm comm, const std::function<bool()>& here)
{
  return [comm, here] {
    int asked = here() ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &asked, 1, MPI_INT, MPI_MAX, comm);
    return asked != 0;
  };
}

/// Finds how heavy the fluid is that moves with shells before the first step, and lets them borrow mass where they need
/// it.
void prepare_coupling(Simulation& simulation, spdlog::logger& log)
{
  Structure& structure = simulation.structure();
  if (simulation.surroundings().flow() == nullptr || !structure.shells().dynamics ||
      simulation.policy().scheme == Scheme::Loose)
    return;
  try {
    const double ratio = added_mass_ratio(simulation);
    structure.borrow_mass(borrowed_mass(ratio));
    log.info("{}", describe_coupling(ratio, simulation));
  } catch (const NonConvergence& trouble) {  // steps can be halved, this cannot
    log.warn("how heavy the fluid is that moves with the shells is not known: {}", trouble.what());
  }
}

void march(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log, const config::Case& options,
           Simulation& simulation, const std::function<bool()>& interrupted,
           const std::optional<Resumption>& resumption)
{
  Recorder recorder(folder, log, options, simulation, interrupted, resumption ? &resumption->record : nullptr);
  try {
    if (!resumption)
      prepare_coupling(simulation, *log);
    simulation.run([&](const StepRecord& record) { return recorder.record(record); });
  } catch (const InputError& error) {  // of the boundary at a later time, for one
    recorder.finish(Ending::Failed, error.what());
    fail_run("step {}: {}", simulation.clock().steps() + 1, error.what());
  } catch (const std::exception& error) {
    recorder.finish(Ending::Failed, error.what());
    throw;
  }
  recorder.finish(simulation.clock().finished() ? Ending::Finished : Ending::Stopped, "");
}

/// A thread needs some twenty thousand cells to be worth its barriers (measured on two cores: below that, one is
/// faster).
void set_threads(MPI_Comm comm, const config::Case& options, const Threads& threads)
{
  if (threads.at_most == 0)
    return;
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  double cells = 0.0;
  if (options.fluid) {
    const Index3 n = cells_of(options.grid);
    cells = double(n[0]) * n[1] * n[2] / ranks;
  }
  omp_set_num_threads(std::clamp(static_cast<int>(cells / 20000.0), 1, threads.at_most));
}

bool marches(const config::Case& options)
{
  return options.structure.analysis == config::Analysis::Dynamic;
}

std::vector<LoadedShell> build_still(const config::Case& options)
{
  return options.structure.analysis == config::Analysis::Modes ? build_modes(options) : build_static(options);
}

void picture(const output::RunFolder& folder, spdlog::logger& log, const config::Case& options, const RunOptions& run)
{
  if (!options.output.plots || !run.make_pictures || !folder.writes())
    return;
  if (run.make_pictures(folder.path()) == 0)
    log.info("pictures: {}", folder.file("plots").string());
  else
    log.warn("no pictures were made: luff plot {} says why", folder.path().string());
}

void say_groups(spdlog::logger& log, const config::Case& options, const Structure& structure, const grid::Grid* grid)
{
  for (const std::string& line : describe_groups(options, structure, grid))
    log.info("{}", line);
}

const grid::Grid* grid_of(Simulation& simulation)
{
  const fluid::FlowSolver* flow = simulation.surroundings().flow();
  return flow != nullptr ? &flow->grid() : nullptr;
}

std::shared_ptr<spdlog::logger> start_log(const output::RunFolder& folder, const config::Case& options)
{
  echo_case(folder, options);
  auto log = output::make_log(folder);
  log->info("{}", options.title);
  log->info("writing to {}", folder.path().string());
  return log;
}

/// `where`: "step 12, t = 0.3".
void say_resumption(spdlog::logger& log, const std::string& where, const GoingOn& resumption)
{
  for (const std::string& reason : resumption.passed_over)
    log.warn("{}", reason);
  log.info("goes on from {}, of {}", where, resumption.folder.string());
  for (const std::string& change : resumption.changed)
    log.info("changed: {}", change);
}

/// A run's own folder is cut back to where it goes on from.
void prepare_folder(const output::RunFolder& folder, long steps)
{
  folder.forget_stop();
  output::drop_checkpoints_after(folder, steps);
}

output::SurfaceSnapshot surface_snapshot(const Structure& structure, const SheetRange& sheet)
{
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  const auto first = positions.begin() + sheet.first_vertex;
  output::SurfaceSnapshot snapshot;
  snapshot.points.assign(first, first + sheet.vertices);
  snapshot.triangles = sheet.reference.triangles;
  add_marks(sheet, snapshot);
  return snapshot;
}

void run_still(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
               const config::Case& options, const RunOptions& run)
{
  const bool modes = options.structure.analysis == config::Analysis::Modes;
  if (modes && !run.restart.empty())
    fail_input("--restart {}: modes are found at once; only runs in time or of a growing load go on from a checkpoint",
               run.restart.string());
  const auto structure = build_structure(options);
  const std::vector<LoadedShell> shells = build_still(options);
  const std::optional<output::RunFolder> earlier = earlier_folder(comm, run);
  std::optional<StaticResumption> resumption;
  if (!run.restart.empty())
    resumption = resume_static(comm, {run.restart, file, overrides}, options, shells);
  const output::RunFolder folder = earlier ? *earlier : make_folder(comm, file, run);
  if (resumption)
    prepare_folder(folder, resumption->record.steps);
  const auto log = start_log(folder, options);
  say_groups(*log, options, *structure, /*grid=*/nullptr);
  if (resumption)
    say_resumption(
        *log,
        fmt::format("step {}, load factor {:.6g}", resumption->record.point.step, resumption->record.point.load_factor),
        *resumption);
  if (modes)
    run_modes(folder, log, options, shells);
  else
    run_static(folder, log, options, shells, anywhere(comm, run.interrupted), resumption ? &*resumption : nullptr);
  picture(folder, *log, options, run);
}

}  // namespace

void run_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
              const RunOptions& run)
{
  // All that can be refused is refused before the folder is made.
  const config::Case options = config::load_case(file, overrides);
  set_threads(comm, options, run.threads);
  if (!marches(options)) {
    run_still(comm, file, overrides, options, run);
  } else {
    const auto simulation = build_simulation(comm, options);
    const std::optional<output::RunFolder> earlier = earlier_folder(comm, run);
    std::optional<Resumption> resumption;
    if (!run.restart.empty())
      resumption = resume(comm, {run.restart, file, overrides}, options, *simulation);
    const output::RunFolder folder = earlier ? *earlier : make_folder(comm, file, run);
    if (resumption)
      prepare_folder(folder, simulation->clock().steps());
    const auto log = start_log(folder, options);
    say_groups(*log, options, simulation->structure(), grid_of(*simulation));
    if (resumption)
      say_resumption(*log, fmt::format("step {}, t = {:.6g}", simulation->clock().steps(), simulation->clock().now()),
                     *resumption);
    march(folder, log, options, *simulation, anywhere(comm, run.interrupted), resumption);
    picture(folder, *log, options, run);
  }
}

void check_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides)
{
  const config::Case options = config::load_case(file, overrides);
  const auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  const auto grid = options.fluid ? build_grid(comm, options) : nullptr;
  if (grid) {
    check_sheets_inside(*grid, options, *structure);
    check_flow(*grid, options);
    check_output(*grid, options.output, *structure);
  }
  if (!marches(options))
    (void)build_still(options);
  std::vector<std::string> groups = describe_groups(options, *structure, grid.get());
  if (grid && !options.shells.empty()) {
    const std::unique_ptr<Simulation> simulation = build_simulation(comm, options);
    groups.push_back(describe_coupling(added_mass_ratio(*simulation), *simulation));
  }
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0)
    return;
  std::cout << file.string() << ": " << options.title << '\n';
  for (const std::string& line : groups)
    std::cout << "  " << line << '\n';
  std::cout << "the case is valid\n";
}

void write_meshes(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
                  const std::filesystem::path& out)
{
  const config::Case options = config::load_case(file, overrides);
  const auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  const auto grid = options.fluid ? build_grid(comm, options) : nullptr;
  if (grid)
    check_sheets_inside(*grid, options, *structure);
  const output::RunFolder folder = output::RunFolder::at(comm, out);
  if (grid)
    output::FlowSeries(folder, "grid").write(0.0, quality_snapshot(*grid));
  for (const SheetRange& sheet : structure->sheets())
    output::SurfaceSeries(folder, sheet.name).write(0.0, surface_snapshot(*structure, sheet));
  if (folder.writes())
    std::cout << "grid and surfaces written to " << folder.path().string() << "\n";
}

}  // namespace luff::simulation
