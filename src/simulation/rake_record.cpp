// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/rake_record.hpp"

#include "core/error.hpp"
#include "simulation/flow_fields.hpp"

namespace luff::simulation {

namespace {

std::vector<output::Column> columns()
{
  std::vector<output::Column> all{{"t", "time"}, {"distance", "length"}};
  output::add_vector(all, "place", "length");
  output::add_vector(all, "velocity", "velocity");
  all.push_back({"pressure", "pressure"});
  return all;
}

}  // namespace

std::vector<Vec3> points_of(const config::RakeOptions& rake)
{
  std::vector<Vec3> points;
  for (int n = 0; n < rake.points; ++n)
    points.emplace_back(rake.from + n / (rake.points - 1.0) * (rake.to - rake.from));
  return points;
}

RakeRecord::RakeRecord(const output::RunFolder& folder, const config::RakeOptions& options, Simulation& simulation,
                       const Record* earlier)
    : simulation_(simulation),
      points_(points_of(options)),
      due_(options.every),
      table_(folder, "rake-" + options.name + ".csv", columns(), earlier != nullptr ? &earlier->output : nullptr)
{
  for (const Vec3& x : points_) {
    const auto location = grid::locate(simulation.surroundings().flow()->grid(), x);
    ensure(location.has_value(), "rakes were found in the grid when the case was checked");
    locations_.push_back(*location);
  }
  if (earlier != nullptr)
    due_.resume(simulation.clock().now(), std::nullopt);
}

void RakeRecord::start()
{
  if (due_.due(0.0))
    write(0.0);
}

void RakeRecord::record(const TimeStep& step)
{
  if (due_.due(step.t_new))
    write(step.t_new);
}

void RakeRecord::write(double t)
{
  const std::vector<PointSample> samples = sample(*simulation_.surroundings().flow(), locations_);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const Vec3& x = points_[n];
    const Vec3& u = samples[n].velocity;
    table_.row(std::array{t, (x - points_.front()).norm(), x[0], x[1], x[2], u[0], u[1], u[2], samples[n].pressure});
  }
}

}  // namespace luff::simulation
