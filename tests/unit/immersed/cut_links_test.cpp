// SPDX-License-Identifier: BSD-3-Clause
// Momentum, velocity, flux and load at the links that a sheet cuts.
#include "immersed/cut_links.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "immersed/cut_cells.hpp"
#include "immersed/loads.hpp"
#include "operators/momentum.hpp"
#include "parallel/vector_field.hpp"
#include "support/faces.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

using Profile = std::function<Vec3(const Vec3&)>;

/// A sheet whose vertices move with a velocity profile.
SheetMotion moving(const surface::Rectangle& shape, const Profile& velocity)
{
  const surface::TriangleMesh mesh = surface::rectangle(shape);
  SheetMotion sheet{mesh.vertices, {}, std::vector<Vec3>(mesh.vertices.size(), Vec3::Zero()), mesh.triangles};
  for (const Vec3& x : mesh.vertices)
    sheet.velocity.push_back(velocity(x));
  return sheet;
}

SheetMotion upright(double x, double speed = 0.0)
{
  return moving({.origin = {x, 0.2, 0.2}, .a = {0.0, 0.6, 0.0}, .b = {0.0, 0.0, 0.6}, .divisions = {4, 4}},
                [speed](const Vec3&) { return Vec3(speed, 0.0, 0.0); });
}

const surface::Rectangle tilted{
    .origin = {0.25, 0.3, 0.2}, .a = {0.5, 0.21, 0.1}, .b = {-0.1, 0.3, 0.4}, .divisions = {6, 6}};

class CutCells : public ::testing::Test {
 protected:
  CutCells()
      : grid(MPI_COMM_SELF,
             {test::stretched_faces(0, 1, 10, 0.3), test::stretched_faces(0, 1, 10, -0.2),
              test::stretched_faces(0, 1, 10, 0.1)},
             {false, false, false}),
        links(grid),
        u(make_field3<double>(grid.owned())),
        U(make_field3<double>(grid.owned())),
        U_before(make_field3<double>(grid.owned())),
        p(grid.owned())
  {
  }
  void set_flow(const Profile& velocity)
  {
    for_each_cell_in_order(grid.owned().grown(1), [&](int i, int j, int k) {
      for (int d = 0; d < 3; ++d)
        u[d](i, j, k) = velocity(grid.centre(i, j, k))[d];
    });
    for (int d = 0; d < 3; ++d)
      for_each_cell_in_order(grid.owned().faces(d), [&](int i, int j, int k) {
        Vec3 x = grid.centre(i, j, k);
        x[d] = grid.face(d, Index3{i, j, k}[d]);
        U[d](i, j, k) = grid.area(d, i, j, k) * velocity(x)[d];
      });
  }
  void set_pressure(const std::function<double(const Vec3&)>& value)
  {
    for_each_cell_in_order(grid.owned().grown(1),
                           [&](int i, int j, int k) { p(i, j, k) = value(grid.centre(i, j, k)); });
  }
  void freeze(const SheetMotion& sheet, double dt = 0.1, double speed = 1.0)
  {
    links.freeze(sheet, dt, speed, {views(std::as_const(U)), views(std::as_const(U_before)), dt});
  }
  [[nodiscard]] Vec3 place(const Crossing& hit) const
  {
    Vec3 x = grid.centre(hit.cell[0], hit.cell[1], hit.cell[2]);
    x[hit.axis] -= (1.0 - hit.theta) * grid.distance(hit.axis, hit.cell[hit.axis]);
    return x;
  }

  grid::Grid grid;
  CutLinks links;
  Field3<double> u, U, U_before;
  Field<double> p;
};

TEST_F(CutCells, OfALinearFlowThatTheSheetFollowsHaveTheExactConvectionAndNoDiffusion)
{
  Mat3 gradient;
  gradient << 0.3, -1.0, 0.2, 0.5, 0.1, -0.7, 0.4, 0.9, -0.4;
  const Profile velocity = [&](const Vec3& x) -> Vec3 { return Vec3(1.0, -0.5, 0.2) + gradient * x; };
  set_flow(velocity);
  freeze(moving(tilted, velocity));
  ASSERT_GT(links.cells().size(), 30u);
  int compared = 0;
  for (const CutCell& cut : links.cells()) {
    bool clipped = false;
    for (const int f : cut.face)
      if (f != open_link) {
        const double theta = links.crossings()[links.faces()[f].first].theta;
        clipped = clipped || theta < theta_min || theta > 1.0 - theta_min;
      }
    if (clipped)
      continue;
    const CutCellTerms terms = momentum_terms(links, cut, views(std::as_const(u)), 0.7, {1.0}, {1.0});
    const Vec3 here = at(views(std::as_const(u)), cut.cell);
    const Vec3 rate = terms.explicit_rate + terms.wall_source - terms.wall_rate * here;
    EXPECT_LE((rate + gradient * here).norm(), 1e-10);
    EXPECT_LE((wall_source(links, cut, 0.7, {1.0}) - terms.wall_source).norm(), 1e-13);
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

TEST_F(CutCells, KnowWhereTheSheetWasDuringTheStep)
{
  const Vec3 velocity(0.1, -0.25, 0.3);
  const double dt = 0.02;
  freeze(moving(tilted, [&](const Vec3&) { return velocity; }), dt);
  for (const double fraction : {0.0, 0.4}) {
    surface::Rectangle before = tilted;
    before.origin -= (1.0 - fraction) * dt * velocity;
    CutLinks then(grid);
    then.freeze(moving(before, [&](const Vec3&) { return velocity; }), dt, 1.0,
                {views(std::as_const(U)), views(std::as_const(U)), 0.0});
    int compared = 0;
    for (std::size_t q = 0; q < links.crossings().size(); ++q)
      for (const Crossing& hit : then.crossings()) {
        const Crossing& now = links.crossings()[q];
        if (hit.axis != now.axis || hit.cell != now.cell)
          continue;
        EXPECT_NEAR(links.theta(static_cast<int>(q), {fraction}), hit.theta, 1e-12);
        ++compared;
      }
    EXPECT_GT(compared, 30);
  }
}

TEST_F(CutCells, RecoverALinearFlowThatTheSheetFollowsExactly)
{
  const Profile velocity = [](const Vec3& x) -> Vec3 { return {1.0 + x[0], 0.5 - 2.0 * x[1], x[2]}; };
  set_flow(velocity);
  freeze(moving(tilted, velocity));
  const Field3<double> exact = u;
  for (auto& component : u)
    component.fill(-7.0);
  recover_velocity(grid, links, views(std::as_const(U)), {1.0}, views(u));
  for (const CutCell& cut : links.cells())
    EXPECT_LE((at(views(std::as_const(u)), cut.cell) - at(views(exact), cut.cell)).norm(), 1e-13);
}

TEST_F(CutCells, TakeTheVelocityOfASheetThatReachesTheirCentre)
{
  set_flow([](const Vec3&) { return Vec3(1.0, 0.0, 0.0); });
  for (const double distance : {1e-2, 1e-4, 1e-6}) {
    freeze(upright(grid.centre(0, 5) + distance, 0.25));
    recover_velocity(grid, links, views(std::as_const(U)), {1.0}, views(u));
    EXPECT_NEAR(u[0](5, 5, 5), 0.25, 0.75 * distance / (0.5 * grid.width(0, 5)));
  }
}

TEST_F(CutCells, SeeThePressureOfTheirOwnSideOnly)
{
  const double x_sheet = 0.47;
  freeze(upright(x_sheet));
  set_pressure([&](const Vec3& x) { return x[0] < x_sheet ? 2.0 * x[0] + x[1] : 100.0 - 3.0 * x[0] + x[1]; });
  ASSERT_FALSE(links.cells().empty());
  for (const CutCell& cut : links.cells()) {
    const double slope = grid.centre(0, cut.cell[0]) < x_sheet ? 2.0 : -3.0;
    EXPECT_LE((pressure_gradient(grid, links, cut, std::as_const(p).view()) - Vec3(slope, 1.0, 0.0)).norm(), 1e-11);
  }
}

TEST_F(CutCells, BetweenTwoSheetsFeelNoGradientAcrossThem)
{
  SheetMotion two = upright(grid.centre(0, 5) - 0.01);
  const SheetMotion other = upright(grid.centre(0, 5) + 0.01);
  const int n = static_cast<int>(two.position.size());
  two.position.insert(two.position.end(), other.position.begin(), other.position.end());
  two.velocity.resize(2 * n, Vec3::Zero());
  two.acceleration.resize(2 * n, Vec3::Zero());
  for (const auto& [a, b, c] : other.triangles)
    two.triangles.push_back({a + n, b + n, c + n});
  freeze(two);
  set_pressure([](const Vec3& x) { return 5.0 * x[0] + x[2]; });
  int between = 0;
  for (const CutCell& cut : links.cells())
    if (cut.cell[0] == 5) {
      EXPECT_LE((pressure_gradient(grid, links, cut, std::as_const(p).view()) - Vec3(0.0, 0.0, 1.0)).norm(), 1e-11);
      ++between;
    }
  EXPECT_GT(between, 0);
}

TEST_F(CutCells, FluxOfANewlyCutFaceGoesOnAsItWasAndReturnsToThatOfTheSheet)
{
  const double dt = 0.02;
  const double speed = 2.0;
  const double acceleration = 3.0;
  SheetMotion sheet = upright(0.47, 0.25);
  sheet.acceleration.assign(sheet.position.size(), Vec3(acceleration, 0.0, 0.0));
  const auto with_flow_before = [&](double before, const std::function<double(double)>& rate_within) {
    set_flow([&](const Vec3&) { return Vec3(before, 0.0, 0.0); });
    U_before = U;
    set_flow([](const Vec3&) { return Vec3(1.0, 0.0, 0.0); });
    CutLinks fresh(grid);
    for (double t = 0.0; t < 2.5 * dt; t += dt) {
      fresh.freeze(sheet, dt, speed, {views(std::as_const(U)), views(std::as_const(U_before)), dt});
      const CutFace& face = fresh.faces().front();
      const double tau = shell_decay * grid.distance(0, face.cell[0]) / speed;
      for (const double fraction : {0.0, 0.5, 1.0}) {
        fresh.impose_fluxes({fraction}, views(U));
        const double since = t + fraction * dt;
        const double offset = (0.75 + (rate_within(tau) + 0.75 / tau) * since) * std::exp(-since / tau);
        EXPECT_NEAR(U[0].view()(face.cell) / grid.area(0, face.cell[0], face.cell[1], face.cell[2]),
                    0.25 - (1.0 - fraction) * dt * acceleration + offset, 1e-14)
            << "before " << before << ", t = " << since;
      }
      fresh.accept(views(std::as_const(U)));
    }
  };
  with_flow_before(1.1, [&](double) { return (1.0 - 1.1) / dt - acceleration; });
  with_flow_before(0.9, [](double) { return 0.0; });  // away from the sheet: not followed
  with_flow_before(5.0, [](double tau) { return -3.0 * 0.75 / tau; });
}

TEST_F(CutCells, AreCutAtTheStartWithoutARate)
{
  set_flow([](const Vec3&) { return Vec3(1.0, 0.0, 0.0); });
  const SheetMotion sheet = upright(0.47, 0.25);
  links.freeze(sheet, 0.02, 2.0, {views(std::as_const(U)), views(std::as_const(U_before)), 0.0});
  ASSERT_FALSE(links.faces().empty());
  for (const CutFace& face : links.faces()) {
    EXPECT_EQ(face.rate, 0.0);
  }
}

TEST_F(CutCells, WhoseCentreTheSheetPassedAreFoundOnceAndNoOthers)
{
  const double centre = grid.centre(0, 5);
  freeze(upright(centre - 0.01));
  EXPECT_TRUE(links.flipped().empty());
  links.accept(views(std::as_const(U)));
  freeze(upright(centre - 0.002));
  EXPECT_TRUE(links.flipped().empty());
  links.accept(views(std::as_const(U)));
  freeze(upright(centre + 0.004));
  EXPECT_FALSE(links.flipped().empty());
  EXPECT_EQ(links.flipped().size(), links.faces().size());
  for (const Index3& cell : links.flipped())
    EXPECT_EQ(cell[0], 5);
  links.accept(views(std::as_const(U)));
  freeze(upright(centre + 0.01));
  EXPECT_TRUE(links.flipped().empty());
}

TEST_F(CutCells, HandTheForceAndMomentOfEveryCrossingToTheVertices)
{
  const SheetMotion sheet = moving(tilted, [](const Vec3&) { return Vec3::Zero(); });
  set_flow([](const Vec3&) { return Vec3::Zero(); });
  freeze(sheet);
  const Vec3 normal =
      surface::area_vector(tilted.origin, tilted.origin + tilted.a, tilted.origin + tilted.b).normalized();
  set_pressure([&](const Vec3& x) { return normal.dot(x - tilted.origin) > 0.0 ? 3.0 : -1.0; });
  const std::vector<Vec3> u_star(links.cells().size(), Vec3::Zero());
  const SheetLoads loads = sheet_loads(
      grid, links,
      {.p = std::as_const(p).view(), .u = views(std::as_const(u)), .u_star = u_star, .density = 2.0, .viscosity = 0.1},
      sheet.position.size());
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::size_t v = 0; v < sheet.position.size(); ++v) {
    force += loads.force(v);
    moment += sheet.position[v].cross(loads.force(v));
  }
  Vec3 expected_force = Vec3::Zero();
  Vec3 expected_moment = Vec3::Zero();
  for (const Crossing& hit : links.crossings()) {
    const double A = grid.area(hit.axis, hit.cell[0], hit.cell[1], hit.cell[2]);
    const Vec3 f = -hit.side * 2.0 * 4.0 * A * Vec3::Unit(hit.axis);
    expected_force += f;
    expected_moment += place(hit).cross(f);
  }
  EXPECT_LE((force - expected_force).norm(), 1e-12);
  EXPECT_LE((moment - expected_moment).norm(), 1e-12);
  EXPECT_GT(force.norm(), 1.0);
}

TEST_F(CutCells, ShearOfALinearFlowIsThatOfItsGradient)
{
  const double x_sheet = 0.3 * grid.centre(0, 4) + 0.7 * grid.centre(0, 5);
  const Profile velocity = [&](const Vec3& x) -> Vec3 {
    return {0.0, (x[0] < x_sheet ? 2.0 : 5.0) * (x[0] - x_sheet), 0.0};
  };
  set_flow(velocity);
  freeze(upright(x_sheet));
  std::vector<Vec3> u_star;
  for (const CutCell& cut : links.cells())
    u_star.push_back(at(views(std::as_const(u)), cut.cell));
  p.fill(0.0);
  const auto tractions = side_tractions(
      grid, links,
      {.p = std::as_const(p).view(), .u = views(std::as_const(u)), .u_star = u_star, .density = 2.0, .viscosity = 0.1},
      25);
  for (const SideTraction& t : tractions) {
    EXPECT_NEAR(t.shear[0][1], -0.2 * 2.0, 1e-12);
    EXPECT_NEAR(t.shear[1][1], 0.2 * 5.0, 1e-12);
  }
}

}  // namespace
}  // namespace luff::immersed
