// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cases.hpp"

namespace luff::poisson {
namespace {

using namespace test;

std::vector<NamedCase> all_cases()
{
  return {
      {"flag, uniform", {{24, 26, 22}, 1.0, "NNNNNN"}, flag},
      {"flag, stretched, outflow", {{24, 26, 22}, 6.0, "NDNNNN"}, flag},
      {"flag, periodic, odd", {{25, 21, 23}, 2.0, "NDPPPP"}, flag},
      {"closed box inside", {{20, 26, 26}, 2.0, "NNNNNN"}, closed_box},
      {"slab", {{48, 40, 1}, 3.0, "NDNNNN"}, flag},
      {"flag, two levels shared out", {{60, 66, 62}, 1.0, "NDNNNN"}, flag},
      {"orifice, two levels shared out, periodic", {{60, 62, 66}, 2.0, "NNPPPP"}, orifice(0.05)},
  };
}

/// The values of a field over the whole domain, on every rank.
std::vector<double> whole(const grid::Grid& grid, const Field<double>& field, const IndexBox& box)
{
  const Index3 n{grid.cells()[0] + 1, grid.cells()[1] + 1, grid.cells()[2] + 1};
  std::vector<double> values(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0.0);
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        values[i + static_cast<std::size_t>(n[0]) * (j + static_cast<std::size_t>(n[1]) * k)] = field(i, j, k);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, grid.ranks().comm());
  return values;
}

TEST(ProjectionOnRanks, GivesTheAnswerOfOneRank)
{
  for (const NamedCase& c : all_cases()) {
    Problem shared = c.problem;
    shared.comm = MPI_COMM_WORLD;
    const grid::Grid grid = shared.grid();
    const Projection together = project(shared, grid, c.cuts, tight);
    EXPECT_TRUE(together.report.converged) << c.name;
    EXPECT_LE(divergence(grid, together.U), 1e-13) << c.name;
    const grid::Grid alone = c.problem.grid();
    const Projection single = project(c.problem, alone, c.cuts, tight);
    EXPECT_NEAR(together.report.iterations, single.report.iterations, 3) << c.name;
    const std::vector<double> p = whole(grid, together.p, grid.owned());
    const std::vector<double> p1 = whole(alone, single.p, alone.owned());
    double scale = 0.0;
    double worst = 0.0;
    for (std::size_t q = 0; q < p.size(); ++q) {
      scale = std::max(scale, std::abs(p1[q]));
      worst = std::max(worst, std::abs(p[q] - p1[q]));
    }
    EXPECT_LE(worst, 1e-11 * scale) << c.name;
  }
}

TEST(ProjectionOnRanks, LeavesTheSameBitsOnBothSidesOfASharedFace)
{
  for (const NamedCase& c : all_cases()) {
    Problem shared = c.problem;
    shared.comm = MPI_COMM_WORLD;
    const grid::Grid grid = shared.grid();
    Projection result = project(shared, grid, c.cuts, tight);
    HaloExchange halo(grid.ranks());
    for (int a = 0; a < 3; ++a) {
      const Field<double> own = result.U[a];
      halo.exchange({result.U[a].view()});
      const IndexBox faces = grid.owned().faces(a);
      int different = 0;
      for (int k = faces.lo[2]; k < faces.hi[2]; ++k)
        for (int j = faces.lo[1]; j < faces.hi[1]; ++j)
          for (int i = faces.lo[0]; i < faces.hi[0]; ++i)
            different += own(i, j, k) != result.U[a](i, j, k) ? 1 : 0;
      EXPECT_EQ(different, 0) << c.name << " axis " << a << " rank " << grid.ranks().rank();
    }
  }
}

TEST(ProjectionOnRanks, FillsTheHaloOfThePressure)
{
  Problem shared{{16, 18, 20}, 3.0, "NDPPNN"};
  shared.comm = MPI_COMM_WORLD;
  const grid::Grid grid = shared.grid();
  Projection result = project(shared, grid, flag, tight);
  const Field<double> returned = result.p;
  HaloExchange halo(grid.ranks());
  halo.exchange({result.p.view()});
  const IndexBox box = grid.owned();
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int i = box.lo[0]; i < box.hi[0]; ++i) {
      EXPECT_EQ(returned(i, box.lo[1] - 1, k), result.p(i, box.lo[1] - 1, k));
      EXPECT_EQ(returned(i, box.hi[1], k), result.p(i, box.hi[1], k));
    }
}

TEST(ProjectionOnRanks, AgreesWithPetscOnTheSameRanks)
{
  Problem shared{{20, 18, 16}, 3.0, "NDNNPP"};
  shared.comm = MPI_COMM_WORLD;
  const grid::Grid grid = shared.grid();
  const Projection ours = project(shared, grid, flag, tight);
  const Projection petsc = project(shared, grid, flag, {.divergence = 2e-13, .max_iterations = 500}, "petsc");
  EXPECT_TRUE(petsc.report.converged);
  EXPECT_LE(difference(grid, ours.p, petsc.p), 1e-10 * largest(grid, petsc.p));
}

}  // namespace
}  // namespace luff::poisson
