// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "output/csv.hpp"
#include "output/series.hpp"
#include "parallel/agreement.hpp"
#include "shell/path_following.hpp"
#include "simulation/build.hpp"
#include "surface/selection.hpp"
#include "simulation/refusal.hpp"
#include "simulation/still_run.hpp"

namespace luff::simulation {

namespace {

/// Displacement of one vertex against the load factor.
struct StaticProbe {
  std::string name;
  int vertex = 0;
  output::CsvWriter csv;
};

std::vector<StaticProbe> open_probes(const output::RunFolder& folder, const config::Case& options,
                                     const std::string& shell, const surface::TriangleMesh& reference,
                                     const output::EarlierOutput* earlier)
{
  std::vector<output::Column> columns{{"load_factor", ""}};
  output::add_vector(columns, "displacement", "length");
  columns.push_back({"newton_iterations", ""});
  std::vector<StaticProbe> probes;
  for (const config::ProbeOptions& probe : options.output.probes)
    if (probe.shell == shell)
      probes.push_back(
          {probe.name,
           surface::select_vertices(reference, surface::PointWhere{probe.point}, fmt::format("probe '{}'", probe.name))
               .front(),
           output::CsvWriter(folder, "probe-" + probe.name + ".csv", columns, earlier)});
  return probes;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Writes the equilibria of one shell as they are found.
class StaticRecorder {
 public:
  StaticRecorder(const output::RunFolder& folder, const config::Case& options, const shell::Shell& shell,
                 const shell::PieceRange& piece, const output::EarlierOutput* earlier)
      : first_(3 * piece.first_vertex),
        reference_(shell.reference_of(piece)),
        by_load_(options.structure.analysis == config::Analysis::Static),
        probes_(open_probes(folder, options, piece.name, reference_, earlier)),
        steps_(folder, "steps-" + piece.name + ".csv",
               {{"step", ""},
                {"load_factor", ""},
                {"newton_iterations", ""},
                {"damped_iterations", ""},
                {"negative_pivots", ""},
                {"largest_fold", "degrees"},
                {"sharp_folds", ""},
                {"contact_pairs", ""},
                {"smallest_gap", "length"}},
               earlier),
        series_(folder, "shell-" + piece.name, earlier)
  {
    if (series_.mark().instants.empty())
      series_.write(0.0, displaced(reference_, surface::interleaved(reference_.vertices)));
  }

  void record(const shell::StaticStep& step, nlohmann::ordered_json& summary)
  {
    const Eigen::VectorXd x = step.positions.segment(first_, 3 * reference_.n_vertices());
    // On a path the load factor may return to a value; its instants are numbered by steps.
    series_.write(by_load_ ? step.load_factor : step.step, displaced(reference_, x));
    const auto pivots = step.report.negative_pivots;
    const int pairs = step.contact ? step.contact->report.active_pairs : 0;
    steps_.row(std::array<double, 9>{
        double(step.step), step.load_factor, double(step.iterations), double(step.damped_iterations),
        pivots ? double(*pivots) : nothing, step.folds.largest, double(step.folds.n_sharp),
        step.contact ? double(pairs) : nothing, pairs > 0 ? step.contact->report.smallest_gap : nothing});
    for (StaticProbe& probe : probes_) {
      const Vec3 u = x.segment<3>(3 * probe.vertex) - reference_.vertices[probe.vertex];
      probe.csv.row(std::array<double, 5>{step.load_factor, u[0], u[1], u[2], double(step.iterations)});
      summary["probes"][probe.name] = {u[0], u[1], u[2]};
    }
  }

  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const
  {
    std::vector<const output::CsvWriter*> all{&steps_};
    for (const StaticProbe& probe : probes_)
      all.push_back(&probe.csv);
    return all;
  }
  [[nodiscard]] const output::SeriesMark& series() const { return series_.mark(); }

 private:
  Eigen::Index first_;  ///< of its numbers among those of all shells that are solved together
  surface::TriangleMesh reference_;
  bool by_load_;
  std::vector<StaticProbe> probes_;
  output::CsvWriter steps_;
  output::SurfaceSeries series_;
};

/// Writes where the bodies are that shells touch.
class BodyRecorder {
 public:
  BodyRecorder(const output::RunFolder& folder, const shell::ContactOptions& contact,
               const output::EarlierOutput* earlier)
      : contact_(contact)
  {
    for (const shell::ContactSheet& body : contact.bodies)
      series_.emplace_back(folder, "body-" + body.name, earlier);
    if (!series_.empty() && series_.front().mark().instants.empty())
      record(0.0);
  }

  [[nodiscard]] const std::vector<output::SurfaceSeries>& series() const { return series_; }

  void record(double load_factor)
  {
    if (series_.empty())
      return;
    const Eigen::VectorXd all = contact_.body_positions(load_factor);
    Eigen::Index first = 0;
    for (std::size_t n = 0; n < series_.size(); ++n) {
      const surface::TriangleMesh& mesh = contact_.bodies[n].mesh;
      series_[n].write(load_factor, displaced(mesh, all.segment(first, 3 * mesh.n_vertices())));
      first += 3 * mesh.n_vertices();
    }
  }

 private:
  const shell::ContactOptions& contact_;
  std::vector<output::SurfaceSeries> series_;
};

void add(const shell::StaticContact& contact, ContactTally& tally)
{
  tally.most_pairs = std::max(tally.most_pairs, contact.report.active_pairs);
  tally.crossings += contact.crossings;
  tally.smallest_gap = std::min(tally.smallest_gap, contact.report.smallest_gap);
}

nlohmann::ordered_json summary_of(const ContactTally& tally)
{
  nlohmann::ordered_json result{{"most_pairs", tally.most_pairs}, {"crossings", tally.crossings}};
  if (tally.most_pairs > 0)
    result["smallest_gap"] = tally.smallest_gap;
  return result;
}

/// From `start`, or from the reference where that is step 0.
void analyse(const LoadedShell& loaded, const config::StructureOptions& structure, const shell::PathPoint& start,
             const shell::OnStaticStep& on_step)
{
  shell::StaticOptions options = static_options(structure);
  options.contact = loaded.contact;
  if (start.step > 0)
    options.from = start;
  switch (structure.analysis) {
    case config::Analysis::ArcLength:
      shell::follow_arc_length(*loaded.shell, loaded.loads, {options, structure.max_steps}, on_step);
      break;
    case config::Analysis::DisplacementControl:
      shell::control_displacement(*loaded.shell, loaded.loads, build_control(structure.control, *loaded.shell), options,
                                  on_step);
      break;
    case config::Analysis::Static:
    case config::Analysis::Dynamic:
    case config::Analysis::Modes:
      shell::solve_static(*loaded.shell, loaded.loads, options, on_step);
      break;
  }
}

/// "load factor 0.35, 6 Newton iterations", and what else the user should know.
std::string told(const shell::StaticStep& step)
{
  std::string text = fmt::format("load factor {:.4g}, {} Newton iterations", step.load_factor, step.iterations);
  if (step.damped_iterations > 0)
    text += fmt::format(", snapped in {} damped iterations", step.damped_iterations);
  if (const int n = step.report.negative_pivots.value_or(0); n > 0)
    text += fmt::format(", unstable in {} direction{}", n, n > 1 ? "s" : "");
  if (step.contact && step.contact->report.active_pairs > 0)
    text += fmt::format(", {} pairs touch, smallest gap {:.3g}", step.contact->report.active_pairs,
                        step.contact->report.smallest_gap);
  if (step.folds.n_sharp > 0)
    text += fmt::format(", {} edges folded by more than 45 degrees", step.folds.n_sharp);
  return text;
}

/// Writes what becomes of one shell, or of all that may touch.
class StaticAnalysis {
 public:
  StaticAnalysis(const output::RunFolder& folder, spdlog::logger& log, const config::Case& options,
                 const LoadedShell& loaded, nlohmann::ordered_json& summary, const output::EarlierOutput* earlier)
      : log_(log), loaded_(loaded), summary_(summary)
  {
    for (const shell::PieceRange& piece : loaded.shell->pieces()) {
      log.info("open in ParaView: {}", folder.file("shell-" + piece.name + ".pvd").string());
      recorders_.emplace_back(folder, options, *loaded.shell, piece, earlier);
      summary["shells"][piece.name]["triangles_on_a_conic"] = loaded.shell->n_hinge_patches();
      summary["shells"][piece.name]["worst_conic"] = loaded.shell->worst_conic();
    }
    if (loaded.contact)
      bodies_.emplace(folder, *loaded.contact, earlier);
  }

  /// An equilibrium, and what was counted up to the one before.
  void record(const shell::StaticStep& step, StaticRecord& so_far)
  {
    log_.info("shell '{}': {}", loaded_.shell->name(), told(step));
    for (StaticRecorder& recorder : recorders_)
      recorder.record(step, summary_);
    summary_["load_factor"] = step.load_factor;
    so_far.sharp_folds += step.folds.n_sharp;
    for (const shell::PieceRange& piece : loaded_.shell->pieces())
      summary_["shells"][piece.name]["folds_above_45_degrees"] = so_far.sharp_folds;
    if (!step.contact)
      return;
    bodies_->record(step.load_factor);
    add(*step.contact, so_far.contact);
    summary_["contact"] = summary_of(so_far.contact);
    if (step.contact->crossings > 0)
      log_.warn("contact: {} edges pass through triangles", step.contact->crossings);
  }

  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const
  {
    std::vector<const output::CsvWriter*> all;
    for (const StaticRecorder& recorder : recorders_)
      for (const output::CsvWriter* table : recorder.tables())
        all.push_back(table);
    return all;
  }

  [[nodiscard]] std::vector<const output::SeriesMark*> series() const
  {
    std::vector<const output::SeriesMark*> all;
    for (const StaticRecorder& recorder : recorders_)
      all.push_back(&recorder.series());
    if (bodies_)
      for (const output::SurfaceSeries& body : bodies_->series())
        all.push_back(&body.mark());
    return all;
  }

 private:
  spdlog::logger& log_;
  const LoadedShell& loaded_;
  nlohmann::ordered_json& summary_;
  std::vector<StaticRecorder> recorders_;
  std::optional<BodyRecorder> bodies_;  ///< with contact
};

/// Loads all shells of a case, one after the other, and saves where it stands when it is stopped or fails.
class StaticRun {
 public:
  StaticRun(const output::RunFolder& folder, spdlog::logger& log, const config::Case& options,
            const std::vector<LoadedShell>& shells, nlohmann::ordered_json& summary, const StaticResumption* resumption)
      : folder_(folder),
        log_(log),
        options_(options),
        shells_(shells),
        summary_(summary),
        so_far_(resumption != nullptr ? resumption->record : StaticRecord())
  {
    const output::EarlierOutput* earlier = resumption != nullptr ? &resumption->record.output : nullptr;
    for (const LoadedShell& loaded : shells)
      analyses_.emplace_back(folder, log, options, loaded, summary, earlier);
    for (const output::CsvWriter* table : tables())
      if (!table->whole())
        log.warn("{}: the rows of the earlier run are not there any more, or have other columns; it begins anew",
                 table->mark().file);
  }

  /// `ended`: whether the user asks the run to end.
  void run(const std::function<bool()>& ended)
  {
    try {
      for (; so_far_.shell < static_cast<std::int64_t>(shells_.size()); begin_next_shell())
        load(static_cast<std::size_t>(so_far_.shell), ended);
    } catch (const Stopped&) {
      checkpoint_at_end();
      throw;
    } catch (const std::exception&) {
      if (all_ranks_arrive(folder_.comm()))
        checkpoint_at_end();
      else
        log_.warn("no checkpoint: the ranks of the run have lost each other");
      throw;
    }
  }

 private:
  void load(std::size_t n, const std::function<bool()>& ended)
  {
    analyse(shells_[n], options_.structure, so_far_.point, [&](const shell::StaticStep& step) {
      recording_ = true;
      analyses_[n].record(step, so_far_);
      ++so_far_.steps;
      so_far_.point = shell::point_of(step);
      recording_ = false;
      if (checkpoint_is_due())
        checkpoint();
      if (ended() && step.load_factor < 1.0)
        throw Stopped();
    });
  }

  void begin_next_shell()
  {
    ++so_far_.shell;
    so_far_.point = {};
    so_far_.sharp_folds = 0;
  }

  /// Every so many equilibria, over all shells.
  [[nodiscard]] bool checkpoint_is_due() const
  {
    const auto& checkpoints = options_.output.checkpoint;
    return checkpoints && std::fmod(static_cast<double>(so_far_.steps), checkpoints->every) == 0.0;
  }

  /// A run that is stopped or fails can go on.
  void checkpoint_at_end()
  {
    if (so_far_.steps > 0 && (so_far_.steps == checkpointed_steps_ || checkpoint()))
      log_.info("go on from here with: luff run CASE --restart {}", folder_.path().string());
  }

  /// False, with a warning, where it could not be written; the run may go on without.
  bool checkpoint()
  {
    try {
      if (recording_)
        fail_run("the tables lack the last step");
      bool flushed = true;
      for (const output::CsvWriter* table : tables())
        flushed = table->flush() && flushed;
      if (!on_all_ranks(folder_.comm(), flushed))
        fail_run("tables cannot be written to disk");
      write_checkpoint(folder_, options_, shells_, record());
      checkpointed_steps_ = so_far_.steps;
      return true;
    } catch (const RunError& error) {
      log_.warn("no checkpoint: {}", error.what());
      summary_["failed_checkpoints"] = summary_.value("failed_checkpoints", 0) + 1;
      return false;
    }
  }

  [[nodiscard]] StaticRecord record() const
  {
    StaticRecord record = so_far_;
    record.summary = summary_.dump();
    record.output = {};
    for (const output::CsvWriter* table : tables())
      record.output.tables.push_back(table->mark());
    for (const StaticAnalysis& analysis : analyses_)
      for (const output::SeriesMark* mark : analysis.series())
        record.output.series.push_back(*mark);
    return record;
  }

  [[nodiscard]] std::vector<const output::CsvWriter*> tables() const
  {
    std::vector<const output::CsvWriter*> all;
    for (const StaticAnalysis& analysis : analyses_)
      for (const output::CsvWriter* table : analysis.tables())
        all.push_back(table);
    return all;
  }

  const output::RunFolder& folder_;
  spdlog::logger& log_;
  const config::Case& options_;
  const std::vector<LoadedShell>& shells_;
  nlohmann::ordered_json& summary_;
  StaticRecord so_far_;
  std::int64_t checkpointed_steps_ = -1;  ///< of the last checkpoint; -1: none yet
  bool recording_ = false;                ///< an equilibrium of which not all is written yet
  std::vector<StaticAnalysis> analyses_;
};

/// Of a new run, or as the earlier one left it.
nlohmann::ordered_json first_summary(const config::Case& options, const StaticResumption* resumption)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  if (resumption == nullptr)
    return summary;
  summary.update(nlohmann::ordered_json::parse(resumption->record.summary));
  summary["title"] = options.title;
  summary["restarts"] = summary.value("restarts", 0) + 1;
  return summary;
}

/// All shells of a case as one, since they may touch.
LoadedShell build_touching(const config::Case& options)
{
  LoadedShell all = build_shell(options.shells);
  all.contact = build_static_contact(options);
  return all;
}

}  // namespace

std::vector<LoadedShell> build_static(const config::Case& options)
{
  std::vector<LoadedShell> shells;
  for (const config::ShellOptions& shell_options : options.shells) {
    shells.push_back(build_shell({shell_options}));
    refusing_at(shell_options.mark, [&] { shell::check_supported(*shells.back().shell); });
    if (options.structure.analysis == config::Analysis::DisplacementControl)
      (void)build_control(options.structure.control, *shells.back().shell);
  }
  if (!options.contact)
    return shells;
  std::vector<LoadedShell> together;
  together.push_back(build_touching(options));
  return together;
}

void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options, const std::vector<LoadedShell>& shells,
                const std::function<bool()>& interrupted, const StaticResumption* resumption)
{
  nlohmann::ordered_json summary = first_summary(options, resumption);
  summarise(folder, *log, summary, "probe-*.csv", [&] {
    StaticRun(folder, *log, options, shells, summary, resumption).run([&] {
      const bool stop = folder.stop_requested();
      return interrupted() || stop;
    });
  });
}

}  // namespace luff::simulation
