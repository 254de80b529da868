// SPDX-License-Identifier: BSD-3-Clause
// Ranks: what a step costs each of them, what the machine itself allows, and what they say to one another.
//
// Usage: mpirun -n N benchmark_fluid_scaling [CELLS [ROUNDS]]      cells along an edge, default 96; rounds, default 3
//
// The uniform periodic flow of benchmark_fluid_step in four settings, in turn, the cheapest round of each:
//
//   alone         one rank steps a cube of cells, the others sleep
//   side by side  every rank steps a cube of its own and talks to nobody: what shared caches and memory cost, and so
//   the
//                 ceiling of any efficiency on this machine
//   weak          a cube for each rank, on top of each other, as one flow
//   strong        one cube for all of them
//
// CPU time of the slowest rank per cell of a rank, which counts waiting: MPI spins.  "outside MPI" leaves that out, and
// with it what a busy machine makes of it.  Then messages, bytes and reductions per rank and step, counted at MPI's own
// profiling interface, and what one of each costs here: the model of benchmarks/fluid/scaling.py.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <vector>

#include "support/exact_flows.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

constexpr int warm_up = 2;
constexpr int steps = 4;

double cpu_seconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What this rank has said since the last reset.
struct Traffic {
  double messages = 0.0;
  double bytes = 0.0;
  double reductions = 0.0;  ///< collective calls of a few numbers
  double gatherings = 0.0;  ///< sums over ranks of the first level that all of them hold: one per multigrid cycle
  double gathered = 0.0;    ///< bytes of those
  double seconds = 0.0;     ///< CPU time inside MPI

  [[nodiscard]] Traffic per(int n) const
  {
    return {messages / n, bytes / n, reductions / n, gatherings / n, gathered / n, seconds / n};
  }
};
Traffic traffic;

/// Times one call of MPI.
class InMpi {
 public:
  InMpi() : start_(cpu_seconds()) {}
  InMpi(const InMpi&) = delete;
  InMpi& operator=(const InMpi&) = delete;
  ~InMpi() { traffic.seconds += cpu_seconds() - start_; }

 private:
  double start_;
};

double bytes_of(int count, MPI_Datatype type)
{
  int size = 0;
  MPI_Type_size(type, &size);
  return static_cast<double>(count) * size;
}

}  // namespace
}  // namespace luff::test

// MPI's profiling interface: calls of the libraries arrive here.
extern "C" {

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request)
{
  const luff::test::InMpi timer;
  if (to != MPI_PROC_NULL) {
    luff::test::traffic.messages += 1.0;
    luff::test::traffic.bytes += luff::test::bytes_of(count, type);
  }
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request)
{
  const luff::test::InMpi timer;
  return PMPI_Irecv(data, count, type, from, tag, comm, request);
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses)
{
  const luff::test::InMpi timer;
  return PMPI_Waitall(count, requests, statuses);
}

int MPI_Neighbor_alltoall(const void* data, int count, MPI_Datatype type, void* received, int received_count,
                          MPI_Datatype received_type, MPI_Comm comm)
{
  const luff::test::InMpi timer;
  luff::test::traffic.messages += 2.0;
  luff::test::traffic.bytes += 2.0 * luff::test::bytes_of(count, type);
  return PMPI_Neighbor_alltoall(data, count, type, received, received_count, received_type, comm);
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  const luff::test::InMpi timer;
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const double bytes = luff::test::bytes_of(count, type);
  constexpr double few = 1024;
  if (ranks > 1 && bytes > few) {
    luff::test::traffic.gatherings += 1.0;
    luff::test::traffic.gathered += bytes;
  } else if (ranks > 1) {
    luff::test::traffic.reductions += 1.0;
  }
  return PMPI_Allreduce(data, result, count, type, op, comm);
}

}  // extern "C"

namespace luff::test {
namespace {

/// Waits for the others without using the processor.
void sleep_until_all_are_here(MPI_Comm comm)
{
  constexpr timespec nap{0, 2'000'000};
  MPI_Request request{};
  MPI_Ibarrier(comm, &request);
  int done = 0;
  while (MPI_Test(&request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && done == 0)
    nanosleep(&nap, nullptr);
}

/// Of a step, in microseconds per cell of this rank.
struct Cost {
  double all = std::numeric_limits<double>::max();
  double outside_mpi = std::numeric_limits<double>::max();
  Traffic per_step;
};

Cost cheaper(const Cost& a, const Cost& b)
{
  Cost best = b.all < a.all ? b : a;
  best.outside_mpi = std::min(a.outside_mpi, b.outside_mpi);
  return best;
}

/// The slowest rank's.
Cost slowest(const Cost& mine)
{
  std::array<double, 2> cost{mine.all, mine.outside_mpi};
  MPI_Allreduce(MPI_IN_PLACE, cost.data(), 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return {cost[0], cost[1], mine.per_step};
}

/// Steps `flow` with the body of benchmark_fluid_step.
Cost cost_of(TestFlow& flow, double dt)
{
  const auto march = [&](int n) {
    for (int s = 0; s < n; ++s)
      flow.advance(dt, 1, immersed::SheetMotion{});
  };
  march(warm_up);
  traffic = {};
  const double before = cpu_seconds();
  march(steps);
  const double seconds = cpu_seconds() - before;
  const double scale = 1e6 / (static_cast<double>(flow.grid.owned().volume()) * steps);
  return {scale * seconds, scale * (seconds - traffic.seconds), traffic.per(steps)};
}

Cost step_cubes(MPI_Comm comm, int n, int cubes)
{
  const TaylorGreen vortices{.viscosity = 0.001};
  const auto faces = stretched_faces(0, 1, n, 0.0);
  TestFlow flow({faces, faces, stretched_faces(0, cubes, n * cubes, 0.0)}, sides_of({true, true, true}, {}),
                {.viscosity = vortices.viscosity}, comm);
  flow.solver.start(vortices.function(), 0.0);
  return cost_of(flow, 0.5 / n);
}

/// Least CPU seconds of an act that all ranks do together.
template <class Act>
double least_seconds(Act act)
{
  constexpr int repeats = 200;
  double least = std::numeric_limits<double>::max();
  for (int r = 0; r < repeats; ++r) {
    const double before = cpu_seconds();
    act();
    least = std::min(least, cpu_seconds() - before);
  }
  PMPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return least;
}

/// A message to the next rank of a ring, and one from the one before.
double exchange_seconds(int rank, int ranks, int bytes)
{
  std::vector<char> out(bytes), in(bytes);
  return least_seconds([&] {
    MPI_Sendrecv(out.data(), bytes, MPI_BYTE, (rank + 1) % ranks, 0, in.data(), bytes, MPI_BYTE,
                 (rank + ranks - 1) % ranks, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
}

double reduction_seconds()
{
  double x = 1.0;
  return least_seconds([&] { PMPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD); });
}

void print(const char* name, const Cost& cost, const Cost& alone)
{
  std::printf("%-14s %.3f us per cell and step, %5.1f %% of alone; outside MPI %.3f, %5.1f %%", name, cost.all,
              100.0 * alone.all / cost.all, cost.outside_mpi, 100.0 * alone.outside_mpi / cost.outside_mpi);
  if (cost.per_step.messages > 0.0)
    std::printf("; %.1f messages, %.1f kB, %.2f reductions, %.2f gatherings with %.1f kB per step and rank",
                cost.per_step.messages, 1e-3 * cost.per_step.bytes, cost.per_step.reductions, cost.per_step.gatherings,
                1e-3 * cost.per_step.gathered);
  std::printf("\n");
}

void measure(int n, int rounds)
{
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  Cost alone, beside, weak, strong;
  for (int r = 0; r < rounds; ++r) {
    Cost now;
    if (rank == 0)
      now = step_cubes(MPI_COMM_SELF, n, 1);
    else
      now.all = now.outside_mpi = 0.0;
    sleep_until_all_are_here(MPI_COMM_WORLD);
    alone = cheaper(alone, slowest(now));
    beside = cheaper(beside, slowest(step_cubes(MPI_COMM_SELF, n, 1)));
    weak = cheaper(weak, slowest(step_cubes(MPI_COMM_WORLD, n, ranks)));
    strong = cheaper(strong, slowest(step_cubes(MPI_COMM_WORLD, n, 1)));
  }
  constexpr int small = 8;
  constexpr int large = 1 << 18;
  const double message = exchange_seconds(rank, ranks, small);
  const double byte = (exchange_seconds(rank, ranks, large) - message) / large;
  const double reduction = reduction_seconds();
  if (rank != 0)
    return;
  std::printf("%d ranks, %d^3 cells, cheapest of %d rounds\n", ranks, n, rounds);
  print("alone", alone, alone);
  print("side by side", beside, alone);
  print("weak", weak, alone);
  print("strong", strong, alone);
  std::printf("a message %.2f us, %.2f GB/s; a reduction %.2f us\n", 1e6 * message, 1e-9 / byte, 1e6 * reduction);
}

}  // namespace
}  // namespace luff::test

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  constexpr int cells = 96;
  constexpr int rounds = 3;
  luff::test::measure(argc > 1 ? std::atoi(argv[1]) : cells, argc > 2 ? std::atoi(argv[2]) : rounds);
  MPI_Finalize();
}
