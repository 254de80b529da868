// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/section_record.hpp"

#include <algorithm>
#include <cmath>

#include "surface/mesh.hpp"

namespace luff::simulation {

namespace {

/// Share of a triangle's area below the plane at s, its corners at s_1 <= s_2 <= s_3:
///
///   (s - s_1)^2/((s_2 - s_1)(s_3 - s_1)) below s_2,   1 - (s_3 - s)^2/((s_3 - s_2)(s_3 - s_1)) above.
double share_below(double s, const std::array<double, 3>& corner)
{
  const auto [s_1, s_2, s_3] = corner;
  if (s <= s_1)
    return 0.0;
  if (s >= s_3)
    return 1.0;
  if (s < s_2)
    return (s - s_1) * (s - s_1) / ((s_2 - s_1) * (s_3 - s_1));
  return 1.0 - (s_3 - s) * (s_3 - s) / ((s_3 - s_2) * (s_3 - s_1));
}

const SheetRange& sheet_named(const Structure& structure, const std::string& name)
{
  return *std::find_if(structure.sheets().begin(), structure.sheets().end(),
                       [&](const SheetRange& sheet) { return sheet.name == name; });
}

std::vector<output::Column> columns()
{
  std::vector<output::Column> all{{"t", "time"}, {"from", "length"}, {"to", "length"}};
  output::add_vector(all, "force_per_length", "force/length");
  return all;
}

}  // namespace

Strips::Strips(const surface::TriangleMesh& reference, const Vec3& axis, int count) : count_(count)
{
  std::vector<double> s;
  for (const Vec3& x : reference.vertices)
    s.push_back(x.dot(axis.normalized()));
  const auto [low, high] = std::minmax_element(s.begin(), s.end());
  first_ = *low;
  width_ = (*high - *low) / count;
  std::vector<std::vector<double>> area(s.size(), std::vector<double>(count, 0.0));  // by vertex and strip
  for (const auto& triangle : reference.triangles) {
    const auto& [a, b, c] = triangle;
    std::array<double, 3> corner{s[a], s[b], s[c]};
    std::sort(corner.begin(), corner.end());
    const double size =
        surface::area_vector(reference.vertices[a], reference.vertices[b], reference.vertices[c]).norm();
    for (int n = 0; n < count; ++n) {
      // The first and the last strip have no outer end: rounding loses nothing.
      const double below = n == 0 ? 0.0 : share_below(begin(n), corner);
      const double within = (n == count - 1 ? 1.0 : share_below(begin(n + 1), corner)) - below;
      for (const int v : triangle)
        area[v][n] += within * size;
    }
  }
  for (std::size_t v = 0; v < s.size(); ++v) {
    double whole = 0.0;
    for (const double part : area[v])
      whole += part;
    for (int n = 0; n < count; ++n)
      if (area[v][n] > 0.0)
        shares_.push_back({static_cast<int>(v), n, area[v][n] / whole});
  }
}

std::vector<Vec3> Strips::forces(std::span<const Vec3> by_vertex) const
{
  std::vector<Vec3> forces(count_, Vec3::Zero());
  for (const Share& share : shares_)
    forces[share.strip] += share.part * by_vertex[share.vertex];
  return forces;
}

SectionRecord::SectionRecord(const output::RunFolder& folder, const config::SectionOptions& options,
                             Simulation& simulation, const Record* earlier)
    : simulation_(simulation),
      sheet_(sheet_named(simulation.structure(), options.shell)),
      strips_(sheet_.reference, options.axis, options.bins),
      due_(options.every),
      table_(folder, "section-" + options.name + ".csv", columns(), earlier != nullptr ? &earlier->output : nullptr)
{
  due_.resume(simulation.clock().now(), std::nullopt);  // nothing acts yet at the start
}

void SectionRecord::record(const TimeStep& step)
{
  const auto late = LateSums::of(table_.waiting());
  const bool due = due_.due(step.t_new);
  if (!late && !due)
    return;
  const StepLoads loads = loads_of_step(simulation_);
  const std::vector<double> pressure = sums(loads.pressure);
  if (late)
    write_rows(late->t(), late->interpolated(step, pressure));
  table_.wait_with(due ? LateSums(step, sums(loads.at_end), sums(loads.pressure_at_end), pressure).numbers()
                       : std::vector<double>{});
}

void SectionRecord::write_waiting()
{
  if (const auto late = LateSums::of(table_.waiting()))
    write_rows(late->t(), late->extrapolated());
}

/// Forces on the strips, x y z of each.
std::vector<double> SectionRecord::sums(const immersed::SheetLoads& loads) const
{
  std::vector<Vec3> by_vertex;
  for (int v = sheet_.first_vertex; v < sheet_.first_vertex + sheet_.vertices; ++v)
    by_vertex.push_back(loads.force(v));
  std::vector<double> all;
  for (const Vec3& force : strips_.forces(by_vertex))
    all.insert(all.end(), force.data(), force.data() + 3);
  return all;
}

void SectionRecord::write_rows(double t, const std::vector<double>& forces)
{
  for (int n = 0; n < strips_.count(); ++n) {
    std::vector<double> row{t, strips_.begin(n), strips_.begin(n + 1)};
    for (int d = 0; d < 3; ++d)
      row.push_back(forces[3 * n + d] / strips_.width());
    table_.row(row);
  }
}

}  // namespace luff::simulation
