// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_run.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "output/csv.hpp"
#include "output/series.hpp"
#include "output/summary.hpp"
#include "shell/statics.hpp"
#include "simulation/build.hpp"

namespace luff::simulation {

namespace {

/// Displacement of one vertex against the load factor.
struct StaticProbe {
  std::string name;
  int vertex = 0;
  output::CsvWriter csv;
};

int nearest_vertex(const surface::TriangleMesh& mesh, const Vec3& point)
{
  const auto nearest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  });
  return static_cast<int>(nearest - mesh.vertices.begin());
}

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
      probes.push_back({probe.name, nearest_vertex(shell.reference(), probe.point),
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

void load(const output::RunFolder& folder, spdlog::logger& log, const config::Case& options, const shell::Shell& shell,
          const config::ShellOptions& shell_options, nlohmann::ordered_json& summary)
{
  std::vector<StaticProbe> probes = open_probes(folder, options, shell);
  output::SurfaceSeries series(folder, "shell-" + shell.name());
  series.write(0.0, snapshot(shell, shell.reference_positions()));
  shell::StaticOptions statics{.steps = options.structure.steps, .time = options.time.end};
  if (options.structure.solver == config::StructureSolver::Cg)
    statics.linear_solver = shell::LinearSolverKind::ConjugateGradients;
  const auto on_step = [&](const shell::StaticStep& step) {
    log.info("shell '{}': load factor {:.4g}, {} Newton iterations", shell.name(), step.load_factor,
             step.report.iterations);
    series.write(step.load_factor, snapshot(shell, step.positions));
    for (StaticProbe& probe : probes) {
      const Vec3 u = (step.positions - shell.reference_positions()).segment<3>(3 * probe.vertex);
      probe.csv.row(std::array<double, 5>{step.load_factor, u[0], u[1], u[2], double(step.report.iterations)});
      summary["probes"][probe.name] = {u[0], u[1], u[2]};
    }
  };
  (void)shell::solve_static(shell, build_loads(shell_options, shell), statics, on_step);
}

}  // namespace

void run_static(const output::RunFolder& folder, const std::shared_ptr<spdlog::logger>& log,
                const config::Case& options)
{
  nlohmann::ordered_json summary{{"title", options.title}, {"state", "failed"}};
  output::write_summary(folder, summary);
  for (const config::ShellOptions& shell_options : options.shells) {
    const auto shell = build_shell_alone(shell_options);
    load(folder, *log, options, *shell, shell_options, summary);
    log->info("open in ParaView: {}", folder.file("shell-" + shell->name() + ".pvd").string());
  }
  summary["state"] = "finished";
  output::write_summary(folder, summary);
  log->info("tables: {}; summary: {}", folder.file("probe-*.csv").string(), folder.file("summary.json").string());
}

}  // namespace luff::simulation
