// SPDX-License-Identifier: BSD-3-Clause
// Cost of a whole step of the flow on one core, and of its parts: uniform, stretched with a moving flag, curvilinear.
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
#include <ctime>
#include <string>
#include <vector>

#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

using fluid::SideKind;

constexpr int warm_up = 3;
constexpr int steps = 6;

/// The diffusion number is that of 64 cells and .005 whatever the size: beyond it explicit steps are unstable.
double stable_viscosity(int n)
{
  return 0.32 / n;
}

double cpu_seconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
  TestFlow flow({faces, faces, faces}, sides, {.viscosity = stable_viscosity(n)});
  flow.solver.start(stream, 0.0);
  measure("stretched 19:1, heaving flag", flow, 0.1 / n, [](double t) {
    immersed::SheetMotion sheet = heaving_sheet(t);
    for (Vec3& x : sheet.position)
      x[2] -= 0.5;
    return sheet;
  });
}

void measure_curvilinear(int n)
{
  const EthierSteinman exact{.viscosity = stable_viscosity(n)};
  const auto map = [wave = Waved{}](const Vec3& s) -> Vec3 { return 2.0 * wave(s) - Vec3::Ones(); };
  TestFlow flow({n, n, n}, mapped_nodes({n, n, n}, map),
                sides_of({false, false, false}, {SideKind::Velocity, exact.function()}),
                {.viscosity = exact.viscosity});
  flow.solver.start(exact.function(), 0.0);
  measure("curvilinear, largest cosine 0.47", flow, 0.1 / n, no_sheet);
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
      luff::test::measure_curvilinear(n);
  }
  MPI_Finalize();
}
