// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_run.hpp"

#include <limits>

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
                                     const shell::Shell& shell)
{
  std::vector<output::Column> columns{{"load_factor", ""}};
  for (const output::Column& c : output::vector_columns("displacement", "length"))
    columns.push_back(c);
  columns.push_back({"newton_iterations", ""});
  std::vector<StaticProbe> probes;
  for (const config::ProbeOptions& probe : options.output.probes)
    if (probe.shell == shell.name())
      probes.push_back({probe.name,
                        surface::select_vertices(shell.reference(), surface::PointWhere{probe.point},
                                                 fmt::format("probe '{}'", probe.name))
                            .front(),
                        output::CsvWriter(folder, "probe-" + probe.name + ".csv", columns)});
  return probes;
}

/// Writes the equilibria of one shell as they are found.
class StaticRecorder {
 public:
  StaticRecorder(const output::RunFolder& folder, const config::Case& options, const shell::Shell& shell)
      : shell_(shell),
        by_load_(options.structure.analysis == config::Analysis::Static),
        probes_(open_probes(folder, options, shell)),
        steps_(folder, "steps-" + shell.name() + ".csv",
               {{"step", ""},
                {"load_factor", ""},
                {"newton_iterations", ""},
                {"damped_iterations", ""},
                {"negative_pivots", ""},
                {"largest_fold", "degrees"},
                {"sharp_folds", ""}}),
        series_(folder, "shell-" + shell.name())
  {
    series_.write(0.0, displaced(shell, shell.reference_positions()));
  }

  void record(const shell::StaticStep& step, nlohmann::ordered_json& summary)
  {
    // On a path the load factor may return to a value; its instants are numbered by steps.
    series_.write(by_load_ ? step.load_factor : step.step, displaced(shell_, step.positions));
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const auto pivots = step.report.negative_pivots;
    steps_.row(std::array<double, 7>{double(step.step), step.load_factor, double(step.iterations),
                                     double(step.damped_iterations), pivots ? double(*pivots) : unknown,
                                     step.folds.largest, double(step.folds.n_sharp)});
    for (StaticProbe& probe : probes_) {
      const Vec3 u = (step.positions - shell_.reference_positions()).segment<3>(3 * probe.vertex);
      probe.csv.row(std::array<double, 5>{step.load_factor, u[0], u[1], u[2], double(step.iterations)});
      summary["probes"][probe.name] = {u[0], u[1], u[2]};
    }
    summary["load_factor"] = step.load_factor;
  }

 private:
  const shell::Shell& shell_;
  bool by_load_;
  std::vector<StaticProbe> probes_;
  output::CsvWriter steps_;
  output::SurfaceSeries series_;
};

void analyse(const LoadedShell& loaded, const config::StructureOptions& structure, const shell::OnStaticStep& on_step)
{
  const shell::StaticOptions options = static_options(structure);
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
  if (step.folds.n_sharp > 0)
    text += fmt::format(", {} edges folded by more than 45 degrees", step.folds.n_sharp);
  return text;
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
  return shells;
}

void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options, const std::vector<LoadedShell>& shells,
                const std::function<bool()>& interrupted)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  summarise(folder, *log, summary, "probe-*.csv", [&] {
    for (const LoadedShell& loaded : shells) {
      const std::string& name = loaded.shell->name();
      log->info("open in ParaView: {}", folder.file("shell-" + name + ".pvd").string());
      StaticRecorder recorder(folder, options, *loaded.shell);
      summary["shells"][name] = {{"triangles_on_a_conic", loaded.shell->n_hinge_patches()},
                                 {"worst_conic", loaded.shell->worst_conic()}};
      long sharp_folds = 0;
      analyse(loaded, options.structure, [&](const shell::StaticStep& step) {
        log->info("shell '{}': {}", name, told(step));
        recorder.record(step, summary);
        sharp_folds += step.folds.n_sharp;
        summary["shells"][name]["folds_above_45_degrees"] = sharp_folds;
        const bool asked = folder.stop_requested() || interrupted();
        if (asked && step.load_factor < 1.0)
          throw Stopped();
      });
    }
  });
}

}  // namespace luff::simulation
