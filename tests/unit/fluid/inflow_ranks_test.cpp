// SPDX-License-Identifier: BSD-3-Clause
// Flow rates and pressures on sides that several ranks share.
#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/flow.hpp"

namespace luff::test {
namespace {

using fluid::FlowProfile;
using fluid::SideBoundary;
using fluid::SideKind;

/// In through all of z_min, out through pressure on x_max; walls elsewhere.
std::unique_ptr<TestFlow> bend(MPI_Comm comm)
{
  const SideBoundary wall{.kind = SideKind::Wall};
  SideBoundary inlet{.kind = SideKind::Velocity};
  inlet.flow_rate = {.into = [](double t) { return 0.4 + 0.1 * std::cos(20.0 * t); },
                     .constant = false,
                     .profile = FlowProfile::Womersley,
                     .period = 0.1 * std::numbers::pi};
  SideBoundary outlet{.kind = SideKind::Pressure};
  outlet.pressure = {[](const Vec3& x, double t) { return 1.0 + x[1] + 3.0 * t; }, false};
  auto flow = std::make_unique<TestFlow>(
      std::array{stretched_faces(0, 1, 10, 0.3), stretched_faces(0, 1, 12, -0.3), stretched_faces(0, 1, 14, 0.2)},
      fluid::Boundaries{{{wall, outlet}, {wall, wall}, {inlet, wall}}}, fluid::FlowOptions{.viscosity = 0.02}, comm);
  flow->solver.start(fluid::VectorFunction::uniform(Vec3::Zero()), 0.0);
  flow->advance(0.01, 10);
  return flow;
}

TEST(SidesOfSeveralRanks, GiveTheFlowOfOne)
{
  const auto together = bend(MPI_COMM_WORLD);
  const auto alone = bend(MPI_COMM_SELF);
  const auto u = views(together->solver.state().u);
  const auto v = views(alone->solver.state().u);
  double largest = 0.0;
  for_each_cell_in_order(together->grid.owned(), [&](int i, int j, int k) {
    for (int d = 0; d < 3; ++d)
      largest = std::max(largest, std::abs(u[d](i, j, k) - v[d](i, j, k)));
  });
  EXPECT_LE(largest, 1e-11);
  double entering = 0.0;
  const IndexBox& owned = together->grid.owned();
  for (int j = owned.lo[1]; owned.lo[2] == 0 && j < owned.hi[1]; ++j)
    for (int i = owned.lo[0]; i < owned.hi[0]; ++i)
      entering += together->solver.state().U[2].view()(i, j, 0);
  EXPECT_NEAR(together->grid.ranks().sum(entering), 0.4 + 0.1 * std::cos(20.0 * together->t), 1e-14);
}

}  // namespace
}  // namespace luff::test
