// SPDX-License-Identifier: BSD-3-Clause
// Vorticity, Q and samples of a linear flow are exact, on stretched grids and however many ranks there are.
#include <gtest/gtest.h>

#include "simulation/flow_fields.hpp"
#include "support/flow.hpp"

namespace luff::simulation {
namespace {

/// u = u_0 + G x with tr G = 0, prescribed on all sides of a stretched grid.
class LinearFlow : public testing::Test {
 protected:
  LinearFlow()
  {
    G_ << 0.3, -1.2, 0.7, 2.0, 0.4, -0.6, -0.9, 1.1, -0.7;
    flow_ = std::make_unique<test::TestFlow>(
        std::array{test::stretched_faces(-1.0, 1.0, 10, 0.4), test::stretched_faces(0.0, 3.0, 9, -0.3),
                   test::stretched_faces(-0.5, 0.5, 8, 0.2)},
        test::all_sides(fluid::SideKind::Velocity, velocity()), fluid::FlowOptions{.viscosity = 0.01});
    flow_->solver.start(velocity(), 0.0);
    flow_->solver.fill_halos();
  }
  Vec3 exact(const Vec3& x) const { return u_0_ + G_ * x; }
  fluid::VectorFunction velocity() const
  {
    return {[this](const Vec3& x, double) { return exact(x); }, /*constant=*/false};
  }

  Vec3 u_0_{0.2, -0.4, 1.0};
  Mat3 G_;
  std::unique_ptr<test::TestFlow> flow_;
};

constexpr double single = 2e-6;  ///< rounding of the fields, which are written in single precision

TEST_F(LinearFlow, HasItsVorticityInEveryCell)
{
  const Vec3 omega(G_(2, 1) - G_(1, 2), G_(0, 2) - G_(2, 0), G_(1, 0) - G_(0, 1));
  const std::array what{config::FlowField::Vorticity};
  const auto field = std::get<std::vector<float>>(flow_snapshot(flow_->solver, what).fields[0].values);
  ASSERT_EQ(field.size(), 3 * static_cast<std::size_t>(flow_->grid.owned().volume()));
  for (std::size_t n = 0; n < field.size(); ++n)
    EXPECT_NEAR(field[n], omega[n % 3], single) << n;
}

TEST_F(LinearFlow, HasItsQInEveryCell)
{
  const double Q = -0.5 * (G_ * G_).trace();
  const std::array what{config::FlowField::QCriterion};
  const auto field = std::get<std::vector<float>>(flow_snapshot(flow_->solver, what).fields[0].values);
  for (const float q : field)
    EXPECT_NEAR(q, Q, single);
}

TEST_F(LinearFlow, IsSampledExactlyAtAnyPoint)
{
  for (const Vec3& x : {Vec3(0.0, 1.5, 0.0), Vec3(0.317, 0.41, -0.123), Vec3(-0.999, 0.002, 0.4999),
                        Vec3(1.0, 3.0, 0.5), Vec3(-1.0, 0.0, -0.5)}) {
    const PointSample here = sample(flow_->solver, grid::locate(flow_->grid, x).value());
    EXPECT_LT((here.velocity - exact(x)).norm(), 1e-12) << x.transpose();
    EXPECT_NEAR(here.pressure, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace luff::simulation
