// SPDX-License-Identifier: BSD-3-Clause
// Cost of a whole step of the flow on one core, and of its parts: uniform, stretched with a moving flag, curvilinear
// without a sheet and with a valve that moves.
//
// Usage: benchmark_fluid_step [uniform|stretched|curvilinear] [CELLS...]      all of them; cells along an edge, default
// 64
//        mpirun -n N benchmark_fluid_step [CELLS...]      the uniform flow only, N cubes of cells on top of each other
//
// CPU time, of the slowest rank per cell of a rank, so that a busy machine matters little. Every step leaves max |div
// U| h/|U| at 5e-14 or below.
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cmath>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/stretched_flow.hpp"
#include "support/surfaces.hpp"

namespace luff::test {
namespace {

using fluid::SideKind;

/// The sheets appear at once: the first steps are theirs.
constexpr int warm_up = 10;
constexpr int steps = 6;

double cpu_seconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A step that a run would refuse is no measure: what diverges needs more iterations.
void require_stable(const char* name, const fluid::FlowSolver& solver, double dt)
{
  const fluid::StepLimits limits = fluid::step_limits(solver.options().scheme);
  const double convective = dt * solver.convective_rate();
  const double diffusive = dt * solver.diffusive_rate();
  if (convective <= limits.convective && diffusive <= limits.diffusive)
    return;
  std::fprintf(stderr, "%s: convective number %.2f of %.2f, diffusive %.2f of %.2f\n", name, convective,
               limits.convective, diffusive, limits.diffusive);
  std::exit(1);
}

/// Prints microseconds per cell and step of a flow, and the parts that its profile knows.
template <class Sheet>
void measure(const char* name, TestFlow& flow, double dt, Sheet sheet)
{
  const auto march = [&](int n) {
    for (int s = 0; s < n; ++s)
      flow.advance(dt, 1, sheet(flow.t + dt));
  };
  march(warm_up);
  flow.solver.profile().reset();
  const double before = cpu_seconds();
  march(steps);
  const double seconds = flow.grid.ranks().max(cpu_seconds() - before);
  require_stable(name, flow.solver, dt);
  if (flow.grid.ranks().rank() != 0)
    return;
  const double scale = 1e6 / (static_cast<double>(flow.grid.owned().volume()) * steps);
  std::printf("%-36s %6.3f us per cell and step;", name, scale * seconds);
  for (const Phase phase : {Phase::Search, Phase::Momentum, Phase::CutCells, Phase::Pressure, Phase::Loads})
    std::printf(" %s %.3f", phase_names[static_cast<int>(phase)], scale * flow.solver.profile().seconds(phase));
  std::printf("; divergence %.1e\n", flow.largest_divergence);
}

const auto no_sheet = [](double) { return immersed::SheetMotion{}; };

void measure_uniform(int n, int cubes)
{
  const TaylorGreen vortices{.viscosity = 0.001};
  const auto faces = stretched_faces(0, 1, n, 0.0);
  TestFlow flow({faces, faces, stretched_faces(0, cubes, n * cubes, 0.0)}, sides_of({true, true, true}, {}),
                {.viscosity = vortices.viscosity});
  flow.solver.start(vortices.function(), 0.0);
  measure("uniform, periodic", flow, 0.5 / n, no_sheet);
}

void measure_stretched(int n)
{
  const auto stream = fluid::VectorFunction::uniform(Vec3::UnitX());
  const fluid::SideBoundary slip{.kind = SideKind::Slip};
  const fluid::Boundaries sides{
      {{fluid::SideBoundary{SideKind::Velocity, stream}, {.kind = SideKind::Outflow}}, {slip, slip}, {slip, slip}}};
  // Widths from 1 to 19.
  const auto faces = stretched_faces(-1, 1, n, -0.9);
  // The diffusion number of the narrowest cells is 0.3 whatever n.
  TestFlow flow({faces, faces, faces}, sides, {.viscosity = 0.04 / n});
  flow.solver.start(stream, 0.0);
  measure("stretched 19:1, heaving flag", flow, 0.1 / n, [](double t) {
    immersed::SheetMotion sheet = heaving_sheet(t);
    for (Vec3& x : sheet.position)
      x[2] -= 0.5;
    return sheet;
  });
}

/// Three leaflets of a cone about the x axis, gaps of a tenth of its radius between them, heaving along the axis.
immersed::SheetMotion heaving_valve(double t)
{
  constexpr double third = 2.0 * std::numbers::pi / 3.0;
  surface::TriangleMesh valve;
  for (int leaflet = 0; leaflet < 3; ++leaflet) {
    // Radius from 0.1 to 0.9, angle over a third of the circle.
    surface::TriangleMesh mesh = surface::rectangle(
        {.origin = {0.1, 0.0, 0.0}, .a = 0.8 * Vec3::UnitX(), .b = third * Vec3::UnitY(), .divisions = {12, 20}});
    const double middle = (leaflet + 0.5) * third;
    for (Vec3& x : mesh.vertices) {
      const double r = x[0];
      const double angle = x[1] + leaflet * third;
      x = {0.3 * (0.9 - r) + 0.1 * std::sin(2.0 * t), r * std::cos(angle) + 0.05 * std::cos(middle),
           r * std::sin(angle) + 0.05 * std::sin(middle)};
    }
    append(valve, mesh);
  }
  const std::size_t vertices = valve.vertices.size();
  return {valve.vertices, std::vector<Vec3>(vertices, 0.2 * std::cos(2.0 * t) * Vec3::UnitX()),
          std::vector<Vec3>(vertices, -0.4 * std::sin(2.0 * t) * Vec3::UnitX()), valve.triangles};
}

template <class Sheet>
void measure_curvilinear(const char* name, int n, Sheet sheet)
{
  const EthierSteinman exact{.viscosity = 0.32 / n};
  const auto map = [wave = Waved{}](const Vec3& s) -> Vec3 { return 2.0 * wave(s) - Vec3::Ones(); };
  TestFlow flow({n, n, n}, mapped_nodes({n, n, n}, map),
                sides_of({false, false, false}, {SideKind::Velocity, exact.function()}),
                {.viscosity = exact.viscosity});
  flow.solver.start(exact.function(), 0.0);
  measure(name, flow, 0.08 / n, sheet);  // between leaflets the flow is three times as fast
}

void measure_both_curvilinear(int n)
{
  measure_curvilinear("curvilinear, largest cosine 0.47", n, no_sheet);
  measure_curvilinear("curvilinear, heaving valve", n, heaving_valve);
}

}  // namespace
}  // namespace luff::test

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool chosen = !arguments.empty() && std::isalpha(arguments[0][0]) != 0;
  const std::string flow = chosen ? arguments[0] : ranks > 1 ? "uniform" : "";
  arguments.erase(arguments.begin(), arguments.begin() + (chosen ? 1 : 0));
  if (arguments.empty())
    arguments = {"64"};
  for (const std::string& cells : arguments) {
    const int n = std::atoi(cells.c_str());
    if (rank == 0)
      std::printf("%d^3 cells on each of %d ranks\n", n, ranks);
    if (flow.empty() || flow == "uniform")
      luff::test::measure_uniform(n, ranks);
    if (flow.empty() || flow == "stretched")
      luff::test::measure_stretched(n);
    if (flow.empty() || flow == "curvilinear")
      luff::test::measure_both_curvilinear(n);
  }
  MPI_Finalize();
}
