// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/force_record.hpp"

namespace luff::simulation {

namespace {

std::vector<output::Column> columns_of(const SheetRange& sheet)
{
  std::vector<output::Column> columns{{"t", "time"}};
  for (const char* name : {"force", "force_minus", "force_plus"})
    output::add_vector(columns, name, "force");
  if (!sheet.deforms)
    output::add_vector(columns, "moment", "moment");
  return columns;
}

void write_row(output::CsvWriter& table, double t, const std::vector<double>& sums)
{
  std::vector<double> row{t};
  row.insert(row.end(), sums.begin(), sums.end());
  table.row(row);
}

}  // namespace

ForceRecord::ForceRecord(const output::RunFolder& folder, Simulation& simulation, const output::EarlierOutput* earlier)
    : simulation_(simulation)
{
  for (const SheetRange& sheet : simulation.structure().sheets())
    tables_.emplace_back(folder, "forces-" + sheet.name + ".csv", columns_of(sheet), earlier);
}

void ForceRecord::record(const TimeStep& step)
{
  if (tables_.empty())
    return;
  const StepLoads loads = loads_of_step(simulation_);
  for (std::size_t s = 0; s < tables_.size(); ++s) {
    const auto of = [&](const immersed::SheetLoads& part) {
      return sums(simulation_.structure().sheets()[s], step, part);
    };
    const std::vector<double> pressure = of(loads.pressure);
    if (const auto late = LateSums::of(tables_[s].waiting()))
      write_row(tables_[s], late->t(), late->interpolated(step, pressure));
    tables_[s].wait_with(LateSums(step, of(loads.at_end), of(loads.pressure_at_end), pressure).numbers());
  }
}

void ForceRecord::write_waiting()
{
  for (output::CsvWriter& table : tables_)
    if (const auto late = LateSums::of(table.waiting()))
      write_row(table, late->t(), late->extrapolated());
}

/// In all, from the - side, from the + side; of rigid sheets also the moment about their centre.
std::vector<double> ForceRecord::sums(const SheetRange& sheet, const TimeStep& step,
                                      const immersed::SheetLoads& loads) const
{
  const Structure& structure = simulation_.structure();
  Vec3 minus = Vec3::Zero();
  Vec3 plus = Vec3::Zero();
  for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertices; ++v) {
    minus += loads.minus[v];
    plus += loads.plus[v];
  }
  std::vector<double> all;
  for (const Vec3& force : {Vec3(minus + plus), minus, plus})
    output::add_vector(all, force);
  if (sheet.deforms)
    return all;
  Vec3 moment = Vec3::Zero();
  const Vec3 centre = structure.body_motion(sheet.part, step.t_new, step.dt).centre;
  const std::vector<Vec3> positions = structure.accepted_positions(step.t_new);
  for (int v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertices; ++v)
    moment += (positions[v] - centre).cross(loads.force(v));
  output::add_vector(all, moment);
  return all;
}

std::vector<const output::CsvWriter*> ForceRecord::tables() const
{
  std::vector<const output::CsvWriter*> all;
  for (const output::CsvWriter& table : tables_)
    all.push_back(&table);
  return all;
}

}  // namespace luff::simulation
