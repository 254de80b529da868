// SPDX-License-Identifier: BSD-3-Clause
// The same flow on any number of ranks.
#include <iostream>

#include <gtest/gtest.h>

#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

void expect_same_on_all_ranks(bool with_sheet)
{
  const Signature together = run_stretched_flow(MPI_COMM_WORLD, 50, with_sheet);
  const Signature alone = run_stretched_flow(MPI_COMM_SELF, 50, with_sheet);
  const double difference = alone.difference(together);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == 0)
    std::cout << "  " << ranks << " ranks against one after 50 steps: " << difference << " relative\n";
  EXPECT_LE(difference, 1e-11);
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftySteps)
{
  expect_same_on_all_ranks(/*with_sheet=*/false);
}

TEST(FlowOnRanks, IsThatOfOneRankAfterFiftyStepsAroundAMovingSheet)
{
  expect_same_on_all_ranks(/*with_sheet=*/true);
}

}  // namespace
}  // namespace luff::test
