// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_run.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "output/csv.hpp"
#include "output/series.hpp"
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
                                     const std::string& shell, const surface::TriangleMesh& reference)
{
  std::vector<output::Column> columns{{"load_factor", ""}};
  for (const output::Column& c : output::vector_columns("displacement", "length"))
    columns.push_back(c);
  columns.push_back({"newton_iterations", ""});
  std::vector<StaticProbe> probes;
  for (const config::ProbeOptions& probe : options.output.probes)
    if (probe.shell == shell)
      probes.push_back(
          {probe.name,
           surface::select_vertices(reference, surface::PointWhere{probe.point}, fmt::format("probe '{}'", probe.name))
               .front(),
           output::CsvWriter(folder, "probe-" + probe.name + ".csv", columns)});
  return probes;
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Writes the equilibria of one shell as they are found.
class StaticRecorder {
 public:
  StaticRecorder(const output::RunFolder& folder, const config::Case& options, const shell::Shell& shell,
                 const shell::PieceRange& piece)
      : first_(3 * piece.first_vertex),
        reference_(shell.reference_of(piece)),
        by_load_(options.structure.analysis == config::Analysis::Static),
        probes_(open_probes(folder, options, piece.name, reference_)),
        steps_(folder, "steps-" + piece.name + ".csv",
               {{"step", ""},
                {"load_factor", ""},
                {"newton_iterations", ""},
                {"damped_iterations", ""},
                {"negative_pivots", ""},
                {"largest_fold", "degrees"},
                {"sharp_folds", ""},
                {"contact_pairs", ""},
                {"smallest_gap", "length"}}),
        series_(folder, "shell-" + piece.name)
  {
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
  BodyRecorder(const output::RunFolder& folder, const shell::ContactOptions& contact) : contact_(contact)
  {
    for (const shell::ContactSheet& body : contact.bodies)
      series_.emplace_back(folder, "body-" + body.name);
    record(0.0);
  }

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

/// Over all equilibria: what a run with contact says at its end.
struct ContactTally {
  int most_pairs = 0;
  int crossings = 0;
  double smallest_gap = std::numeric_limits<double>::infinity();

  void add(const shell::StaticContact& contact)
  {
    most_pairs = std::max(most_pairs, contact.report.active_pairs);
    crossings += contact.crossings;
    smallest_gap = std::min(smallest_gap, contact.report.smallest_gap);
  }
  [[nodiscard]] nlohmann::ordered_json summary() const
  {
    nlohmann::ordered_json result{{"most_pairs", most_pairs}, {"crossings", crossings}};
    if (most_pairs > 0)
      result["smallest_gap"] = smallest_gap;
    return result;
  }
};

void analyse(const LoadedShell& loaded, const config::StructureOptions& structure, const shell::OnStaticStep& on_step)
{
  shell::StaticOptions options = static_options(structure);
  options.contact = loaded.contact;
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

/// Loads one shell, or all that may touch, and writes what becomes of them.
class StaticAnalysis {
 public:
  StaticAnalysis(const output::RunFolder& folder, spdlog::logger& log, const config::Case& options,
                 const LoadedShell& loaded, nlohmann::ordered_json& summary)
      : log_(log), structure_(options.structure), loaded_(loaded), summary_(summary)
  {
    for (const shell::PieceRange& piece : loaded.shell->pieces()) {
      log.info("open in ParaView: {}", folder.file("shell-" + piece.name + ".pvd").string());
      recorders_.emplace_back(folder, options, *loaded.shell, piece);
      summary["shells"][piece.name] = {{"triangles_on_a_conic", loaded.shell->n_hinge_patches()},
                                       {"worst_conic", loaded.shell->worst_conic()}};
    }
    if (loaded.contact)
      bodies_.emplace(folder, *loaded.contact);
  }

  /// `ended`: whether the user asks the run to end.
  void run(const std::function<bool()>& ended)
  {
    analyse(loaded_, structure_, [&](const shell::StaticStep& step) {
      record(step);
      if (ended() && step.load_factor < 1.0)
        throw Stopped();
    });
  }

 private:
  void record(const shell::StaticStep& step)
  {
    log_.info("shell '{}': {}", loaded_.shell->name(), told(step));
    for (StaticRecorder& recorder : recorders_)
      recorder.record(step, summary_);
    summary_["load_factor"] = step.load_factor;
    sharp_folds_ += step.folds.n_sharp;
    for (const shell::PieceRange& piece : loaded_.shell->pieces())
      summary_["shells"][piece.name]["folds_above_45_degrees"] = sharp_folds_;
    if (!step.contact)
      return;
    bodies_->record(step.load_factor);
    contact_.add(*step.contact);
    summary_["contact"] = contact_.summary();
    if (step.contact->crossings > 0)
      log_.warn("contact: {} edges pass through triangles", step.contact->crossings);
  }

  spdlog::logger& log_;
  const config::StructureOptions& structure_;
  const LoadedShell& loaded_;
  nlohmann::ordered_json& summary_;
  std::vector<StaticRecorder> recorders_;
  std::optional<BodyRecorder> bodies_;  ///< with contact
  long sharp_folds_ = 0;
  ContactTally contact_;
};

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
                const std::function<bool()>& interrupted)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  summarise(folder, *log, summary, "probe-*.csv", [&] {
    for (const LoadedShell& loaded : shells)
      StaticAnalysis(folder, *log, options, loaded, summary).run([&] {
        const bool stop = folder.stop_requested();
        return interrupted() || stop;
      });
  });
}

}  // namespace luff::simulation
