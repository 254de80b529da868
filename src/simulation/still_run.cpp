// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/still_run.hpp"

#include "output/summary.hpp"
#include "simulation/build.hpp"
#include "surface/mesh.hpp"

namespace luff::simulation {

shell::StaticOptions static_options(const config::StructureOptions& structure)
{
  shell::StaticOptions options;
  options.steps = structure.steps;
  options.time = end_of_loading;
  options.fold_limit = structure.fold_limit;
  options.linear_solver = build_solver(structure.solver);
  if (structure.stabilisation == config::StructureStabilisation::Damping)
    options.stabilisation = shell::Stabilisation::Damping;
  return options;
}

output::SurfaceSnapshot displaced(const surface::TriangleMesh& reference, const Eigen::VectorXd& x)
{
  output::SurfaceSnapshot result;
  const Eigen::VectorXd u = x - surface::interleaved(reference.vertices);
  result.points = surface::points(x);
  result.triangles = reference.triangles;
  result.point_fields.push_back({"displacement", 3, std::vector<double>(u.data(), u.data() + u.size())});
  return result;
}

void summarise(const output::RunFolder& folder, spdlog::logger& log, nlohmann::ordered_json& summary,
               const std::string& tables, const std::function<void()>& analyse)
{
  try {
    analyse();
    summary["state"] = "finished";
  } catch (const Stopped&) {
    summary["state"] = "stopped";
  } catch (const std::exception& error) {
    summary["reason"] = error.what();
    output::write_summary(folder, summary);
    throw;
  }
  output::write_summary(folder, summary);
  log.info("{}; tables: {}; summary: {}", summary["state"].get<std::string>(), folder.file(tables).string(),
           folder.file("summary.json").string());
}

}  // namespace luff::simulation
