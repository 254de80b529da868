// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/groups.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/bounding_box.hpp"
#include "grid/quality.hpp"
#include "shell/section.hpp"
#include "simulation/build.hpp"
#include "simulation/build_material.hpp"
#include "surface/repair.hpp"

namespace luff::simulation {

namespace {

/// Over all ranks.
double side_area(const grid::Grid& grid, int axis, int end)
{
  double area = 0.0;
  IndexBox beside = grid.ranks().domain();
  (end == 0 ? beside.hi : beside.lo)[axis] = end == 0 ? 1 : grid.cells()[axis] - 1;
  for_each_cell_in_order(intersection(beside, grid.owned()), [&](int i, int j, int k) {
    const Index3 face = stepped({i, j, k}, axis, end);
    area += grid.area(axis, face[0], face[1], face[2]);
  });
  return grid.ranks().sum(area);
}

/// Fastest of the initial velocity in the middle of the domain and of what the sides prescribe in their middle, at t =
/// 0; of flow rates their mean over the side.
double reference_speed(const config::Case& options, const grid::Grid& grid)
{
  const Index3 middle{grid.cells()[0] / 2, grid.cells()[1] / 2, grid.cells()[2] / 2};
  double speed = options.fluid->initial.velocity.evaluate(grid.centre_of_any(middle), 0.0).norm();
  for (int a = 0; a < 3; ++a)
    for (int end = 0; end < 2; ++end) {
      const config::SideOptions& side = options.boundary.sides[2 * a + end];
      Index3 beside = middle;
      beside[a] = end == 0 ? 0 : grid.cells()[a] - 1;
      const Vec3 x = grid.centre_of_any(beside);
      if (side.value)
        speed = std::max(speed, side.value->evaluate(x, 0.0).norm());
      if (side.flow_rate)
        speed = std::max(speed, std::abs(side.flow_rate->evaluate(x, 0.0)) / side_area(grid, a, end));
    }
  return speed;
}

double sheet_length(const Structure& structure)
{
  if (structure.sheets().empty())
    return 0.0;
  const SheetRange& sheet = structure.sheets().front();
  const std::vector<Vec3> positions = structure.accepted_positions(0.0);
  const BoundingBox box = bounding_box(std::span(positions).subspan(sheet.first_vertex, sheet.vertices));
  return box.extent().maxCoeff();
}

struct Spacing {
  Vec3 finest;  ///< smallest width of a cell along each direction: volume over area
  double cells = 1.0;
};

Spacing spacing_of(const grid::Grid& grid)
{
  Spacing spacing;
  for (int a = 0; a < 3; ++a) {
    double finest = std::numeric_limits<double>::max();
    for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
      const Index3 next = stepped({i, j, k}, a, 1);
      const double area = 0.5 * (grid.area(a, i, j, k) + grid.area(a, next[0], next[1], next[2]));
      finest = std::min(finest, grid.volume(i, j, k) / area);
    });
    spacing.finest[a] = -grid.ranks().max(-finest);
    spacing.cells *= grid.cells()[a];
  }
  return spacing;
}

void describe_quality(const grid::Grid& grid, std::vector<std::string>& lines)
{
  const grid::GridQuality quality = grid::measure_quality(grid);
  lines.push_back(fmt::format("cosine between faces at most {:.3f}, aspect ratio {:.1f}, growth of volumes {:.2f}",
                              quality.skew.value, quality.aspect.value, quality.growth.value));
  for (const std::string& warning : grid::quality_warnings(quality))
    lines.push_back("WARNING: " + warning);
}

void describe_flow(const config::Case& options, const Structure& structure, const grid::Grid& grid, double speed,
                   std::vector<std::string>& lines)
{
  const Spacing spacing = spacing_of(grid);
  const double length = sheet_length(structure);
  const double viscosity = options.fluid->viscosity / options.fluid->density;
  const Vec3& h = spacing.finest;
  lines.push_back(fmt::format("grid {} x {} x {} = {:.0f} cells, finest spacing {:.4g} x {:.4g} x {:.4g}",
                              grid.cells()[0], grid.cells()[1], grid.cells()[2], spacing.cells, h[0], h[1], h[2]));
  if (grid.kind() == grid::Kind::Curvilinear)
    describe_quality(grid, lines);
  // 24 doubles per cell for the flow, as much again at most for the pressure's multigrid; 19 for curvilinear metrics.
  double bytes = grid.kind() == grid::Kind::Curvilinear ? 550.0 : 400.0;
  // Fields, factors and up to thirty directions of Krylov's method.
  if (options.time.scheme == config::TimeScheme::NewtonKrylov)
    bytes += 900.0;
  lines.push_back(fmt::format("memory about {:.0f} MB for the flow", spacing.cells * bytes / 1e6));
  if (length > 0.0 && speed > 0.0) {
    if (viscosity > 0.0)
      lines.push_back(fmt::format("Reynolds number U L/nu = {:.4g}  (U = {:.4g}, L = {:.4g}, nu = {:.4g})",
                                  speed * length / viscosity, speed, length, viscosity));
    lines.push_back(fmt::format("cells per length L/h = {:.1f}", length / h.minCoeff()));
  }
  for (const config::ShellOptions& shell : options.shells)
    if (shell.wetted == config::WettedSurface::Faces && shell.thickness < 2.0 * h.minCoeff())
      lines.push_back(
          fmt::format("WARNING: shell '{}': its faces are {:.2g} cells apart; use two or more, or "
                      "`wetted = \"middle\"`",
                      shell.name, shell.thickness / h.minCoeff()));
  const double dt = options.time.step;
  const fluid::StepLimits limits = fluid::step_limits(time_scheme(options.time.scheme));
  lines.push_back(
      fmt::format("CFL number of the free stream at most {:.2f} (recommended {}), diffusion number {:.3f} "
                  "(recommended {})",
                  speed * dt / h.minCoeff(), limits.convective, viscosity * dt * h.cwiseAbs2().cwiseInverse().sum(),
                  limits.diffusive));
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

/// `speed`: of the flow, where there is one.
void describe_shell(const config::Case& options, const config::ShellOptions& shell, double length, double speed,
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
  const double rho = options.fluid->density;
  const double mass_ratio = shell.density * h / (rho * length);
  lines.push_back(fmt::format("shell '{}': mass ratio rho_s h/(rho_f L) = {:.4g}", shell.name, mass_ratio));
  if (speed > 0.0)
    lines.push_back(fmt::format("shell '{}': bending stiffness at rest K_B = B/(rho_f U^2 L^3) = {}", shell.name,
                                shown(stiffness / (rho * speed * speed * length * length * length))));
  // Added mass is about as heavy as a body of fluid as thick as the shell is long (docs/numerics/coupling.md).
  if (options.coupling.scheme == config::CouplingScheme::Loose && mass_ratio < 10.0)
    lines.push_back("WARNING: loose coupling is unstable for light shells: luff check finds out whether this one is");
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

std::vector<std::string> describe_groups(const config::Case& options, const Structure& structure,
                                         const grid::Grid* grid)
{
  std::vector<std::string> lines;
  const double speed = grid != nullptr ? reference_speed(options, *grid) : 0.0;
  if (grid != nullptr)
    describe_flow(options, structure, *grid, speed, lines);
  for (const config::ShellOptions& shell : options.shells)
    describe_shell(options, shell, sheet_length(structure), speed, lines);
  for (const SheetRange& sheet : structure.sheets())
    describe_mesh(sheet, lines);
  if (structure.shells().shell)
    describe_patches(*structure.shells().shell, lines);
  return lines;
}

}  // namespace luff::simulation
