// SPDX-License-Identifier: BSD-3-Clause
// The same flow on any number of threads and in any units.
#include <iostream>

#include <gtest/gtest.h>

#include "support/stretched_flow.hpp"

namespace luff::test {
namespace {

TEST(Flow, HasTheSameBitsOnOneAndTwoThreadsWithBothSchemes)
{
  const int threads = omp_get_max_threads();
  for (const auto scheme : {fluid::ImmersedScheme::CutLink, fluid::ImmersedScheme::Curvib}) {
    omp_set_num_threads(1);
    const Signature one = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, scheme);
    omp_set_num_threads(2);
    const Signature two = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, scheme);
    EXPECT_EQ(one.values, two.values);
  }
  omp_set_num_threads(threads);
}

TEST(Flow, HasTheSameBitsWhenLengthAndTimeAreScaledByPowersOfTwo)
{
  for (const auto scheme : {fluid::ImmersedScheme::CutLink, fluid::ImmersedScheme::Curvib}) {
    const Signature plain = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {}, scheme);
    const Signature scaled =
        run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {.length = 0x1p-9, .time = 0x1p3}, scheme);
    EXPECT_EQ(plain.values, scaled.values);
  }
}

TEST(Flow, HasTheSameDigitsInMillimetresAndMilliseconds)
{
  const Signature plain = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true);
  const Signature scaled = run_stretched_flow(MPI_COMM_SELF, 20, /*with_sheet=*/true, {.length = 13.7, .time = 420.0});
  const double difference = plain.difference(scaled);
  std::cout << "  other units: " << difference << " relative\n";
  EXPECT_LE(difference, 1e-11);
}

}  // namespace
}  // namespace luff::test
