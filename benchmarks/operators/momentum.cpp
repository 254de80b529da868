// SPDX-License-Identifier: BSD-3-Clause
// One sweep of the momentum equation: time per cell, against the memory's bandwidth by a triad in the same run.
//
// Usage: benchmark_operators_momentum [NX NY NZ]      default 128 128 128
//
// Bytes are the fewest: each value a sweep needs read once, each result written once.  All threads, or the GPU.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "operators/momentum.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"

namespace luff::test {
namespace {

/// Shortest time of several rounds, per cell [ns].  The first one, which may move memory to the GPU, does not count.
template <class Work>
double nanoseconds(const IndexBox& box, Work work)
{
  using Clock = std::chrono::steady_clock;
  constexpr int rounds = 20;
  double shortest = std::numeric_limits<double>::max();
  work();
  for (int n = 0; n < rounds; ++n) {
    const auto start = Clock::now();
    work();
    shortest = std::min(shortest, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  return shortest / static_cast<double>(box.volume());
}

void print(const char* name, double time, int doubles)
{
  const double bytes = static_cast<double>(sizeof(double)) * doubles;
  std::printf("%-24s %9.4f ns per cell  %4.0f bytes  %8.1f GB/s\n", name, time, bytes, bytes / time);
}

Field3<double> filled(const IndexBox& owned, double value)
{
  return {Field<double>(owned, value), Field<double>(owned, 0.7 * value), Field<double>(owned, 0.3 * value)};
}

/// Doubles of a sweep per cell: per component on straight grids, all at once with the metric on curvilinear ones.
int doubles_of_sweep(grid::Kind kind)
{
  constexpr int straight = 3 * (1 + 3 + 2 + 2);       // u, U; rate and increment read and written
  constexpr int curvilinear = 3 + 3 + 6 + 6 + 6 + 1;  // u, U; the same; G, V
  return kind == grid::Kind::Curvilinear ? curvilinear : straight;
}

void time_sweep(const char* name, const grid::Grid& grid)
{
  const Field3<double> u = filled(grid.owned(), 0.4);
  const Field3<double> U = filled(grid.owned(), 0.2);
  Field3<double> rate = filled(grid.owned(), 0.1);
  Field3<double> du = filled(grid.owned(), 0.05);
  const auto triad = [&] { operators::extrapolate(grid.owned(), u[0].view(), U[0].view(), 0.5, du[0].view()); };
  print("triad", nanoseconds(grid.owned(), triad), 3);
  const auto sweep = [&] {
    operators::advance_momentum(grid, views(u), views(U), 1e-3, Vec3::UnitX(), {.new_rate = 1e-3, .old_rate = -5e-4},
                                views(rate), views(du));
  };
  print(name, nanoseconds(grid.owned(), sweep), doubles_of_sweep(grid.kind()));
}

void time_all(const Index3& cells)
{
  const auto faces = [&](double amplitude) {
    return std::array{stretched_faces(0.0, 1.0, cells[0], amplitude), stretched_faces(0.0, 1.0, cells[1], amplitude),
                      stretched_faces(0.0, 1.0, cells[2], amplitude)};
  };
  const std::array<bool, 3> periodic{true, true, true};
  time_sweep("uniform", {MPI_COMM_WORLD, faces(0.0), periodic});
  time_sweep("rectilinear", {MPI_COMM_WORLD, faces(0.3), periodic});
  time_sweep("curvilinear", {MPI_COMM_WORLD, cells, mapped_nodes(cells, Waved{}), periodic});
}

}  // namespace
}  // namespace luff::test

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  luff::Index3 cells{128, 128, 128};
  for (int a = 0; a < 3 && argc == 4; ++a)
    cells[a] = std::atoi(argv[a + 1]);
  luff::test::time_all(cells);
  MPI_Finalize();
}
