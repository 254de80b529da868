// SPDX-License-Identifier: BSD-3-Clause
// Iterations of the pressure solve on grids of any size with any body, by luff alone.
//
//   benchmark_poisson_iterations [NX NY NZ]...       default: cubes of 64, 96 and 128, and 561 201 201 (4 GB, minutes)
//
// Prints iterations and processor time per cell (set-up of the blocked faces and solve, cheapest of two) until the net
// outflow fell by 1e-10.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <mpi.h>

#include "poisson/projection.hpp"

namespace {

using namespace luff;
using namespace luff::benchmark;

void measure(const char* name, const Index3& cells, double ratio, Sheet sheet)
{
  const Flow flow({name, cells, ratio, sheet, false});
  Luff luff(flow);
  Timing best;
  for (int round = 0; round < 2; ++round)
    luff.run(best);
  const double per_cell = 1e9 / static_cast<double>(flow.grid.owned().volume());
  std::printf("%4dx%dx%d  %-22s  %4d%s  %8.1f  %8.1f\n", cells[0], cells[1], cells[2], name, best.iterations,
              best.converged ? " " : "!", best.set_up * per_cell, best.solve * per_cell);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  std::vector<Index3> sizes;
  for (int a = 1; a + 2 < argc; a += 3)
    sizes.push_back({std::atoi(argv[a]), std::atoi(argv[a + 1]), std::atoi(argv[a + 2])});
  if (sizes.empty())
    sizes = {{64, 64, 64}, {96, 96, 96}, {128, 128, 128}, {561, 201, 201}};
  std::printf("to 1e-10, ns of processor time per cell; ! = not converged\n");
  std::printf("%-36s  %5s  %8s  %8s\n", "case", "its", "set-up", "solve");
  for (const Index3& cells : sizes) {
    measure("uniform", cells, 1.0, Sheet::None);
    measure("flag", cells, 1.0, Sheet::Flag);
    measure("valve", cells, 1.0, Sheet::Valve);
    measure("stretched 20:1", cells, 20.0, Sheet::None);
    measure("stretched 20:1, flag", cells, 20.0, Sheet::Flag);
    measure("stretched 20:1, valve", cells, 20.0, Sheet::Valve);
  }
  MPI_Finalize();
}
