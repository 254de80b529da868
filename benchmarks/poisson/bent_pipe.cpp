// SPDX-License-Identifier: BSD-3-Clause
// The 19-point pressure equation on a bent pipe, one core.
//
//   benchmark_poisson_bent_pipe [NX NY NZ [ROUNDNESS | section]]      default: 601 101 101 0.45
//
// The section is a square rounded so far, skewed at its corners, or that of the generators of pipes (NY = NZ).
// Without a sheet and with a valve of three leaflets across the pipe: iterations and processor time per cell until the
// net outflow fell by 1e-10, and the time to take in the sheet (the solver knew none before).
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>

#include <mpi.h>

#include "grid/generators/disc_section.hpp"
#include "poisson/flow.hpp"

namespace {

using namespace luff;
using namespace luff::benchmark;

/// Places in the section of a pipe, 0 on its axis and 1 on its wall, by node.
using Section = std::function<Eigen::Vector2d(int, int)>;

/// Between a square (roundness 0) and a disc (1).
Section rounded_square(const Index3& cells, double roundness)
{
  return [=](int j, int k) -> Eigen::Vector2d {
    const double a = 2.0 * j / cells[1] - 1.0;
    const double c = 2.0 * k / cells[2] - 1.0;
    return {a * (1.0 - roundness + roundness * std::sqrt(1.0 - 0.5 * c * c)),
            c * (1.0 - roundness + roundness * std::sqrt(1.0 - 0.5 * a * a))};
  };
}

Section generated(int cells)
{
  return [cells, nodes = grid::disc_section(cells)](int j, int k) { return nodes[j + (cells + 1) * k]; };
}

/// Nodes of a pipe of radius 1, bent by 69 degrees along its length.
grid::NodeSource pipe(const Index3& cells, const Section& section)
{
  return [=](const IndexBox& nodes) {
    std::vector<Vec3> x;
    const double length = 2.0 * cells[0] / cells[1];
    const double angle = 1.2;
    const double radius = std::max(length / angle, 1.3);
    for_each_cell_in_order(nodes, [&](int i, int j, int k) {
      const Eigen::Vector2d place = section(j, k);
      const double turn = length / radius * i / cells[0];
      x.emplace_back((radius + place[0]) * std::sin(turn), (radius + place[0]) * std::cos(turn), place[1]);
    });
    return x;
  };
}

double largest_cosine(const grid::Grid& grid)
{
  return grid.visit([&](const auto& m) {
    double largest = 0.0;
    if constexpr (grid::is_curvilinear<std::decay_t<decltype(m)>>)
      for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
        for (int a = 0; a < 3; ++a)
          for (int b = a + 1; b < 3; ++b)
            largest = std::max(
                largest, std::abs(m.G[grid::symmetric(a, b)](i, j, k)) / std::sqrt(m.G[a](i, j, k) * m.G[b](i, j, k)));
      });
    return largest;
  });
}

void set_fluxes(const grid::Grid& grid, const std::vector<FaceIndex>& blocked, Field3<double>& U)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (int a = 0; a < 3; ++a)
    for_each_cell_in_order(grid.owned().faces(a), [&](int i, int j, int k) {
      const Index3 c{i, j, k};
      const double x = 6.0 * i / grid.cells()[0];
      const double y = 6.0 * j / grid.cells()[1];
      const double z = 6.0 * k / grid.cells()[2];
      const double eddy = a == 0   ? 1.0 + 0.3 * std::sin(y + 0.5 * z + x)
                          : a == 1 ? 0.4 * std::cos(x + 0.7 * z + 0.5 * y)
                                   : 0.4 * std::sin(x - 0.8 * y + 0.6 * z);
      const bool side = c[a] == 0 || c[a] == grid.cells()[a];
      U[a](i, j, k) = (side ? 0.0 : eddy + 0.05 * noise(random)) * grid.area(a, i, j, k);
    });
  for (const FaceIndex& f : blocked)
    U[f.axis].view()(f.cell) = 0.0;
}

void measure(const char* name, const grid::Grid& grid, poisson::PressureSolver& solver,
             const std::vector<FaceIndex>& blocked)
{
  constexpr int rounds = 2;
  double set_up = 1e30;
  double solve = 1e30;
  poisson::Report report;
  Field3<double> U = make_field3<double>(grid.owned());
  for (int round = 0; round < rounds; ++round) {
    set_fluxes(grid, blocked, U);
    Field<double> p(grid.owned());
    solver.set_blocked({});
    const double start = thread_time();
    solver.set_blocked(blocked);
    const double ready = thread_time();
    report = solver.project(views(U), p.view(), 1.0, {.relative = 1e-10});
    solve = std::min(solve, thread_time() - ready);
    set_up = std::min(set_up, ready - start);
  }
  const double per_cell = 1e9 / static_cast<double>(grid.owned().volume());
  std::printf("%-8s  %4d%s  %8.1f  %8.1f\n", name, report.iterations, report.converged ? " " : "!", set_up * per_cell,
              solve * per_cell);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  {
    Index3 cells{601, 101, 101};
    for (int a = 0; a < 3 && argc > 3; ++a)
      cells[a] = std::atoi(argv[1 + a]);
    const bool made = argc > 4 && std::strcmp(argv[4], "section") == 0;
    const Section section = made ? generated(cells[1]) : rounded_square(cells, argc > 4 ? std::atof(argv[4]) : 0.45);
    const grid::Grid grid(MPI_COMM_SELF, cells, pipe(cells, section), {false, false, false});
    const poisson::SideConditions walls{};
    const double start = thread_time();
    const auto solver = poisson::make_pressure_solver(grid, walls);
    std::printf("%dx%dx%d, largest cosine of skew %.2f; to 1e-10, ns of processor time per cell; made in %.0f\n",
                cells[0], cells[1], cells[2], largest_cosine(grid),
                1e9 * (thread_time() - start) / static_cast<double>(grid.owned().volume()));
    std::printf("%-8s  %5s  %8s  %8s\n", "", "its", "set-up", "solve");
    measure("no sheet", grid, *solver, {});
    const auto cut = [&](const Index3& low, const Index3& high) { return cut_by_valve(cells, low, high); };
    measure("valve", grid, *solver, blocked_faces(cells, cut));
  }
  MPI_Finalize();
}
