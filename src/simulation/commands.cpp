// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/commands.hpp"

#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "output/log.hpp"
#include "output/series.hpp"
#include "simulation/build.hpp"
#include "simulation/groups.hpp"
#include "simulation/recorder.hpp"
#include "simulation/static_run.hpp"

namespace luff::simulation {

namespace {

std::string case_name(const std::filesystem::path& file)
{
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path().filename();
  return file.stem() == "case" && !folder.empty() ? folder.string() : file.stem().string();
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
  std::ofstream out(folder.file("case.toml"));
  config::write_case(options, out);
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

void march(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log, const config::Case& options,
           Simulation& simulation, const std::function<bool()>& interrupted)
{
  Recorder recorder(folder, log, options, simulation, interrupted);
  try {
    simulation.run([&](const StepRecord& record) { return recorder.record(record); });
  } catch (const RunError& error) {
    recorder.finish(Ending::Failed, error.what());
    throw;
  }
  recorder.finish(simulation.clock().finished() ? Ending::Finished : Ending::Stopped, "");
}

bool is_static(const config::Case& options)
{
  return options.structure.analysis == config::Analysis::Static;
}

}  // namespace

void run_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
              const RunOptions& run)
{
  const config::Case options = config::load_case(file, overrides);
  const auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  std::unique_ptr<Simulation> simulation;
  if (!is_static(options))
    simulation = build_simulation(comm, options);
  const output::RunFolder folder = make_folder(comm, file, run);
  echo_case(folder, options);
  const auto log = output::make_log(folder);
  log->info("{}", options.title);
  log->info("writing to {}", folder.path().string());
  for (const std::string& line : describe_groups(options, *structure))
    log->info("{}", line);
  if (is_static(options))
    run_static(folder, log, options);
  else
    march(folder, log, options, *simulation, anywhere(comm, run.interrupted));
}

void check_case(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides)
{
  const config::Case options = config::load_case(file, overrides);
  const auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0)
    return;
  std::cout << file.string() << ": " << options.title << '\n';
  for (const std::string& line : describe_groups(options, *structure))
    std::cout << "  " << line << '\n';
  std::cout << "the case is valid\n";
}

void write_meshes(MPI_Comm comm, const std::filesystem::path& file, const config::Overrides& overrides,
                  const std::filesystem::path& out)
{
  const config::Case options = config::load_case(file, overrides);
  const auto structure = build_structure(options);
  check_sheets_inside(options, *structure);
  const output::RunFolder folder = output::RunFolder::at(comm, out);
  if (options.fluid) {
    const grid::Grid grid(comm, build_coordinates(options.grid),
                          fluid::periodic_axes(build_boundaries(options.boundary)));
    output::FlowSnapshot snapshot;
    for (int a = 0; a < 3; ++a)
      snapshot.nodes[a] = grid.faces(a);
    snapshot.piece = grid.owned();
    std::vector<float> volume;
    for_each_cell_in_order(grid.owned(),
                           [&](int i, int j, int k) { volume.push_back(static_cast<float>(grid.volume(i, j, k))); });
    snapshot.fields.push_back({"volume", 1, std::move(volume)});
    output::FlowSeries(folder, "grid").write(0.0, snapshot);
  }
  const std::vector<Vec3> positions = structure->accepted_positions(0.0);
  for (const SheetRange& sheet : structure->sheets()) {
    output::SurfaceSnapshot snapshot;
    snapshot.points.assign(positions.begin() + sheet.first_vertex,
                           positions.begin() + sheet.first_vertex + sheet.vertices);
    for (int e = 0; e < sheet.triangles; ++e) {
      auto corners = structure->triangles()[sheet.first_triangle + e];
      for (int& v : corners)
        v -= sheet.first_vertex;
      snapshot.triangles.push_back(corners);
    }
    output::SurfaceSeries(folder, sheet.name).write(0.0, snapshot);
  }
  if (folder.writes())
    std::cout << "grid and surfaces written to " << folder.path().string() << "\n";
}

}  // namespace luff::simulation
