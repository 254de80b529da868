// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cut_record.hpp"

#include "simulation/flow_points.hpp"

namespace luff::simulation {

CutRecord::CutRecord(const output::RunFolder& folder, const config::SliceOptions& options, Simulation& simulation,
                     const Record* earlier)
    : CutRecord(
          folder, "slice-" + options.name, options.every,
          [options](const fluid::FlowSolver& flow, bool bodies) {
            return output::cut_by_plane(flow_points(flow, options.what, bodies), options.point, options.normal);
          },
          simulation, earlier)
{
}

CutRecord::CutRecord(const output::RunFolder& folder, const config::IsosurfaceOptions& options, Simulation& simulation,
                     const Record* earlier)
    : CutRecord(
          folder, "iso-" + options.name, options.every,
          [options](const fluid::FlowSolver& flow, bool bodies) {
            const std::array of{options.of};
            const std::vector<float> values = magnitudes(flow_points(flow, of, false).fields.front());
            return output::surface_of_value(flow_points(flow, options.what, bodies), values, options.value);
          },
          simulation, earlier)
{
}

CutRecord::CutRecord(const output::RunFolder& folder, const std::string& name, double every, Cut cut,
                     Simulation& simulation, const Record* earlier)
    : comm_(folder.comm()),
      simulation_(simulation),
      cut_(std::move(cut)),
      due_(every),
      series_(folder, name, earlier != nullptr ? &earlier->output : nullptr)
{
  if (earlier != nullptr)
    due_.resume(simulation.clock().now(), last_instant(earlier, name));
}

void CutRecord::start()
{
  if (due_.due(0.0))
    write(0.0);
}

void CutRecord::record(const TimeStep& step)
{
  if (due_.due(step.t_new))
    write(step.t_new);
}

void CutRecord::finish(double t)
{
  if (due_.due(t, /*last=*/true))
    write(t);
}

void CutRecord::write(double t)
{
  const fluid::FlowSolver& flow = *simulation_.surroundings().flow();
  series_.write(t, output::gathered(cut_(flow, simulation_.structure().has_closed_bodies()), comm_));
}

}  // namespace luff::simulation
