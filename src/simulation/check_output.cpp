// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/check_output.hpp"

#include <algorithm>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "grid/locate.hpp"
#include "simulation/rake_record.hpp"
#include "surface/mesh.hpp"

namespace luff::simulation {

namespace {

void check_point(const grid::Grid& grid, const std::string& owner, const Vec3& x)
{
  if (!grid::locate(grid, x))
    fail_input("{}: ({:.6g}, {:.6g}, {:.6g}) lies outside the grid", owner, x[0], x[1], x[2]);
}

void check_section(const config::SectionOptions& section, const SheetRange& sheet)
{
  constexpr double round_off = 1e-9;
  double low = 0.0;
  double high = 0.0;
  for (const Vec3& x : sheet.reference.vertices) {
    const double s = (x - sheet.reference.vertices.front()).dot(section.axis.normalized());
    low = std::min(low, s);
    high = std::max(high, s);
  }
  if (high - low <= round_off * bounding_box(sheet.reference.vertices).extent().norm())
    fail_input("section '{}': '{}' has no width along axis ({:.6g}, {:.6g}, {:.6g})", section.name, sheet.name,
               section.axis[0], section.axis[1], section.axis[2]);
}

}  // namespace

void check_output(const grid::Grid& grid, const config::OutputOptions& output, const Structure& structure)
{
  for (const config::ProbeOptions& probe : output.probes)
    if (!probe.shell)
      check_point(grid, "probe '" + probe.name + "'", probe.point);
  for (const config::RakeOptions& rake : output.rakes)
    for (const Vec3& x : points_of(rake))
      check_point(grid, "rake '" + rake.name + "'", x);
  for (const config::SectionOptions& section : output.sections)
    for (const SheetRange& sheet : structure.sheets())
      if (sheet.name == section.shell)
        check_section(section, sheet);
}

}  // namespace luff::simulation
