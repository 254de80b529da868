// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/checkpoint.hpp"

#include <map>
#include <string>

#include "config/changes.hpp"
#include "core/error.hpp"
#include "parallel/for_each.hpp"
#include "simulation/statistics.hpp"
#include "simulation/wall_surface.hpp"

namespace luff::simulation {

namespace {

// What is in a checkpoint: a line for each item.  `File` is a CheckpointSize, CheckpointWriter or CheckpointReader, so
// that sizing, writing and reading cannot differ.

template <class File, class State>
void transfer_flow(File& file, State& flow)
{
  file.cells("flow/u", flow.u);
  file.faces("flow/U", flow.U);
  file.faces("flow/U_before", flow.U_before);
  file.cells("flow/p", flow.p);
  file.cells("flow/p_before", flow.p_before);
  file.value("flow/dt", flow.dt);
  file.value("flow/steps", flow.steps);
}

template <class File, class Offsets>
void transfer_offsets(File& file, Offsets& offsets)
{
  file.pieces("flow/cut_face", offsets.face);
  file.pieces("flow/cut_face_offset", offsets.offset);
  file.pieces("flow/cut_face_offset_rate", offsets.rate);
  file.pieces("flow/cut_face_cover", offsets.cover);
  file.pieces("flow/cut_face_open_velocity", offsets.open);
  file.pieces("flow/inside_cell", offsets.inside);
  file.pieces("flow/inside_body", offsets.inside_body);
}

template <class File, class Offsets>
void transfer_node_offsets(File& file, Offsets& offsets)
{
  file.pieces("flow/wall_node", offsets.node);
  file.pieces("flow/wall_node_offset", offsets.offset);
}

template <class File, class Checkpoint>
void transfer_shells(File& file, Checkpoint& shells)
{
  file.value("shells/x", shells.state.x);
  file.value("shells/v", shells.state.v);
  file.value("shells/a", shells.state.a);
  file.value("shells/t", shells.state.t);
  file.value("shells/step", shells.step);
  file.value("shells/borrowed_mass", shells.borrowed_mass);
  file.value("shells/fluid_forces", shells.fluid_forces);
  file.value("shells/kinetic", shells.ledger.kinetic);
  file.value("shells/elastic", shells.ledger.elastic);
  file.value("shells/contact", shells.ledger.contact);
  file.value("shells/damping_work", shells.ledger.damping_work);
  file.value("shells/external_work", shells.ledger.external_work);
  file.value("shells/fluid_work", shells.ledger.fluid_work);
  file.value("shells/support_work", shells.ledger.support_work);
  file.value("shells/tangent_x", shells.linearisation.x);
  file.value("shells/tangent_x_frozen", shells.linearisation.x_frozen);
  file.value("shells/tangent_t", shells.linearisation.t);
  file.value("shells/tangent_t_frozen", shells.linearisation.t_frozen);
  file.value("shells/tangent_dt", shells.linearisation.dt);
}

template <class File, class History>
void transfer_coupling(File& file, History& history)
{
  file.value("coupling/factor", history.factor);
  file.value("coupling/columns", history.columns);
  file.value("coupling/lengths", history.lengths);
  file.value("coupling/residuals", history.residuals);
  file.value("coupling/images", history.images);
}

template <class File, class T>
void transfer_tally(File& file, T& tally)
{
  file.value("tally/largest_divergence", tally.largest_divergence);
  file.value("tally/largest_cfl", tally.largest_cfl);
  file.value("tally/coupling_iterations", tally.coupling_iterations);
  file.value("tally/most_coupling_iterations", tally.most_coupling_iterations);
  file.value("tally/pressure_iterations", tally.pressure_iterations);
  file.value("tally/halvings", tally.halvings);
  file.value("tally/steps_beyond_limits", tally.steps_beyond_limits);
  file.value("tally/most_pairs", tally.most_pairs);
  file.value("tally/smallest_gap", tally.smallest_gap);
  file.value("tally/crossings", tally.crossings);
  file.value("tally/seconds", tally.seconds);
  file.value("tally/seconds_stepping", tally.seconds_stepping);
  for (std::size_t n = 0; n < phase_names.size(); ++n)
    file.value(std::string("tally/seconds_") + phase_names[n], tally.phases[n]);
  file.value("tally/restarts", tally.restarts);
  file.value("tally/audit", tally.audit);
}

template <class File, class S>
void transfer_statistics(File& file, S& statistics)
{
  file.value("statistics/start", statistics.start);
  file.value("statistics/time", statistics.flow.time);
  file.cells("statistics/u", statistics.flow.u);
  file.cells("statistics/p", statistics.flow.p);
  for (std::size_t pair = 0; pair < statistics.flow.uu.size(); ++pair)
    file.cells("statistics/uu_" + std::to_string(pair), statistics.flow.uu[pair]);
  file.cells("statistics/pp", statistics.flow.pp);
  file.value("statistics/sheets/time", statistics.sheets.time);
  file.value("statistics/sheets/impulse", statistics.sheets.impulse);
  file.value("statistics/sheets/magnitude", statistics.sheets.magnitude);
  file.value("statistics/walls/time", statistics.walls.time);
}

/// By the number of the face in the whole grid.
struct WallPieces {
  std::vector<std::int64_t> face;
  std::vector<double> impulse;
  std::vector<double> magnitude;
};

template <class File, class Pieces>
void transfer_walls(File& file, Pieces& walls)
{
  file.pieces("statistics/walls/face", walls.face);
  file.pieces("statistics/walls/impulse", walls.impulse);
  file.pieces("statistics/walls/magnitude", walls.magnitude);
}

/// Where and when a run stands, and what it counted, besides the states of flow, shells and coupling.
struct Progress {
  double t = 0.0;
  int steps = 0;
  long newton_iterations = 0;
  long sharp_folds = 0;
  std::string keys;   ///< of the case
  std::string marks;  ///< of tables and series
};

template <class File, class P>
void transfer_progress(File& file, P& progress)
{
  file.value("clock/t", progress.t);
  file.value("clock/steps", progress.steps);
  file.value("structure/newton_iterations", progress.newton_iterations);
  file.value("structure/sharp_folds", progress.sharp_folds);
  file.value("case", progress.keys);
  file.value("output", progress.marks);
}

/// Sums over cells of V, V x_d and V x_d^2: another grid of as many cells has others.  Collective.
std::vector<double> moments_of(const grid::Grid& grid)
{
  std::vector<double> moments(7, 0.0);
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const Vec3 x = grid.centre(i, j, k);
    const double V = grid.volume(i, j, k);
    moments[0] += V;
    for (int d = 0; d < 3; ++d) {
      moments[1 + d] += V * x[d];
      moments[4 + d] += V * x[d] * x[d];
    }
  });
  for (double& moment : moments)
    moment = grid.ranks().sum(moment);
  return moments;
}

std::vector<Shape> shapes_of(Simulation& simulation)
{
  std::vector<Shape> shapes;
  for (const SheetRange& sheet : simulation.structure().sheets())
    shapes.push_back(shape_of_mesh(sheet.name, sheet.reference));
  if (const auto* flow = simulation.surroundings().flow())
    shapes.push_back({"the grid", "grid/moments", moments_of(flow->grid())});
  return shapes;
}

/// The parts of a run as they are saved.
struct Saved {
  Progress progress;
  Tally tally;
  std::vector<Shape> shapes;
  const fluid::FlowState* flow = nullptr;
  immersed::FluxOffsets offsets = {};
  immersed::NodeOffsets node_offsets = {};
  shell::Checkpoint shells = {};
  std::vector<double> free_bodies = {};
  coupling::History history;
  const Statistics* statistics = nullptr;
  WallPieces walls = {};
};

Saved collect(const config::Case& options, Simulation& simulation, const Record& record)
{
  const Structure& structure = simulation.structure();
  Saved saved{.progress = {.t = simulation.clock().now(),
                           .steps = simulation.clock().steps(),
                           .newton_iterations = structure.newton_iterations(),
                           .sharp_folds = structure.sharp_folds(),
                           .keys = config::list_keys(options),
                           .marks = output::text_of_marks(record.output)},
              .tally = record.tally,
              .shapes = shapes_of(simulation),
              .history = simulation.acceleration().history()};
  if (const auto* flow = simulation.surroundings().flow()) {
    saved.flow = &flow->state();
    saved.offsets = flow->links().accepted_offsets();
    if (const immersed::WallNodes* nodes = flow->wall_nodes())
      saved.node_offsets = nodes->accepted_offsets();
  }
  if (structure.shells().dynamics)
    saved.shells = structure.shells().dynamics->checkpoint();
  saved.free_bodies = structure.free_bodies();
  saved.statistics = record.statistics.get();
  if (saved.statistics != nullptr && saved.statistics->walls.time > 0.0)
    saved.walls = {.face = wall_faces(*simulation.surroundings().flow()),
                   .impulse = saved.statistics->walls.impulse,
                   .magnitude = saved.statistics->walls.magnitude};
  return saved;
}

/// Whether statistics are in the file.
constexpr const char* collects_key = "statistics/collected";

template <class File>
void put(File& file, const Saved& saved)
{
  transfer_progress(file, saved.progress);
  transfer_tally(file, saved.tally);
  for (const Shape& shape : saved.shapes)
    file.value(shape.name, shape.numbers);
  if (saved.flow != nullptr) {
    transfer_flow(file, *saved.flow);
    transfer_offsets(file, saved.offsets);
    transfer_node_offsets(file, saved.node_offsets);
  }
  transfer_shells(file, saved.shells);
  file.value("bodies/free", saved.free_bodies);
  transfer_coupling(file, saved.history);
  const int collects = saved.statistics != nullptr ? 1 : 0;
  file.value(collects_key, collects);
  if (saved.statistics != nullptr) {
    transfer_statistics(file, *saved.statistics);
    transfer_walls(file, saved.walls);
  }
}

void restore_flow(const output::CheckpointReader& file, fluid::FlowSolver& flow, double t)
{
  fluid::FlowState state = flow.state();
  transfer_flow(file, state);
  immersed::FluxOffsets offsets;
  transfer_offsets(file, offsets);
  immersed::NodeOffsets node_offsets;
  transfer_node_offsets(file, node_offsets);
  flow.restore(std::move(state), offsets, node_offsets, t);
}

/// What all ranks had of the walls, by this rank's faces.
void take_own_faces(const WallPieces& all, const fluid::FlowSolver& flow, ShearHistory& walls)
{
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t n = 0; n < all.face.size(); ++n)
    place[all.face[n]] = n;
  for (const std::int64_t face : wall_faces(flow)) {
    const auto known = place.find(face);
    if (known == place.end())
      continue;
    const auto impulse = all.impulse.begin() + 3 * static_cast<std::ptrdiff_t>(known->second);
    walls.impulse.insert(walls.impulse.end(), impulse, impulse + 3);
    walls.magnitude.push_back(all.magnitude[known->second]);
  }
}

/// Null where the file has none.
std::shared_ptr<Statistics> restore_statistics(const output::CheckpointReader& file, Simulation& simulation)
{
  int collects = 0;
  file.value(collects_key, collects);
  if (collects == 0)
    return nullptr;
  const fluid::FlowSolver& flow = *simulation.surroundings().flow();
  auto statistics = std::make_shared<Statistics>(flow.grid().owned());
  transfer_statistics(file, *statistics);
  WallPieces walls;
  transfer_walls(file, walls);
  take_own_faces(walls, flow, statistics->walls);
  return statistics;
}

}  // namespace

void write_checkpoint(const output::RunFolder& folder, const config::Case& options, Simulation& simulation,
                      const Record& record)
{
  const Saved saved = collect(options, simulation, record);
  write_checkpoint_file(folder, saved.progress.steps, [&](auto& file) { put(file, saved); });
}

Resumption resume(MPI_Comm comm, const RestartRequest& request, const config::Case& options, Simulation& simulation)
{
  const output::FoundCheckpoint found = output::find_checkpoint(comm, request.from);
  const output::CheckpointReader file(comm, found.file);
  Progress progress;
  transfer_progress(file, progress);
  Resumption resumption;
  resumption.folder = std::filesystem::absolute(found.file).parent_path();
  resumption.passed_over = found.passed_over;
  resumption.changed = config::accept_changes(progress.keys, options, request.case_file, request.overrides);
  require_same_shapes(file, shapes_of(simulation));
  if (auto* flow = simulation.surroundings().flow())
    restore_flow(file, *flow, progress.t);
  shell::Checkpoint shells;
  transfer_shells(file, shells);
  simulation.structure().restore(shells, progress.newton_iterations, progress.sharp_folds);
  std::vector<double> free_bodies;
  file.value("bodies/free", free_bodies);
  simulation.structure().restore_free_bodies(free_bodies);
  coupling::History history;
  transfer_coupling(file, history);
  simulation.acceleration().restore(history);
  simulation.clock().resume(progress.t, progress.steps);
  transfer_tally(file, resumption.record.tally);
  ++resumption.record.tally.restarts;
  resumption.record.statistics = restore_statistics(file, simulation);
  resumption.record.output = output::marks_of_text(progress.marks);
  resumption.record.output.folder = resumption.folder;
  if (simulation.clock().finished())
    fail_input("--restart {}: the run is at its end, t = {:.6g}; let it go on with --set time.end=...",
               request.from.string(), progress.t);
  return resumption;
}

}  // namespace luff::simulation
