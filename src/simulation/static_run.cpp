// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_run.hpp"

#include <nlohmann/json.hpp>

#include "output/csv.hpp"
#include "output/series.hpp"
#include "output/summary.hpp"
#include "shell/statics.hpp"
#include "simulation/build.hpp"
#include "surface/selection.hpp"
#include "simulation/refusal.hpp"

namespace luff::simulation {

namespace {

/// Loads grow in proportion from nothing to what they are at this time.
constexpr double end_of_loading = 1.0;

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

output::SurfaceSnapshot snapshot(const shell::Shell& shell, const Eigen::VectorXd& x)
{
  output::SurfaceSnapshot result;
  const Eigen::VectorXd u = x - shell.reference_positions();
  result.points = surface::points(x);
  result.triangles = shell.reference().triangles;
  result.point_fields.push_back({"displacement", 3, std::vector<double>(u.data(), u.data() + u.size())});
  return result;
}

/// Thrown where the user asks the run to end.
struct Stopped {};

/// Writes the equilibria of one shell as they are found.
class StaticRecorder {
 public:
  StaticRecorder(const output::RunFolder& folder, const config::Case& options, const shell::Shell& shell)
      : shell_(shell), probes_(open_probes(folder, options, shell)), series_(folder, "shell-" + shell.name())
  {
    series_.write(0.0, snapshot(shell, shell.reference_positions()));
  }

  void record(const shell::StaticStep& step, nlohmann::ordered_json& summary)
  {
    series_.write(step.load_factor, snapshot(shell_, step.positions));
    for (StaticProbe& probe : probes_) {
      const Vec3 u = (step.positions - shell_.reference_positions()).segment<3>(3 * probe.vertex);
      probe.csv.row(std::array<double, 5>{step.load_factor, u[0], u[1], u[2], double(step.report.iterations)});
      summary["probes"][probe.name] = {u[0], u[1], u[2]};
    }
  }

 private:
  const shell::Shell& shell_;
  std::vector<StaticProbe> probes_;
  output::SurfaceSeries series_;
};

shell::StaticOptions static_options(const config::StructureOptions& structure)
{
  shell::StaticOptions options;
  options.steps = structure.steps;
  options.time = end_of_loading;
  options.fold_limit = structure.fold_limit;
  if (structure.solver == config::StructureSolver::Cg)
    options.linear_solver = shell::LinearSolverKind::ConjugateGradients;
  return options;
}

/// Runs `load`, which fills the summary, and writes the summary however it ends.
template <class Load>
void summarise(const output::RunFolder& folder, spdlog::logger& log, nlohmann::ordered_json& summary, Load load)
{
  try {
    load();
    summary["state"] = "finished";
  } catch (const Stopped&) {
    summary["state"] = "stopped";
  } catch (const std::exception& error) {
    summary["reason"] = error.what();
    output::write_summary(folder, summary);
    throw;
  }
  output::write_summary(folder, summary);
  log.info("{}; tables: {}; summary: {}", summary["state"].get<std::string>(), folder.file("probe-*.csv").string(),
           folder.file("summary.json").string());
}

}  // namespace

std::vector<LoadedShell> build_static(const config::Case& options)
{
  std::vector<LoadedShell> shells;
  for (const config::ShellOptions& shell_options : options.shells) {
    shells.push_back(build_shell({shell_options}));
    refusing_at(shell_options.mark, [&] { shell::check_supported(*shells.back().shell); });
  }
  return shells;
}

void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options, const std::vector<LoadedShell>& shells,
                const std::function<bool()>& interrupted)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  summarise(folder, *log, summary, [&] {
    for (const auto& [shell, loads] : shells) {
      log->info("open in ParaView: {}", folder.file("shell-" + shell->name() + ".pvd").string());
      StaticRecorder recorder(folder, options, *shell);
      (void)shell::solve_static(*shell, loads, static_options(options.structure), [&](const shell::StaticStep& step) {
        log->info("shell '{}': load factor {:.4g}, {} Newton iterations", shell->name(), step.load_factor,
                  step.report.iterations);
        recorder.record(step, summary);
        const bool asked = folder.stop_requested() || interrupted();
        if (asked && step.load_factor < 1.0)
          throw Stopped();
      });
    }
  });
}

}  // namespace luff::simulation
