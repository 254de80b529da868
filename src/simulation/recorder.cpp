// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "output/summary.hpp"
#include "parallel/agreement.hpp"
#include "simulation/cut_record.hpp"
#include "simulation/flow_fields.hpp"
#include "simulation/force_record.hpp"
#include "simulation/rake_record.hpp"
#include "simulation/section_record.hpp"
#include "simulation/wall_surface.hpp"
#include "surface/selection.hpp"

namespace luff::simulation {

namespace {

double seconds_now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<output::Column> step_columns()
{
  std::vector<output::Column> columns{{"step", ""},
                                      {"t", "time"},
                                      {"dt", "time"},
                                      {"cfl", ""},
                                      {"pressure_iterations", ""},
                                      {"momentum_iterations", ""},
                                      {"max_divergence", ""},
                                      {"coupling_iterations", ""},
                                      {"coupling_residual", ""},
                                      {"kinetic", "energy"},
                                      {"elastic", "energy"},
                                      {"damping_work", "energy"},
                                      {"external_work", "energy"},
                                      {"support_work", "energy"},
                                      {"fluid_work", "energy"},
                                      {"flow_work", "energy"},
                                      {"force_mismatch", ""},
                                      {"contact_energy", "energy"},
                                      {"contact_pairs", ""},
                                      {"smallest_gap", "length"},
                                      {"leak", "velocity"},
                                      {"newton_iterations", ""}};
  for (const char* phase : phase_names)
    columns.push_back({std::string("seconds_") + phase, "s"});
  return columns;
}

output::NamedField field_of(const std::string& name, const std::vector<Vec3>& values, int first, int count)
{
  std::vector<double> flat;
  flat.reserve(3 * count);
  for (int n = first; n < first + count; ++n)
    output::add_vector(flat, values[n]);
  return {name, 3, std::move(flat)};
}

}  // namespace

Recorder::Recorder(const output::RunFolder& folder, std::shared_ptr<spdlog::logger> log, const config::Case& options,
                   Simulation& simulation, std::function<bool()> interrupted, const Record* earlier)
    : folder_(folder),
      log_(std::move(log)),
      options_(options),
      simulation_(simulation),
      interrupted_(std::move(interrupted)),
      progress_(std::cout,
                output::progress_on_standard_output(
                    simulation.clock().now(), options.time.end,
                    options.fluid ? double(simulation.surroundings().flow()->grid().ranks().domain().volume()) : 0.0)),
      fields_due_(options.output.fields ? std::optional(options.output.fields->every) : std::nullopt),
      shells_due_(options.output.shells ? std::optional(options.output.shells->every) : std::nullopt),
      walls_due_(options.output.walls ? std::optional(options.output.walls->every) : std::nullopt),
      checkpoint_due_(options.output.checkpoint ? std::optional(options.output.checkpoint->every) : std::nullopt)
{
  const output::EarlierOutput* before = earlier != nullptr ? &earlier->output : nullptr;
  open_tables(before);
  for (const config::ProbeOptions& probe : options_.output.probes)
    open_probe(probe, before);
  open_observers(earlier);
  if (earlier != nullptr)
    resume(*earlier);
  else
    write_start();
  (void)checkpoint_due_.due(simulation_.clock().now());
  started_ = seconds_now() - tally_.seconds;
  last_step_ended_ = seconds_now();
  simulation_.profile().reset();
  if (auto* flow = simulation_.surroundings().flow())
    flow->profile().reset();
}

void Recorder::write_start()
{
  write_snapshots(0.0, options_.time.step, /*last=*/false);
  for (const auto& observer : observers_)
    observer->start();
}

/// Everything that was due up to now was written by the earlier run.
void Recorder::resume(const Record& earlier)
{
  tally_ = earlier.tally;
  if (audit_ && !tally_.audit.empty())
    audit_->restore(tally_.audit);
  newton_iterations_ = simulation_.structure().newton_iterations();
  recorded_steps_ = simulation_.clock().steps();
  const auto latest = [&](const std::string& name) { return last_instant(&earlier, name); };
  fields_due_.resume(simulation_.clock().now(), latest("fields"));
  shells_due_.resume(simulation_.clock().now(),
                     surfaces_.empty() ? std::nullopt : latest(surfaces_.front().mark().name));
  walls_due_.resume(simulation_.clock().now(), latest("walls"));
  for (const output::CsvWriter* table : tables())
    if (!table->whole())
      log_->warn(
          "{}: the rows of the earlier run are not there any more, or have other columns; it begins at t = {:.6g}",
          table->mark().file, simulation_.clock().now());
}

void Recorder::open_tables(const output::EarlierOutput* earlier)
{
  steps_.emplace(folder_, "steps.csv", step_columns(), earlier);
  if (options_.fluid && options_.output.fields)
    fields_.emplace(folder_, "fields", earlier);
  if (options_.fluid && options_.output.audit > 0)
    audit_.emplace(folder_, options_.output.audit, simulation_.structure(), earlier);
  if (options_.output.walls)
    walls_.emplace(folder_, "walls", earlier);
  for (const SheetRange& sheet : simulation_.structure().sheets()) {
    surfaces_.emplace_back(folder_, (sheet.deforms ? "shell-" : "body-") + sheet.name, earlier);
    if (sheet.deforms || options_.bodies[sheet.part].motion.type == config::MotionType::Fixed)
      continue;
    std::vector<output::Column> columns{{"t", "time"}};
    for (const auto& [name, unit] : {std::pair("centre", "length"), std::pair("rotation", "degrees"),
                                     std::pair("velocity", "velocity"), std::pair("spin", "rad/time")})
      output::add_vector(columns, name, unit);
    motions_.emplace_back(sheet.part, output::CsvWriter(folder_, "motion-" + sheet.name + ".csv", columns, earlier));
  }
}

void Recorder::open_observers(const Record* earlier)
{
  if (options_.fluid)
    observers_.push_back(
        std::make_unique<ForceRecord>(folder_, simulation_, earlier != nullptr ? &earlier->output : nullptr));
  if (options_.output.statistics) {
    auto statistics = std::make_unique<StatisticsRecord>(folder_, options_, simulation_, earlier);
    statistics_ = statistics.get();
    observers_.push_back(std::move(statistics));
  }
  const auto open = [&]<class Record>(const auto& list, std::type_identity<Record>) {
    for (const auto& options : list)
      observers_.push_back(std::make_unique<Record>(folder_, options, simulation_, earlier));
  };
  open(options_.output.rakes, std::type_identity<RakeRecord>{});
  open(options_.output.sections, std::type_identity<SectionRecord>{});
  open(options_.output.slices, std::type_identity<CutRecord>{});
  open(options_.output.isosurfaces, std::type_identity<CutRecord>{});
}

void Recorder::open_probe(const config::ProbeOptions& options, const output::EarlierOutput* earlier)
{
  Probe probe;
  probe.name = options.name;
  probe.point = options.point;
  std::vector<output::Column> columns{{"t", "time"}};
  if (options.shell) {
    for (const SheetRange& sheet : simulation_.structure().sheets())
      if (sheet.name == *options.shell) {
        const surface::TriangleMesh& mesh = sheet.reference;
        const int nearest =
            surface::select_vertices(mesh, surface::PointWhere{options.point}, fmt::format("probe '{}'", options.name))
                .front();
        probe.vertex = sheet.first_vertex + nearest;
        probe.point = mesh.vertices[nearest];
      }
    output::add_vector(columns, "displacement", "length");
    output::add_vector(columns, "velocity", "velocity");
  } else {
    probe.location = grid::locate(simulation_.surroundings().flow()->grid(), options.point);
    ensure(probe.location.has_value(), "probes in the flow were found in the grid when the case was checked");
    output::add_vector(columns, "velocity", "velocity");
    columns.push_back({"pressure", "pressure"});
  }
  probe.csv = std::make_unique<output::CsvWriter>(folder_, "probe-" + probe.name + ".csv", columns, earlier);
  for (const std::vector<double>& row : probe.csv->rows()) {
    probe.t.push_back(row[0]);
    for (int d = 0; d < 3; ++d)
      probe.value[d].push_back(row[1 + d]);
  }
  probes_.push_back(std::move(probe));
}

bool Recorder::record(const StepRecord& record)
{
  const double now = seconds_now();
  tally_.seconds_stepping += now - last_step_ended_;
  const double t = record.step.t_new;
  if (auto* flow = simulation_.surroundings().flow())
    flow->fill_halos();
  tally_.largest_divergence = std::max(tally_.largest_divergence, record.flow.divergence);
  tally_.largest_cfl = std::max(tally_.largest_cfl, record.rates.convective * record.step.dt);
  tally_.coupling_iterations += record.coupling.iterations;
  tally_.most_coupling_iterations = std::max<std::int64_t>(tally_.most_coupling_iterations, record.coupling.iterations);
  tally_.pressure_iterations += record.flow.pressure_iterations;
  tally_.halvings += record.halvings;
  if (record.halvings > 0)
    log_->warn("step {}, t = {:.6g}: taken with half its length {} times: {}", record.step.index, record.step.t_new,
               record.halvings, record.trouble);
  warn_about_limits(record);
  {
    const auto timer = simulation_.profile().time(Phase::Output);
    for (const auto& observer : observers_)
      observer->record(record.step);
    write_motions(t, record.step.dt);
    write_probes(t, record.step.dt);
    write_snapshots(t, record.step.dt, /*last=*/false);
  }
  write_steps(record);
  recorded_steps_ = record.step.index;
  if (checkpoint_due_.due(t))
    if (const std::string trouble = try_checkpoint(); !trouble.empty())
      log_->warn("step {}, t = {:.6g}: {}", record.step.index, t, trouble);
  show_progress(record);
  last_step_ended_ = seconds_now();
  return !(folder_.stop_requested() || interrupted_());
}

void Recorder::write_steps(const StepRecord& record)
{
  const shell::EnergyLedger energy = simulation_.structure().energy();
  const bool flows = options_.fluid.has_value();
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const double mismatch = audit(record.step);
  std::vector<double> row{double(record.step.index),
                          record.step.t_new,
                          record.step.dt,
                          flows ? record.rates.convective * record.step.dt : nothing,
                          flows ? double(record.flow.pressure_iterations) : nothing,
                          flows ? double(record.flow.momentum_iterations) : nothing,
                          flows ? record.flow.divergence : nothing,
                          double(record.coupling.iterations),
                          record.coupling.residual,
                          energy.kinetic,
                          energy.elastic,
                          energy.damping_work,
                          energy.external_work,
                          energy.support_work,
                          flows ? energy.fluid_work : nothing,
                          audit_ ? audit_->flow_work() : nothing,
                          mismatch};
  append_contact(row);
  auto* flow = simulation_.surroundings().flow();
  row.push_back(flow ? flow->balance().leak() : nothing);
  row.push_back(double(simulation_.structure().newton_iterations() - newton_iterations_));
  newton_iterations_ = simulation_.structure().newton_iterations();
  for (std::size_t n = 0; n < phase_names.size(); ++n) {
    const double seconds = simulation_.profile().all()[n] + (flow ? flow->profile().all()[n] : 0.0);
    row.push_back(seconds);
    tally_.phases[n] += seconds;
  }
  simulation_.profile().reset();
  if (flow)
    flow->profile().reset();
  steps_->row(row);
}

/// A gap is known where surfaces push each other only.
void Recorder::append_contact(std::vector<double>& row)
{
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const shell::ContactStep* contact = simulation_.structure().contact();
  if (contact == nullptr) {
    row.insert(row.end(), 3, nothing);
    return;
  }
  const shell::ContactReport& report = contact->report();
  row.push_back(contact->energy());
  row.push_back(double(report.active_pairs));
  row.push_back(report.active_pairs > 0 ? report.smallest_gap : nothing);
  tally_.most_pairs = std::max<std::int64_t>(tally_.most_pairs, report.active_pairs);
  tally_.smallest_gap = std::min(tally_.smallest_gap, report.smallest_gap);
}

/// Contact is built so that none occur; a run says what it saw all the same.
void Recorder::count_crossings()
{
  if (const shell::ContactStep* contact = simulation_.structure().contact())
    tally_.crossings += contact->crossings().count;
}

void Recorder::report_contact(nlohmann::ordered_json& summary) const
{
  summary["contact"] = {{"most_pairs", tally_.most_pairs}, {"crossings", tally_.crossings}};
  if (tally_.most_pairs > 0)
    summary["contact"]["smallest_gap"] = tally_.smallest_gap;
  if (tally_.crossings > 0)
    log_->warn("contact: {} edges pass through triangles in all written instants together", tally_.crossings);
}

void Recorder::warn_about_limits(const StepRecord& record)
{
  const double cfl = record.rates.convective * record.step.dt;
  const double diffusion = record.rates.diffusive * record.step.dt;
  const fluid::StepLimits& limits = record.rates.limits;
  if (cfl <= limits.convective && diffusion <= limits.diffusive)
    return;
  if (tally_.steps_beyond_limits++ == 0)
    log_->warn(
        "step {}, t = {:.6g}: CFL {:.2f} (recommended at most {}), diffusion number {:.2f} (at most {}): the run may "
        "become unstable; shorten time.step or set time.cfl",
        record.step.index, record.step.t_new, cfl, limits.convective, diffusion, limits.diffusive);
}

/// The mismatch of this step's forces; no number where no audit was due.
double Recorder::audit(const TimeStep& step)
{
  if (!audit_)
    return std::numeric_limits<double>::quiet_NaN();
  const double mismatch = audit_->record(step, *simulation_.surroundings().flow(), simulation_.structure());
  tally_.audit = audit_->numbers();
  return mismatch;
}

void Recorder::write_motions(double t, double dt)
{
  for (auto& [part, table] : motions_) {
    const BodyMotion motion = simulation_.structure().body_motion(part, t, dt);
    std::vector<double> row{t};
    for (const Vec3& v :
         {motion.centre, Vec3(180.0 / std::numbers::pi * motion.rotation), motion.velocity, motion.spin})
      output::add_vector(row, v);
    table.row(row);
  }
}

void Recorder::write_probes(double t, double dt)
{
  if (probes_.empty())
    return;
  const std::vector<Vec3> positions = simulation_.structure().accepted_positions(t);
  const std::vector<Vec3> velocities = simulation_.structure().accepted_velocities(t, dt);
  for (Probe& probe : probes_) {
    std::vector<double> row{t};
    Vec3 value;
    if (probe.vertex >= 0) {
      value = positions[probe.vertex] - probe.point;
      output::add_vector(row, value);
      output::add_vector(row, velocities[probe.vertex]);
    } else {
      const PointSample here = sample(*simulation_.surroundings().flow(), {&*probe.location, 1}).front();
      value = here.velocity;
      output::add_vector(row, value);
      row.push_back(here.pressure);
    }
    probe.t.push_back(t);
    for (int d = 0; d < 3; ++d)
      probe.value[d].push_back(value[d]);
    probe.csv->row(row);
  }
}

void Recorder::write_snapshots(double t, double dt, bool last)
{
  if (fields_ && fields_due_.due(t, last)) {
    auto* flow = simulation_.surroundings().flow();
    flow->fill_halos();
    fields_->write(t, flow_snapshot(*flow, options_.output.fields->what, simulation_.structure().has_closed_bodies()));
  }
  if (walls_ && walls_due_.due(t, last)) {
    auto* flow = simulation_.surroundings().flow();
    flow->fill_halos();
    walls_->write(t, wall_snapshot(*flow, folder_.comm(), statistics_ ? &statistics_->collected()->walls : nullptr));
  }
  if (options_.output.shells && shells_due_.due(t, last)) {
    write_shells(t, dt);
    count_crossings();
  }
}

void Recorder::write_shells(double t, double dt)
{
  std::vector<immersed::SideTraction> tractions;
  if (auto* flow = simulation_.surroundings().flow(); flow && flow->state().steps > 0)
    tractions = flow->tractions();
  const auto& sheets = simulation_.structure().sheets();
  for (std::size_t s = 0; s < sheets.size(); ++s)
    surfaces_[s].write(t, sheet_snapshot(sheets[s], t, dt, tractions));
}

output::SurfaceSnapshot Recorder::sheet_snapshot(const SheetRange& sheet, double t, double dt,
                                                 const std::vector<immersed::SideTraction>& tractions) const
{
  const Structure& structure = simulation_.structure();
  const std::vector<Vec3> now = structure.accepted_positions(t);
  const surface::TriangleMesh& reference = sheet.reference;
  output::SurfaceSnapshot snapshot;
  std::vector<double> displacement;
  for (int v = 0; v < sheet.vertices; ++v) {
    snapshot.points.push_back(now[sheet.first_vertex + v]);
    output::add_vector(displacement, now[sheet.first_vertex + v] - reference.vertices[v]);
  }
  snapshot.triangles = reference.triangles;
  snapshot.point_fields.push_back({"displacement", 3, std::move(displacement)});
  snapshot.point_fields.push_back(
      field_of("velocity", structure.accepted_velocities(t, dt), sheet.first_vertex, sheet.vertices));
  if (tractions.empty() && !options_.fluid)
    return snapshot;
  // All instants carry the same arrays, zero before the first step.
  for (int side = 0; side < 2; ++side) {
    const std::string suffix = side == 0 ? "_minus" : "_plus";
    std::vector<double> pressure(sheet.triangles, 0.0);
    std::vector<double> shear(3 * sheet.triangles, 0.0);
    for (int e = 0; e < sheet.triangles && !tractions.empty(); ++e) {
      const immersed::SideTraction& traction = tractions[sheet.first_triangle + e];
      pressure[e] = traction.pressure[side];
      for (int d = 0; d < 3; ++d)
        shear[3 * e + d] = traction.shear[side][d];
    }
    snapshot.face_fields.push_back({"pressure" + suffix, 1, std::move(pressure)});
    snapshot.face_fields.push_back({"shear" + suffix, 3, std::move(shear)});
    if (statistics_ != nullptr)
      add_shear_history(sheet, side, snapshot);
  }
  return snapshot;
}

void Recorder::add_shear_history(const SheetRange& sheet, int side, output::SurfaceSnapshot& snapshot) const
{
  const ShearHistory& history = statistics_->collected()->sheets;
  std::vector<double> mean;
  std::vector<double> oscillation;
  for (int e = sheet.first_triangle; e < sheet.first_triangle + sheet.triangles; ++e) {
    mean.push_back(history.mean_magnitude(2 * e + side));
    oscillation.push_back(history.oscillation(2 * e + side));
  }
  const std::string suffix = side == 0 ? "_minus" : "_plus";
  snapshot.face_fields.push_back({"tawss" + suffix, 1, std::move(mean)});
  snapshot.face_fields.push_back({"osi" + suffix, 1, std::move(oscillation)});
}

void Recorder::show_progress(const StepRecord& record)
{
  output::StepProgress line{.step = record.step.index, .t = record.step.t_new};
  if (options_.fluid) {
    line.cfl = record.rates.convective * record.step.dt;
    line.pressure_iterations = record.flow.pressure_iterations;
  }
  if (simulation_.structure().answers_flow() && options_.fluid)
    line.coupling_iterations = record.coupling.iterations;
  if (!probes_.empty()) {
    line.probe_name = probes_.front().name + "_y";
    line.probe = probes_.front().value[1].back();
  }
  if (folder_.writes())
    progress_.step(line);
}

/// Amplitude and frequency of every probe over the last three fifths of the run, for the component that moves most.
void Recorder::report_oscillations(nlohmann::ordered_json& summary)
{
  for (const Probe& probe : probes_) {
    if (probe.t.size() < 3)
      continue;
    const double to = probe.t.back();
    int component = -1;
    std::optional<output::Oscillation> largest;
    for (int d = 0; d < 3; ++d)
      if (const auto o = output::oscillation(probe.t, probe.value[d], 0.4 * to, to);
          o && (!largest || o->peak_to_peak > largest->peak_to_peak)) {
        largest = o;
        component = d;
      }
    if (!largest) {
      log_->info("probe '{}': no oscillation of two periods or more since t = {:.3g}", probe.name, 0.4 * to);
      continue;
    }
    log_->info("probe '{}': {} oscillates with amplitude {:.4g} peak to peak, frequency {:.4g}, over {} periods",
               probe.name, std::string(1, "xyz"[component]), largest->peak_to_peak, largest->frequency,
               largest->periods);
    summary["probes"][probe.name] = {{"component", std::string(1, "xyz"[component])},
                                     {"peak_to_peak", largest->peak_to_peak},
                                     {"frequency", largest->frequency},
                                     {"mean", largest->mean},
                                     {"periods", largest->periods}};
  }
}

std::vector<const output::CsvWriter*> Recorder::tables() const
{
  std::vector<const output::CsvWriter*> all{&*steps_};
  for (const auto& [part, table] : motions_)
    all.push_back(&table);
  for (const Probe& probe : probes_)
    all.push_back(probe.csv.get());
  if (audit_)
    all.push_back(&audit_->table());
  for (const auto& observer : observers_)
    for (const output::CsvWriter* table : observer->tables())
      all.push_back(table);
  return all;
}

std::vector<const output::SeriesMark*> Recorder::series() const
{
  std::vector<const output::SeriesMark*> all;
  if (fields_)
    all.push_back(&fields_->mark());
  if (walls_)
    all.push_back(&walls_->mark());
  for (const output::SurfaceSeries& surface : surfaces_)
    all.push_back(&surface.mark());
  for (const auto& observer : observers_)
    for (const output::SeriesMark* mark : observer->series())
      all.push_back(mark);
  return all;
}

Record Recorder::record_so_far() const
{
  Record record{.tally = tally_, .output = {}};
  if (statistics_ != nullptr)
    record.statistics = statistics_->collected();
  record.tally.seconds = seconds_now() - started_;
  for (const output::CsvWriter* table : tables())
    record.output.tables.push_back(table->mark());
  for (const output::SeriesMark* mark : series())
    record.output.series.push_back(*mark);
  return record;
}

/// Empty if it was written; else what went wrong, and the run may go on without.
std::string Recorder::try_checkpoint()
{
  const auto timer = simulation_.profile().time(Phase::Output);
  try {
    bool flushed = true;
    for (const output::CsvWriter* table : tables())
      flushed = table->flush() && flushed;
    if (!on_all_ranks(folder_.comm(), flushed))
      fail_run("tables cannot be written to disk");
    write_checkpoint(folder_, options_, simulation_, record_so_far());
    checkpointed_steps_ = simulation_.clock().steps();
    return "";
  } catch (const RunError& error) {
    ++failed_checkpoints_;
    return fmt::format("no checkpoint: {}", error.what());
  }
}

/// A run that is stopped or fails can go on, and one that made checkpoints can be made longer.  What went wrong, if
/// anything did.
std::string Recorder::checkpoint_at_end(Ending ending)
{
  const int steps = simulation_.clock().steps();
  if (steps == 0 || steps == checkpointed_steps_ || (ending == Ending::Finished && !options_.output.checkpoint))
    return "";
  if (ending == Ending::Failed && !all_ranks_arrive(folder_.comm()))
    return "no checkpoint: the ranks of the run have lost each other";
  if (recorded_steps_ != steps)
    return "no checkpoint: the tables lack the last step";
  const std::string trouble = try_checkpoint();
  if (trouble.empty() && ending != Ending::Finished)
    log_->info("go on from here with: luff run CASE --restart {}", folder_.path().string());
  return trouble;
}

void Recorder::write_end(double t)
{
  write_snapshots(t, options_.time.step, /*last=*/true);
  for (const auto& observer : observers_)
    observer->finish(t);
}

void Recorder::finish(Ending ending, const std::string& reason)
{
  if (folder_.writes())
    progress_.finish();
  const Clock& clock = simulation_.clock();
  // Before the last instant, which is not one of the series' own if the run goes on.
  const std::string trouble = checkpoint_at_end(ending);
  if (!trouble.empty())
    log_->warn("{}", trouble);
  for (const auto& observer : observers_)
    observer->write_waiting();
  if (ending != Ending::Failed && clock.steps() > 0)
    write_end(clock.now());
  const char* const state = ending == Ending::Finished ? "finished" : ending == Ending::Stopped ? "stopped" : "failed";
  nlohmann::ordered_json summary{{"title", options_.title},
                                 {"state", state},
                                 {"steps", clock.steps()},
                                 {"t", clock.now()},
                                 {"seconds", seconds_now() - started_}};
  if (!reason.empty())
    summary["reason"] = reason;
  if (tally_.restarts > 0)
    summary["restarts"] = tally_.restarts;
  if (failed_checkpoints_ > 0)
    summary["failed_checkpoints"] = failed_checkpoints_;
  report_steps(summary);
  for (const auto& observer : observers_)
    observer->report(summary);
  for (std::size_t n = 0; n < phase_names.size(); ++n)
    summary["phases"][phase_names[n]] = tally_.phases[n];
  say_ending(state);
  report_oscillations(summary);
  output::write_summary(folder_, summary);
  if (ending != Ending::Failed)
    name_files();
  if (ending == Ending::Stopped && !trouble.empty())
    fail_run("{}", trouble);
}

/// Counts and means over all steps.
void Recorder::report_steps(nlohmann::ordered_json& summary) const
{
  const double steps = std::max(1, simulation_.clock().steps());
  if (auto* flow = simulation_.surroundings().flow()) {
    const long cells = flow->grid().ranks().domain().volume();
    summary["cells"] = cells;
    summary["max_divergence"] = tally_.largest_divergence;
    summary["max_cfl"] = tally_.largest_cfl;
    summary["steps_beyond_recommended_limits"] = tally_.steps_beyond_limits;
    summary["mean_pressure_iterations"] = tally_.pressure_iterations / steps;
    summary["microseconds_per_cell_and_step"] = 1e6 * tally_.seconds_stepping / (double(cells) * steps);
  }
  if (simulation_.structure().answers_flow()) {
    summary["mean_coupling_iterations"] = tally_.coupling_iterations / steps;
    summary["max_coupling_iterations"] = tally_.most_coupling_iterations;
    summary["halved_steps"] = tally_.halvings;
  }
  if (!options_.shells.empty()) {
    summary["mean_newton_iterations"] = double(simulation_.structure().newton_iterations()) / steps;
    summary["folds_above_45_degrees"] = simulation_.structure().sharp_folds();
    summary["triangles_on_a_conic"] = simulation_.structure().shells().shell->n_hinge_patches();
    summary["worst_conic"] = simulation_.structure().shells().shell->worst_conic();
  }
  if (simulation_.structure().contact() != nullptr)
    report_contact(summary);
  if (audit_)
    audit_->report(simulation_.structure(), *log_, summary);
}

void Recorder::say_ending(const char* state) const
{
  log_->info("{} at t = {:.6g} after {} steps in {:.1f} s", state, simulation_.clock().now(),
             simulation_.clock().steps(), seconds_now() - started_);
  if (options_.fluid)
    log_->info("largest max |div U| h/|U| of all steps: {:.1e}", tally_.largest_divergence);
  if (tally_.steps_beyond_limits > 0)
    log_->warn("{} steps went beyond the recommended CFL or diffusion number", tally_.steps_beyond_limits);
  if (simulation_.structure().sharp_folds() > 0)
    log_->warn("{} edges in all steps together folded by more than 45 degrees: refine the shell's mesh there",
               simulation_.structure().sharp_folds());
}

void Recorder::name_files() const
{
  std::string list;
  for (const SheetRange& sheet : simulation_.structure().sheets())
    if (options_.output.shells)
      list += fmt::format(" {}", folder_.file((sheet.deforms ? "shell-" : "body-") + sheet.name + ".pvd").string());
  if (fields_)
    list += fmt::format(" {}", folder_.file("fields.pvd").string());
  if (walls_)
    list += fmt::format(" {}", folder_.file("walls.pvd").string());
  for (const auto& observer : observers_)
    for (const output::SeriesMark* mark : observer->series())
      list += fmt::format(" {}", folder_.file(mark->name + ".pvd").string());
  if (!list.empty())
    log_->info("open together in ParaView:{}", list);
  log_->info("tables: {} (steps, probes, forces); summary: {}", folder_.file("*.csv").string(),
             folder_.file("summary.json").string());
}

}  // namespace luff::simulation
