// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/groups.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shell/section.hpp"
#include "simulation/build.hpp"
#include "simulation/build_material.hpp"
#include "surface/repair.hpp"

namespace luff::simulation {

namespace {

double side_area(const config::GridOptions& grid, std::size_t side)
{
  double area = 1.0;
  for (std::size_t a = 0; a < 3; ++a)
    if (a != side / 2)
      area *= grid.axes[a].to - grid.axes[a].from;
  return area;
}

/// Fastest of the initial velocity and of what the sides prescribe, at t = 0 in the middle of the domain; of flow rates
/// their mean over the side.
double reference_speed(const config::Case& options)
{
  Vec3 middle;
  for (int a = 0; a < 3; ++a)
    middle[a] = 0.5 * (options.grid.axes[a].from + options.grid.axes[a].to);
  double speed = options.fluid->initial.velocity.evaluate(middle, 0.0).norm();
  for (std::size_t n = 0; n < options.boundary.sides.size(); ++n) {
    const config::SideOptions& side = options.boundary.sides[n];
    if (side.value)
      speed = std::max(speed, side.value->evaluate(middle, 0.0).norm());
    if (side.flow_rate)
      speed = std::max(speed, std::abs(side.flow_rate->evaluate(middle, 0.0)) / side_area(options.grid, n));
  }
  return speed;
}

double sheet_length(const Structure& structure)
{
  if (structure.sheets().empty())
    return 0.0;
  const SheetRange& sheet = structure.sheets().front();
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  const surface::BoundingBox box =
      surface::bounding_box(std::span(positions).subspan(sheet.first_vertex, sheet.vertices));
  return box.extent().maxCoeff();
}

struct Spacing {
  Vec3 finest;
  double cells = 1.0;
};

Spacing spacing_of(const std::array<std::vector<double>, 3>& faces)
{
  Spacing spacing;
  for (int a = 0; a < 3; ++a) {
    double finest = faces[a].back() - faces[a].front();
    for (std::size_t i = 1; i < faces[a].size(); ++i)
      finest = std::min(finest, faces[a][i] - faces[a][i - 1]);
    spacing.finest[a] = finest;
    spacing.cells *= static_cast<double>(faces[a].size() - 1);
  }
  return spacing;
}

void describe_flow(const config::Case& options, const Structure& structure, std::vector<std::string>& lines)
{
  const Spacing spacing = spacing_of(build_coordinates(options.grid));
  const double speed = reference_speed(options);
  const double length = sheet_length(structure);
  const double viscosity = options.fluid->viscosity / options.fluid->density;
  const Vec3& h = spacing.finest;
  lines.push_back(fmt::format("grid {} x {} x {} = {:.0f} cells, finest spacing {:.4g} x {:.4g} x {:.4g}",
                              options.grid.axes[0].cells, options.grid.axes[1].cells, options.grid.axes[2].cells,
                              spacing.cells, h[0], h[1], h[2]));
  // 24 doubles per cell for the flow, as much again at most for the pressure's multigrid.
  lines.push_back(fmt::format("memory about {:.0f} MB for the flow", spacing.cells * 400.0 / 1e6));
  if (length > 0.0 && speed > 0.0) {
    if (viscosity > 0.0)
      lines.push_back(fmt::format("Reynolds number U L/nu = {:.4g}  (U = {:.4g}, L = {:.4g}, nu = {:.4g})",
                                  speed * length / viscosity, speed, length, viscosity));
    lines.push_back(fmt::format("cells per length L/h = {:.1f}", length / h.minCoeff()));
  }
  const double dt = options.time.step;
  lines.push_back(
      fmt::format("CFL number of the free stream at most {:.2f} (recommended {}), diffusion number {:.3f} "
                  "(recommended {})",
                  speed * dt / h.minCoeff(), fluid::convective_limit,
                  viscosity * dt * h.cwiseAbs2().cwiseInverse().sum(), fluid::diffusive_limit));
  const double steps = std::ceil(options.time.end / dt);
  // Measured on one core of 2023: benchmarks/README.md.
  const double microseconds = options.shells.empty() ? 0.3 : 0.8;
  lines.push_back(fmt::format("about {:.0f} steps; near {:.1f} minutes on one core", steps,
                              steps * spacing.cells * microseconds * 1e-6 / 60.0));
}

/// Bending stiffness [M L^2/T^2] at rest: about the axis across the fibre, and about the fibre.
Eigen::Vector2d bending_stiffness(const config::ShellOptions& shell)
{
  const shell::Section section =
      shell::make_section(build_material(shell.material), shell.thickness, shell.material.thickness_points.value_or(0));
  const Vec3 rest = Vec3::Zero();
  const Mat3 D =
      std::visit([&](const auto& s) { return s.stiffness(rest, rest, shell::Fibre::UnitX()).bending; }, section);
  return {D(0, 0), D(1, 1)};
}

/// One value, or two where the fibres make a difference.
std::string shown(const Eigen::Vector2d& stiffness)
{
  if (std::abs(stiffness[0] - stiffness[1]) <= 1e-12 * stiffness[0])
    return fmt::format("{:.4g}", stiffness[0]);
  return fmt::format("{:.4g} along the fibres, {:.4g} across", stiffness[0], stiffness[1]);
}

void describe_shell(const config::Case& options, const config::ShellOptions& shell, double length,
                    std::vector<std::string>& lines)
{
  const double h = shell.thickness;
  const Eigen::Vector2d stiffness = bending_stiffness(shell);
  if (stiffness.isZero(0.0))
    lines.push_back(
        fmt::format("WARNING: shell '{}': its material has no stiffness at rest; give c10 > 0 unless you "
                    "know that its motion keeps it stretched",
                    shell.name));
  if (!options.fluid) {
    lines.push_back(fmt::format("shell '{}': bending stiffness at rest B = {}, mass per area {:.4g}", shell.name,
                                shown(stiffness), shell.density * h));
    return;
  }
  const double speed = reference_speed(options);
  const double rho = options.fluid->density;
  const double mass_ratio = shell.density * h / (rho * length);
  lines.push_back(fmt::format("shell '{}': mass ratio rho_s h/(rho_f L) = {:.4g}", shell.name, mass_ratio));
  if (speed > 0.0)
    lines.push_back(fmt::format("shell '{}': bending stiffness at rest K_B = B/(rho_f U^2 L^3) = {}", shell.name,
                                shown(stiffness / (rho * speed * speed * length * length * length))));
  // Loose coupling blew up at M <= 1 within twenty steps (docs/numerics/coupling.md).
  if (options.coupling.scheme == config::CouplingScheme::Loose && mass_ratio < 10.0)
    lines.push_back(
        fmt::format("WARNING: loose coupling is unstable for shells this light (it needs a mass ratio of about "
                    "10 or more); set coupling.scheme = \"strong\""));
}

void describe_mesh(const SheetRange& sheet, std::vector<std::string>& lines)
{
  const std::string owner = fmt::format("{} '{}'", sheet.deforms ? "shell" : "body", sheet.name);
  lines.push_back(fmt::format("{}: {} vertices, {} triangles", owner, sheet.vertices, sheet.triangles));
  if (sheet.marks.repairs.any())
    lines.push_back(fmt::format("{}: mesh repaired: {}", owner, surface::text(sheet.marks.repairs)));
  if (const auto names = surface::names(sheet.marks.sets); !names.empty())
    lines.push_back(fmt::format("{}: sets {}", owner, fmt::join(names, ", ")));
}

/// Triangles that have no quadratic of their own (docs/numerics/shell.md).
void describe_patches(const shell::Shell& shell, std::vector<std::string>& lines)
{
  if (shell.n_hinge_patches() == 0)
    return;
  const Vec3 at = surface::centroid(shell.reference(), shell.worst_conic_triangle());
  lines.push_back(fmt::format(
      "WARNING: shell '{}': {} of {} triangles lie on a conic with their neighbours, whose slopes they take "
      "(worst q = {:.1e}, limit 50, at ({:.4g}, {:.4g}, {:.4g})); move or remove the vertices there",
      shell.name(), shell.n_hinge_patches(), shell.reference().n_triangles(), shell.worst_conic(), at.x(), at.y(),
      at.z()));
}

}  // namespace

std::vector<std::string> describe_groups(const config::Case& options, const Structure& structure)
{
  std::vector<std::string> lines;
  if (options.fluid)
    describe_flow(options, structure, lines);
  for (const config::ShellOptions& shell : options.shells)
    describe_shell(options, shell, sheet_length(structure), lines);
  for (const SheetRange& sheet : structure.sheets())
    describe_mesh(sheet, lines);
  if (structure.shells().shell)
    describe_patches(*structure.shells().shell, lines);
  return lines;
}

}  // namespace luff::simulation
