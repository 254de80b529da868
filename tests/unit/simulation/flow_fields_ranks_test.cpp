// SPDX-License-Identifier: BSD-3-Clause
// Vorticity, Q and samples of a linear flow are exact, on stretched grids and however many ranks there are.
#include <gtest/gtest.h>

#include "simulation/flow_fields.hpp"
#include "simulation/flow_points.hpp"
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
    const PointSample here = sample(flow_->solver, std::array{grid::locate(flow_->grid, x).value()}).front();
    EXPECT_LT((here.velocity - exact(x)).norm(), 1e-12) << x.transpose();
    EXPECT_NEAR(here.pressure, 0.0, 1e-12);
  }
}

/// Twice the area of all triangles.
double twice_area(const output::SurfaceSnapshot& surface)
{
  double sum = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]).norm();
  return sum;
}

TEST_F(LinearFlow, IsExactOnASliceThatReachesAllSides)
{
  const std::array what{config::FlowField::Velocity, config::FlowField::Vorticity};
  const output::PointBlock block = flow_points(flow_->solver, what, /*bodies=*/false);
  const Vec3 normal(0.3, 0.0, 1.0);
  const output::SurfaceSnapshot slice =
      output::gathered(output::cut_by_plane(block, {0.1, 1.0, 0.05}, normal), MPI_COMM_WORLD);
  if (flow_->grid.ranks().rank() != 0)
    return;
  // It meets neither the top nor the bottom: its shadow is the whole of x and y.
  EXPECT_NEAR(0.5 * twice_area(slice), 2.0 * 3.0 * normal.norm(), 1e-6);
  const auto& u = std::get<std::vector<float>>(slice.point_fields[0].values);
  const auto& omega = std::get<std::vector<float>>(slice.point_fields[1].values);
  ASSERT_EQ(u.size(), 3 * slice.points.size());
  const Vec3 spin(G_(2, 1) - G_(1, 2), G_(0, 2) - G_(2, 0), G_(1, 0) - G_(0, 1));
  for (std::size_t n = 0; n < slice.points.size(); ++n)
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(u[3 * n + d], exact(slice.points[n])[d], 3 * single);
      EXPECT_NEAR(omega[3 * n + d], spin[d], 3 * single);
    }
}

TEST_F(LinearFlow, HasASurfaceWhereItsSpeedHasOneValue)
{
  const std::array of{config::FlowField::Velocity};
  const output::PointBlock block = flow_points(flow_->solver, of, /*bodies=*/false);
  const std::vector<float> speed = magnitudes(block.fields.front());
  const output::SurfaceSnapshot surface = output::gathered(output::surface_of_value(block, speed, 3.0), MPI_COMM_WORLD);
  if (flow_->grid.ranks().rank() != 0)
    return;
  ASSERT_GT(surface.triangles.size(), 20U);
  for (const Vec3& x : surface.points)
    EXPECT_NEAR(exact(x).norm(), 3.0, 0.1);  // the speed is no linear function: |G|^2 h^2/(8 |u|) along each axis
}

}  // namespace
}  // namespace luff::simulation
