// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/statistics.hpp"

#include <nlohmann/json.hpp>

#include "simulation/wall_surface.hpp"

namespace luff::simulation {

namespace {

std::shared_ptr<Statistics> goes_on_with(const Record* earlier, double start, const IndexBox& owned)
{
  if (earlier != nullptr && earlier->statistics != nullptr && earlier->statistics->start == start)
    return earlier->statistics;
  auto fresh = std::make_shared<Statistics>(owned);
  fresh->start = start;
  return fresh;
}

}  // namespace

StatisticsRecord::StatisticsRecord(const output::RunFolder& folder, const config::Case& options, Simulation& simulation,
                                   const Record* earlier)
    : simulation_(simulation),
      options_(*options.output.statistics),
      of_sheets_(options.output.shells && !simulation.structure().sheets().empty()),
      of_walls_(options.output.walls.has_value()),
      collected_(goes_on_with(earlier, options_.start, simulation.surroundings().flow()->grid().owned())),
      due_(options_.every),
      series_(folder, "statistics", earlier != nullptr ? &earlier->output : nullptr)
{
  due_.resume(simulation.clock().now(), last_instant(earlier, "statistics"));
}

void StatisticsRecord::record(const TimeStep& step)
{
  constexpr double round_off = 1e-9;  // of a time that many steps added up to, in steps
  if (step.t_old < options_.start - round_off * step.dt)
    return;
  const fluid::FlowSolver& flow = *simulation_.surroundings().flow();
  collected_->flow.add(flow, step.dt);
  if (of_sheets_)
    collected_->sheets.add(shear_in_surface(flow.tractions(), simulation_.structure(), step.t_new), step.dt);
  if (of_walls_)
    collected_->walls.add(wall_shear(flow), step.dt);
  if (due_.due(step.t_new))
    write(step.t_new);
}

void StatisticsRecord::finish(double t)
{
  const auto& written = series_.mark().instants;
  if (collected_->flow.time > 0.0 && (written.empty() || written.back().time != t))
    write(t);
}

void StatisticsRecord::report(nlohmann::ordered_json& summary) const
{
  summary["statistics"] = {{"start", options_.start}, {"time", collected_->flow.time}};
}

void StatisticsRecord::write(double t)
{
  const fluid::FlowSolver& flow = *simulation_.surroundings().flow();
  series_.write(t, moments_snapshot(flow.grid(), collected_->flow, flow.options().density));
}

}  // namespace luff::simulation
