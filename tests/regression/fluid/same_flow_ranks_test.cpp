// SPDX-License-Identifier: BSD-3-Clause
// The same flow on any number of ranks.
#include <iostream>

#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

void expect_same(const Signature& together, const Signature& alone, double tolerance = 1e-11)
{
  const double difference = alone.difference(together);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == 0)
    std::cout << "  " << ranks << " ranks against one: " << difference << " relative\n";
  EXPECT_LE(difference, tolerance);
}

/// What ranks differ by is what projections before the last leave, in proportion: with 1e-9, 1e-11 and 1e-12 of it the
/// scheme curvib on two ranks differs by 1.2e-11, 2.7e-13 and 3.1e-14.
void expect_same_on_all_ranks(bool with_sheet, fluid::FlowOptions options = {})
{
  options.stage_reduction = 1e-12;
  const auto run = [&](MPI_Comm comm) { return run_stretched_flow(comm, 50, with_sheet, {}, options); };
  expect_same(run(MPI_COMM_WORLD), run(MPI_COMM_SELF), 1e-12);
}

/// Every velocity and pressure of Ethier and Steinman's flow in skewed cells between curved sides, summed with weights.
Signature run_curvilinear_flow(MPI_Comm comm)
{
  const EthierSteinman exact{.viscosity = 0.05};
  const Index3 cells{14, 12, 16};
  const auto map = [wave = Waved{}](const Vec3& s) -> Vec3 { return 2.0 * wave(s) - Vec3::Ones(); };
  TestFlow flow(cells, mapped_nodes(cells, map),
                sides_of({false, false, false}, {fluid::SideKind::Velocity, exact.function()}),
                {.viscosity = exact.viscosity}, comm);
  flow.solver.start(exact.function(), 0.0);
  flow.advance(0.01, 50);
  Signature signature;
  const auto u = views(flow.solver.state().u);
  const auto p = flow.solver.state().p.view();
  for (int k = 0; k < cells[2]; k += 3)
    for (int j = 0; j < cells[1]; j += 3) {
      const Index3 probe{j % 14, j, k};
      const bool mine = flow.grid.owned().contains(probe);
      for (int d = 0; d < 3; ++d)
        signature.values.push_back(flow.grid.ranks().sum(mine ? u[d](probe) : 0.0));
      signature.values.push_back(flow.grid.ranks().sum(mine ? p(probe) : 0.0));
    }
  return signature;
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftySteps)
{
  expect_same_on_all_ranks(/*with_sheet=*/false);
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftyStepsAroundAMovingSheet)
{
  expect_same_on_all_ranks(/*with_sheet=*/true);
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftyStepsAroundAMovingSheetWithTheSchemeCurvib)
{
  expect_same_on_all_ranks(/*with_sheet=*/true, {.immersed = fluid::ImmersedScheme::Curvib});
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftyStepsAroundAMovingSheetWhoseEdgesCoverInPart)
{
  expect_same_on_all_ranks(/*with_sheet=*/true, {.edges_cover_in_part = true});
}

/// Krylov's method stops where the residual is small, which depends on the ranks: its tolerance is 1e-11 of the speed.
TEST(FlowOnRanks, IsThatOfOneRankAfterTwentyImplicitStepsAroundAMovingSheet)
{
  for (const auto immersed : {fluid::ImmersedScheme::CutLink, fluid::ImmersedScheme::Curvib}) {
    const auto run = [immersed](MPI_Comm comm) {
      return run_stretched_flow(comm, 20, /*with_sheet=*/true, {},
                                {.scheme = fluid::TimeScheme::NewtonKrylov, .immersed = immersed});
    };
    expect_same(run(MPI_COMM_WORLD), run(MPI_COMM_SELF), 1e-9);
  }
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftyStepsOnACurvilinearGrid)
{
  expect_same(run_curvilinear_flow(MPI_COMM_WORLD), run_curvilinear_flow(MPI_COMM_SELF));
}

}  // namespace
}  // namespace luff::test
