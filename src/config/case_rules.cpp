// SPDX-License-Identifier: BSD-3-Clause
// Rules between different tables of a case.
#include "config/case_rules.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/nearest.hpp"

namespace luff::config {
namespace {

std::vector<std::string> surface_names(const Case& options)
{
  std::vector<std::string> names;
  for (const auto& shell : options.shells)
    names.push_back(shell.name);
  for (const auto& body : options.bodies)
    names.push_back(body.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name, std::size_t how_many)
{
  return std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(how_many), name) !=
         names.begin() + static_cast<std::ptrdiff_t>(how_many);
}

void state_names_rule(Schema& s, const Case& options)
{
  const auto names = surface_names(options);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_shell = i < options.shells.size();
    const auto key = fmt::format("{}.{}.name", is_shell ? "shell" : "body", is_shell ? i : i - options.shells.size());
    s.rule(!contains(names, names[i], i), key, "must be unique", ": another shell or body has it");
  }
}

void state_periodic_rule(Schema& s, const Case& options)
{
  const auto& sides = options.boundary.sides;
  const auto& names = options.boundary.names();
  const auto is_periodic = [&](std::size_t side) { return sides[side].type == SideType::Periodic; };
  for (std::size_t low = 0; low < sides.size(); low += 2) {
    const std::size_t high = low + 1;
    const std::size_t alone = is_periodic(low) ? low : high;
    s.rule(is_periodic(low) == is_periodic(high), fmt::format("boundary.{}.type", names[alone]), "must be paired",
           fmt::format(": {} is not periodic", names[alone == low ? high : low]));
  }
}

void state_material_rule(Schema& s, const Case& options)
{
  for (std::size_t i = 0; i < options.shells.size(); ++i) {
    const MaterialOptions& m = options.shells[i].material;
    s.rule(m.model != MaterialModel::MayNewmanYin || m.c10 > 0.0 || options.structure.analysis == Analysis::Dynamic,
           fmt::format("shell.{}.material.c10", i),
           "must be greater than 0 unless `structure.analysis = \"dynamic\"`: without it the material has no stiffness "
           "at rest");
  }
}

void state_skin_rule(Schema& s, const Case& options)
{
  for (std::size_t i = 0; i < options.shells.size(); ++i) {
    if (options.shells[i].wetted == WettedSurface::Middle)
      continue;
    s.rule(options.fluid.has_value(), fmt::format("shell.{}.wetted", i), "must be left out without a [fluid]");
    for (std::size_t n = 0; n < options.shells[i].supports.size(); ++n) {
      const SupportOptions& support = options.shells[i].supports[n];
      s.rule(support.type != SupportType::Symmetry || support.where.plane.has_value(),
             fmt::format("shell.{}.support.{}.where", i, n),
             "must be a `plane` for a symmetry of a shell with `wetted = \"faces\"`");
    }
  }
}

/// Of a curvilinear grid it turns out when the grid is made.
bool may_be_inside(const Vec3& point, const GridOptions& grid)
{
  if (is_curvilinear(grid.kind))
    return true;
  for (int d = 0; d < 3; ++d)
    if (point[d] < grid.axes[d].from || point[d] > grid.axes[d].to)
      return false;
  return true;
}

void state_body_rules(Schema& s, const Case& options)
{
  for (std::size_t i = 0; i < options.bodies.size(); ++i) {
    const bool free = options.bodies[i].motion.type == MotionType::Free;
    const auto key = fmt::format("body.{}.motion.type", i);
    s.rule(!free || options.fluid, key, "must be another one without a [fluid]");
    s.rule(!free || !options.contact, key, "must be another one with [contact], which knows prescribed bodies only");
  }
}

void state_probe_rules(Schema& s, const Case& options)
{
  const auto surfaces = surface_names(options);
  std::vector<std::string> names;
  for (const auto& probe : options.output.probes) {
    const auto key = fmt::format("output.probe.{}", names.size());
    s.rule(!contains(names, probe.name, names.size()), key + ".name", "must be unique", ": another probe has it");
    names.push_back(probe.name);
    if (probe.shell) {
      s.rule(contains(surfaces, *probe.shell, surfaces.size()), key + ".shell", "must name a shell or a body",
             suggestion(*probe.shell, surfaces));
    } else {
      s.rule(options.fluid.has_value(), key, "must name a `shell`: without [fluid] there is no flow to stand in");
      s.rule(!options.fluid || may_be_inside(probe.point, options.grid), key + ".point", "must lie in the grid");
    }
  }
}

/// No two items of a list under [output] share a name.
template <class Item>
void state_unique_names(Schema& s, const std::string& list, const std::vector<Item>& items)
{
  std::vector<std::string> names;
  for (const Item& item : items) {
    s.rule(!contains(names, item.name, names.size()), fmt::format("output.{}.{}.name", list, names.size()),
           "must be unique", fmt::format(": another {} has it", list));
    names.push_back(item.name);
  }
}

void state_rake_rules(Schema& s, const Case& options)
{
  state_unique_names(s, "rake", options.output.rakes);
  s.rule(options.fluid || options.output.rakes.empty(), "output.rake", "must be left out without a [fluid]");
  for (std::size_t i = 0; i < options.output.rakes.size() && options.fluid; ++i) {
    const RakeOptions& rake = options.output.rakes[i];
    for (const auto& [end, point] : {std::pair("from", rake.from), std::pair("to", rake.to)})
      s.rule(may_be_inside(point, options.grid), fmt::format("output.rake.{}.{}", i, end), "must lie in the grid");
  }
}

void state_section_rules(Schema& s, const Case& options)
{
  state_unique_names(s, "section", options.output.sections);
  s.rule(options.fluid || options.output.sections.empty(), "output.section", "must be left out without a [fluid]");
  const auto surfaces = surface_names(options);
  for (std::size_t i = 0; i < options.output.sections.size(); ++i) {
    const std::string& name = options.output.sections[i].shell;
    s.rule(contains(surfaces, name, surfaces.size()), fmt::format("output.section.{}.shell", i),
           "must name a shell or a body", suggestion(name, surfaces));
  }
}

void state_cut_rules(Schema& s, const Case& options)
{
  state_unique_names(s, "slice", options.output.slices);
  state_unique_names(s, "isosurface", options.output.isosurfaces);
  s.rule(options.fluid || options.output.slices.empty(), "output.slice", "must be left out without a [fluid]");
  s.rule(options.fluid || options.output.isosurfaces.empty(), "output.isosurface",
         "must be left out without a [fluid]");
}

void state_checkpoint_rules(Schema& s, const Case& options)
{
  const auto& checkpoint = options.output.checkpoint;
  if (!checkpoint)
    return;
  const Analysis analysis = options.structure.analysis;
  s.rule(analysis != Analysis::Modes, "output.checkpoint",
         "must be left out with `structure.analysis = \"modes\"`: they are found at once");
  s.rule(analysis == Analysis::Dynamic || analysis == Analysis::Modes ||
             (checkpoint->every >= 1.0 && checkpoint->every == std::floor(checkpoint->every)),
         "output.checkpoint.every", "must be a whole number of equilibria unless `structure.analysis = \"dynamic\"`");
}

}  // namespace

void state_case_rules(Schema& s, const Case& options)
{
  const bool flows = options.fluid.has_value();
  s.rule(flows || !options.shells.empty(), "", "must have something to solve: [fluid], [[shell]] or both");
  s.rule(!flows || options.structure.analysis == Analysis::Dynamic, "structure.analysis",
         "must be \"dynamic\" with a [fluid]");
  s.rule(options.structure.analysis != Analysis::DisplacementControl || options.shells.size() == 1,
         "structure.analysis", "must be another one with several shells: one displacement cannot control them all");
  s.rule(options.structure.solver == StructureSolver::Direct ||
             (options.structure.stabilisation == StructureStabilisation::None &&
              (options.structure.analysis == Analysis::Dynamic || options.structure.analysis == Analysis::Static)),
         "structure.solver", "must be \"direct\" for modes, on paths with unstable equilibria, and with damping");
  s.rule(flows || options.contact || options.bodies.empty(), "body", "must be left out without a [fluid] or [contact]");
  s.rule(!options.contact || options.structure.stabilisation == StructureStabilisation::None, "structure.stabilisation",
         "must be \"none\" with [contact], which goes down to stable equilibria anyway");
  s.rule(flows || !options.output.fields, "output.fields", "must be left out without a [fluid]");
  s.rule(flows || !options.output.statistics, "output.statistics", "must be left out without a [fluid]");
  const auto& sides = options.boundary.sides;
  const bool has_wall =
      std::any_of(sides.begin(), sides.end(), [](const auto& side) { return side.type == SideType::Wall; });
  s.rule((flows && has_wall) || !options.output.walls, "output.walls",
         "must be left out without a side of type \"wall\": bodies have their stresses in output.shells");
  state_checkpoint_rules(s, options);
  state_names_rule(s, options);
  state_periodic_rule(s, options);
  state_skin_rule(s, options);
  state_material_rule(s, options);
  state_body_rules(s, options);
  state_probe_rules(s, options);
  state_rake_rules(s, options);
  state_section_rules(s, options);
  state_cut_rules(s, options);
}

}  // namespace luff::config
