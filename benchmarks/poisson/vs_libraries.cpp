// SPDX-License-Identifier: BSD-3-Clause
// Projections by luff against hypre's structured multigrid (PFMG), hypre's BoomerAMG, PETSc's GAMG and PETSc's
// geometric multigrid, all with conjugate gradients, in turns within one run.
//
//   benchmark_poisson_vs_libraries [--pfmg] [CELLS...]       default: 96 128; --pfmg: that peer only, seconds
//
// Prints iterations and processor time per cell (set-up of the blocked faces or of the matrix's hierarchy, and solve)
// until the net outflow fell by 1e-10, and how many times luff's time together the peer took.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include <mpi.h>

#include "poisson/peers.hpp"
#include "poisson/projection.hpp"

namespace {

using namespace luff;
using namespace luff::benchmark;

constexpr int rounds = 3;

/// One core's bandwidth [B/s]: the triad of McCalpin's STREAM, 24 B per element.
double triad_bandwidth()
{
  const std::size_t n = 20'000'000;
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  double best = 1e30;
  for (int round = 0; round < 5; ++round) {
    const double start = thread_time();
    for (std::size_t i = 0; i < n; ++i)
      a[i] = b[i] + 3.0 * c[i];
    best = std::min(best, thread_time() - start);
    std::swap(a[round], b[round]);
  }
  return 24.0 * static_cast<double>(n) / best;
}

void compare(const Case& c, bool all_peers)
{
  const Flow flow(c);
  Luff luff(flow);
  Pfmg pfmg(flow);
  std::vector<Timing> times(2);
  for (int round = 0; round < rounds; ++round) {
    luff.run(times[0]);
    pfmg.run(times[1]);
  }
  luff.run(times[0]);
  // Minutes: once.
  for (const auto peer :
       {Petsc::Preconditioner::BoomerAmg, Petsc::Preconditioner::Gamg, Petsc::Preconditioner::Geometric})
    if (all_peers)
      Petsc(flow, peer).run(times.emplace_back());
  const std::array<const char*, 5> names{"luff", "hypre PFMG", "BoomerAMG", "PETSc GAMG", "PETSc MG"};
  const double per_cell = 1e9 / (static_cast<double>(c.cells[0]) * c.cells[1] * c.cells[2]);
  const double ours = times[0].set_up + times[0].solve;
  for (std::size_t n = 0; n < times.size(); ++n) {
    const Timing& t = times[n];
    std::printf("%-26s  %-10s  %4d%s  %8.1f  %8.1f  %8.1f  %6.1f\n", n == 0 ? c.name.c_str() : "", names[n],
                t.iterations, t.converged ? " " : "!", t.set_up * per_cell, t.solve * per_cell,
                (t.set_up + t.solve) * per_cell, (t.set_up + t.solve) / ours);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  HYPRE_Init();
  PetscInitializeNoArguments();
  std::vector<int> sizes;
  bool all_peers = true;
  for (int a = 1; a < argc; ++a)
    if (std::strcmp(argv[a], "--pfmg") == 0)
      all_peers = false;
    else
      sizes.push_back(std::atoi(argv[a]));
  if (sizes.empty())
    sizes = {96, 128};
  std::printf("to 1e-10, ns of processor time per cell; ! = not converged; one core moves %.1f GB/s (triad)\n",
              1e-9 * triad_bandwidth());
  std::printf("%-26s  %-10s  %5s  %8s  %8s  %8s  %6s\n", "case", "", "its", "set-up", "solve", "together", "ratio");
  for (const int n : sizes) {
    const Index3 cells{n, n, n};
    const std::string size = std::to_string(n) + "^3 ";
    compare({size + "uniform", cells, 1.0, Sheet::None, false}, all_peers);
    compare({size + "stretched 20:1", cells, 20.0, Sheet::None, false}, all_peers);
    compare({size + "flag", cells, 1.0, Sheet::Flag, false}, all_peers);
    compare({size + "valve", cells, 1.0, Sheet::Valve, false}, all_peers);
  }
  PetscFinalize();
  HYPRE_Finalize();
  MPI_Finalize();
}
