// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for misspelt names.
#include "core/nearest.hpp"

#include <gtest/gtest.h>

namespace luff {
namespace {

const std::vector<std::string> known{"end", "step", "scheme", "max_iterations"};

TEST(NearestNames, AreFoundThroughOneSlipOfTheHand)
{
  EXPECT_EQ(nearest_name("stp", known), "step");    // left out
  EXPECT_EQ(nearest_name("steep", known), "step");  // doubled
  EXPECT_EQ(nearest_name("stop", known), "step");   // replaced
  EXPECT_EQ(nearest_name("edn", known), "end");     // swapped
  EXPECT_EQ(nearest_name("maxiteration", known), "max_iterations");
}

TEST(NearestNames, AreNotGuessedFromAfar)
{
  EXPECT_EQ(nearest_name("thickness", known), std::nullopt);
  EXPECT_EQ(nearest_name("x", known), std::nullopt);
  EXPECT_EQ(nearest_name("anything", {}), std::nullopt);
}

TEST(Suggestions, NameTheNearestOrElseAll)
{
  EXPECT_EQ(suggestion("stp", known), " (did you mean 'step'?)");
  EXPECT_EQ(suggestion("thickness", known), " (known: end, step, scheme, max_iterations)");
  EXPECT_EQ(suggestion("thickness", {}), "");
}

}  // namespace
}  // namespace luff
