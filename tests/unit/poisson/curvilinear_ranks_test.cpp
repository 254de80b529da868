// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "curvilinear_cases.hpp"

namespace luff::poisson {
namespace {

using namespace test;

std::vector<NamedCurvilinearCase> shared_cases()
{
  std::vector<NamedCurvilinearCase> cases = curvilinear_cases();
  std::erase_if(cases, [](const auto& c) { return c.problem.cells[2] == 1; });
  cases.push_back({"slab", {{48, 40, 1}, Slid{}, "NDNNNN"}, flag});
  cases.push_back({"two levels shared out", {{60, 62, 66}, BentPipe{0.9}, "NDNNNN"}, orifice(0.05)});
  cases.push_back({"two levels shared out, periodic", {{60, 66, 62}, luff::test::Waved{}, "NDPPPP"}, flag});
  return cases;
}

/// Values over the whole domain, on every rank.
std::vector<double> whole(const grid::Grid& grid, const Field<double>& field)
{
  const Index3& n = grid.cells();
  std::vector<double> values(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0.0);
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    values[i + static_cast<std::size_t>(n[0]) * (j + static_cast<std::size_t>(n[1]) * k)] = field(i, j, k);
  });
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, grid.ranks().comm());
  return values;
}

TEST(CurvilinearProjectionOnRanks, GivesTheAnswerOfOneRank)
{
  for (const NamedCurvilinearCase& c : shared_cases()) {
    CurvilinearProblem shared = c.problem;
    shared.comm = MPI_COMM_WORLD;
    const grid::Grid grid = shared.grid();
    const Projection together = project(shared, grid, c.sheet, tight);
    EXPECT_TRUE(together.report.converged) << c.name;
    EXPECT_LE(curvilinear_divergence(grid, together.U), 1e-13) << c.name;
    const grid::Grid alone = c.problem.grid();
    const Projection single = project(c.problem, alone, c.sheet, tight);
    // Cells do not merge across the edges of blocks, so the hierarchies differ.
    EXPECT_NEAR(together.report.iterations, single.report.iterations, std::max(4.0, 0.2 * single.report.iterations))
        << c.name;
    const std::vector<double> p = whole(grid, together.p);
    const std::vector<double> p1 = whole(alone, single.p);
    double scale = 0.0;
    double worst = 0.0;
    for (std::size_t q = 0; q < p.size(); ++q) {
      scale = std::max(scale, std::abs(p1[q]));
      worst = std::max(worst, std::abs(p[q] - p1[q]));
    }
    EXPECT_LE(worst, 1e-10 * scale) << c.name;
  }
}

TEST(CurvilinearProjectionOnRanks, LeavesTheSameBitsOnBothSidesOfASharedFace)
{
  for (const NamedCurvilinearCase& c : shared_cases()) {
    CurvilinearProblem shared = c.problem;
    shared.comm = MPI_COMM_WORLD;
    const grid::Grid grid = shared.grid();
    Projection result = project(shared, grid, c.sheet, tight);
    HaloExchange halo(grid.ranks());
    for (int a = 0; a < 3; ++a) {
      const Field<double> own = result.U[a];
      halo.exchange({result.U[a].view()});
      int different = 0;
      for_each_cell_in_order(grid.owned().faces(a),
                             [&](int i, int j, int k) { different += own(i, j, k) != result.U[a](i, j, k) ? 1 : 0; });
      EXPECT_EQ(different, 0) << c.name << " axis " << a << " rank " << grid.ranks().rank();
    }
  }
}

}  // namespace
}  // namespace luff::poisson
