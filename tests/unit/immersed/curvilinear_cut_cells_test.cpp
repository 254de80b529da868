// SPDX-License-Identifier: BSD-3-Clause
// Cut links on curvilinear grids: exact for linear flows on skewed cells, and those of the Cartesian grid on its nodes.
#include <functional>

#include <gtest/gtest.h>

#include "immersed/cross_terms.hpp"
#include "immersed/cut_cells.hpp"
#include "immersed/loads.hpp"
#include "operators/momentum.hpp"
#include "parallel/vector_field.hpp"
#include "support/curvilinear.hpp"
#include "support/faces.hpp"
#include "surface/generators.hpp"

namespace luff::immersed {
namespace {

using grid::Grid;
using Profile = std::function<Vec3(const Vec3&)>;

constexpr Index3 cells{10, 11, 12};
constexpr std::array<bool, 3> no_wrap{false, false, false};
constexpr double viscosity = 0.7;

/// Fields on a grid and the cut links of one sheet.
struct Flow {
  explicit Flow(const Grid& g)
      : grid(g), links(g), u(make_field3<double>(g.owned())), U(make_field3<double>(g.owned())), p(g.owned())
  {
    if (g.kind() == grid::Kind::Curvilinear)
      cross = std::make_unique<CrossTerms>(g);
  }
  void set_velocity(const Profile& velocity)
  {
    for_each_cell_in_order(grid.owned().grown(1), [&](int i, int j, int k) {
      for (int d = 0; d < 3; ++d)
        u[d](i, j, k) = velocity(grid.centre(i, j, k))[d];
    });
    for (int d = 0; d < 3; ++d)
      for_each_cell_in_order(grid.owned().faces(d), [&](int i, int j, int k) {
        U[d](i, j, k) = grid.area_vector(d, i, j, k).dot(velocity(grid.face_centre(d, i, j, k)));
      });
  }
  void set_pressure(const std::function<double(const Vec3&)>& value)
  {
    for_each_cell_in_order(grid.owned().grown(1),
                           [&](int i, int j, int k) { p(i, j, k) = value(grid.centre(i, j, k)); });
  }
  void freeze(const SheetMotion& sheet)
  {
    links.freeze(sheet, 0.1, 1.0, {views(std::as_const(U)), views(std::as_const(U)), 0.0});
    if (!cross)
      return;
    cross->freeze(links);
    cross->update(links, velocity(), {1.0});
  }
  [[nodiscard]] View3<const double> velocity() const { return views(u); }
  [[nodiscard]] CutCellTerms terms(const CutCell& cut) const
  {
    CutCellTerms terms = momentum_terms(links, cut, velocity(), viscosity, {1.0}, {1.0});
    const auto [i, j, k] = cut.cell;
    if (cross)
      terms.explicit_rate += viscosity / grid.volume(i, j, k) * cross->net_outflow(links, cut, velocity());
    return terms;
  }
  [[nodiscard]] LoadFields load_fields(const std::vector<Vec3>& u_star) const
  {
    return {
        .p = p.view(), .u = velocity(), .u_star = u_star, .density = 2.0, .viscosity = viscosity, .cross = cross.get()};
  }
  [[nodiscard]] std::vector<Vec3> velocity_of_cut_cells() const
  {
    std::vector<Vec3> values;
    for (const CutCell& cut : links.cells())
      values.push_back(at(velocity(), cut.cell));
    return values;
  }

  const Grid& grid;
  CutLinks links;
  std::unique_ptr<CrossTerms> cross;
  Field3<double> u, U;
  Field<double> p;
};

SheetMotion moving(const surface::Rectangle& shape, const Profile& velocity)
{
  const surface::TriangleMesh mesh = surface::rectangle(shape);
  SheetMotion sheet{mesh.vertices, {}, std::vector<Vec3>(mesh.vertices.size(), Vec3::Zero()), mesh.triangles};
  for (const Vec3& x : mesh.vertices)
    sheet.velocity.push_back(velocity(x));
  return sheet;
}

const surface::Rectangle tilted{
    .origin = {0.25, 0.3, 0.2}, .a = {0.5, 0.21, 0.1}, .b = {-0.1, 0.3, 0.4}, .divisions = {6, 6}};

/// Oblique cells: angles of 50 to 70 degrees; and their mirror image.
Vec3 oblique(const Vec3& s)
{
  return {s[0] + 0.5 * s[1] - 0.3, s[1] + 0.2 * s[0] - 0.1 + 0.3 * (s[2] - 0.5), s[2] - 0.4 * (s[0] - 0.5)};
}
Vec3 oblique_left_handed(const Vec3& s)
{
  return oblique({s[1], s[0], s[2]});
}

class OnObliqueCells : public ::testing::TestWithParam<Vec3 (*)(const Vec3&)> {
 protected:
  OnObliqueCells() : grid(MPI_COMM_SELF, cells, test::mapped_nodes(cells, GetParam()), no_wrap), flow(grid) {}
  /// Whether a cell and its neighbours lie inside the grid and see all hits as far away as they are.
  [[nodiscard]] bool is_exact(const Index3& cell) const
  {
    for (int axis = 0; axis < 3; ++axis)
      if (cell[axis] == 0 || cell[axis] == cells[axis] - 1)
        return false;
    for (const CutCell& cut : flow.links.cells()) {
      int apart = 0;
      for (int axis = 0; axis < 3; ++axis)
        apart += std::abs(cut.cell[axis] - cell[axis]);
      if (apart < 2 && sees_clipped_hit(cut))
        return false;
    }
    return true;
  }
  [[nodiscard]] bool sees_clipped_hit(const CutCell& cut) const
  {
    for (int link = 0; link < 6; ++link)
      if (cut.face[link] != open_link) {
        const CutFace& face = flow.links.faces()[cut.face[link]];
        const double theta = flow.links.crossings()[link % 2 == 1 ? face.first : face.last].theta;
        if (link % 2 == 1 ? theta < theta_min : theta > 1.0 - theta_min)
          return true;
      }
    return false;
  }

  Grid grid;
  Flow flow;
};

INSTANTIATE_TEST_SUITE_P(OfBothHands, OnObliqueCells, ::testing::Values(&oblique, &oblique_left_handed));

Mat3 some_gradient()
{
  Mat3 gradient;
  gradient << 0.3, -1.0, 0.2, 0.5, 0.1, -0.7, 0.4, 0.9, -0.4;
  return gradient;
}

TEST_P(OnObliqueCells, ALinearFlowThatTheSheetFollowsHasTheExactConvectionAndNoDiffusion)
{
  const Mat3 gradient = some_gradient();
  const Profile velocity = [&](const Vec3& x) -> Vec3 { return Vec3(1.0, -0.5, 0.2) + gradient * x; };
  flow.set_velocity(velocity);
  flow.freeze(moving(tilted, velocity));
  ASSERT_GT(flow.links.cells().size(), 30u);
  int compared = 0;
  for (const CutCell& cut : flow.links.cells()) {
    if (!is_exact(cut.cell))
      continue;
    const CutCellTerms terms = flow.terms(cut);
    const Vec3 here = at(flow.velocity(), cut.cell);
    EXPECT_LE((terms.explicit_rate + terms.wall_source - terms.wall_rate * here + gradient * here).norm(), 1e-10);
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

TEST_P(OnObliqueCells, CrossTermsDoNotReachAcrossTheSheet)
{
  // Two linear flows that meet on the sheet: no diffusion on either side, neither in cut cells nor beside them.
  const Vec3 normal = tilted.a.cross(tilted.b).normalized();
  const Mat3 gradient = some_gradient();
  const Vec3 jump(2.0, -3.0, 1.0);
  // The sheet spans the grid, so that no cell looks around its edge.
  const surface::Rectangle wide{.origin = tilted.origin - 3.0 * (tilted.a + tilted.b),
                                .a = 7.0 * tilted.a,
                                .b = 7.0 * tilted.b,
                                .divisions = {20, 20}};
  const Profile velocity = [&](const Vec3& x) -> Vec3 {
    return gradient * x + jump * std::max(normal.dot(x - tilted.origin), 0.0);
  };
  flow.set_velocity(velocity);
  flow.freeze(moving(wide, velocity));
  auto rate = make_field3<double>(grid.owned());
  auto increment = make_field3<double>(grid.owned());
  for (auto& flux : flow.U)
    flux.fill(0.0);
  operators::advance_momentum(grid, flow.velocity(), views(std::as_const(flow.U)), viscosity, Vec3::Zero(), {1.0, 0.0},
                              views(rate), views(increment));
  ASSERT_GT(flow.cross->neighbours().size(), 100u);
  double uncorrected = 0.0;
  int compared = 0;
  for (const Index3& c : flow.cross->neighbours()) {
    if (!is_exact(c))
      continue;
    const Vec3 bulk = at(views(std::as_const(rate)), c);
    const Vec3 change = viscosity / grid.volume(c[0], c[1], c[2]) * flow.cross->change_in_neighbour(c);
    EXPECT_LE((bulk + change).norm(), 1e-9);
    uncorrected = std::max(uncorrected, bulk.norm());
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_GT(uncorrected, 1.0);
}

TEST_P(OnObliqueCells, ALinearFlowThatTheSheetFollowsIsRecoveredExactly)
{
  const Mat3 gradient = some_gradient();
  const Profile velocity = [&](const Vec3& x) -> Vec3 { return Vec3(1.0, 0.5, 0.0) + gradient * x; };
  flow.set_velocity(velocity);
  flow.freeze(moving(tilted, velocity));
  const Field3<double> exact = flow.u;
  for (auto& component : flow.u)
    component.fill(-7.0);
  recover_velocity(grid, flow.links, views(std::as_const(flow.U)), {1.0}, views(flow.u));
  for (const CutCell& cut : flow.links.cells())
    EXPECT_LE((at(flow.velocity(), cut.cell) - at(views(exact), cut.cell)).norm(), 1e-12);
}

TEST_P(OnObliqueCells, PressureOfTheirOwnSideOnlyIsSeen)
{
  const Vec3 normal = tilted.a.cross(tilted.b).normalized();
  flow.freeze(moving(tilted, [](const Vec3&) { return Vec3(Vec3::Zero()); }));
  const std::array<Vec3, 2> slope{Vec3(2.0, 1.0, -1.0), Vec3(-3.0, 0.5, 2.0)};
  const auto side = [&](const Vec3& x) { return normal.dot(x - tilted.origin) < 0.0 ? 0 : 1; };
  flow.set_pressure([&](const Vec3& x) { return slope[side(x)].dot(x) + 100.0 * side(x); });
  int compared = 0;
  for (const CutCell& cut : flow.links.cells()) {
    bool inner = true;  // away from the sheet's edge, whose neighbours see both sides
    for (int link = 0; link < 6; ++link) {
      const Index3 beside = stepped(cut.cell, link / 2, link % 2 == 0 ? -1 : 1);
      inner = inner && (cut.face[link] != open_link || side(grid.centre(beside)) == side(grid.centre(cut.cell)));
      inner = inner && (cut.face[link] == open_link || cut.face[link ^ 1] == open_link);
    }
    if (!inner)
      continue;
    EXPECT_LE(
        (pressure_gradient(grid, flow.links, cut, std::as_const(flow.p).view()) - slope[side(grid.centre(cut.cell))])
            .norm(),
        1e-10);
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

TEST_P(OnObliqueCells, TheForceAndMomentOfEveryCrossingGoToTheVertices)
{
  const SheetMotion sheet = moving(tilted, [](const Vec3&) { return Vec3(Vec3::Zero()); });
  flow.freeze(sheet);
  const Vec3 normal = tilted.a.cross(tilted.b).normalized();
  flow.set_pressure([&](const Vec3& x) { return normal.dot(x - tilted.origin) > 0.0 ? 3.0 : -1.0; });
  const std::vector<Vec3> u_star(flow.links.cells().size(), Vec3::Zero());
  const SheetLoads loads = sheet_loads(grid, flow.links, flow.load_fields(u_star), sheet.position.size());
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::size_t v = 0; v < sheet.position.size(); ++v) {
    force += loads.force(v);
    moment += sheet.position[v].cross(loads.force(v));
  }
  Vec3 expected_force = Vec3::Zero();
  Vec3 expected_moment = Vec3::Zero();
  for (const Crossing& hit : flow.links.crossings()) {
    const auto [i, j, k] = hit.cell;
    const Vec3 f = -hit.side * 2.0 * 4.0 * grid.area_vector(hit.axis, i, j, k);
    const Vec3 p = grid.centre(stepped(hit.cell, hit.axis, -1));
    expected_force += f;
    expected_moment += Vec3(p + hit.theta * (grid.centre(hit.cell) - p)).cross(f);
  }
  EXPECT_LE((force - expected_force).norm(), 1e-12);
  EXPECT_LE((moment - expected_moment).norm(), 1e-12);
  // The staircase of faces has the sheet's area up to its rim.
  const Vec3 pressure_force = -8.0 * tilted.a.cross(tilted.b);
  EXPECT_LE((force - pressure_force).norm(), 0.3 * pressure_force.norm());
}

TEST_P(OnObliqueCells, ShearOfALinearFlowIsThatOfItsGradient)
{
  // The sheet lies along two index directions, at theta = 0.3 of the links along the third.
  const auto map = GetParam();
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    const Vec3 origin = map(5.8 / cells[axis] * Vec3::Unit(axis) - Vec3::Unit(b) - Vec3::Unit(c));
    const Vec3 along_b = 3.0 * (map(Vec3::Unit(b)) - map(Vec3::Zero()));
    const Vec3 along_c = 3.0 * (map(Vec3::Unit(c)) - map(Vec3::Zero()));
    const SheetMotion sheet = moving({.origin = origin, .a = along_b, .b = along_c, .divisions = {9, 9}},
                                     [](const Vec3&) { return Vec3(Vec3::Zero()); });
    const Vec3 normal = along_b.cross(along_c).normalized();
    const Vec3 tangent = (along_b + 0.3 * along_c).normalized();
    flow.set_velocity([&](const Vec3& x) -> Vec3 {
      const double height = normal.dot(x - origin);
      return (height < 0.0 ? 2.0 : 5.0) * height * tangent;
    });
    flow.freeze(sheet);
    ASSERT_EQ(static_cast<int>(flow.links.faces().size()), cells[b] * cells[c]);
    const auto u_star = flow.velocity_of_cut_cells();
    const SheetLoads loads = sheet_loads(grid, flow.links, flow.load_fields(u_star), sheet.position.size());
    Vec3 below = Vec3::Zero();
    Vec3 above = Vec3::Zero();
    for (std::size_t v = 0; v < sheet.position.size(); ++v) {
      below += loads.minus[v];
      above += loads.plus[v];
    }
    double area = 0.0;
    for (const CutFace& face : flow.links.faces())
      area += grid.area(face.axis, face.cell[0], face.cell[1], face.cell[2]);
    EXPECT_LE((below / area + 2.0 * 2.0 * viscosity * tangent).norm(), 1e-12);
    EXPECT_LE((above / area - 2.0 * 5.0 * viscosity * tangent).norm(), 1e-12);
    for (const SideTraction& t : side_tractions(grid, flow.links, flow.load_fields(u_star), sheet.position.size())) {
      if (t.shear[0].norm() == 0.0)
        continue;  // outside the grid
      EXPECT_LE((t.shear[0] + 2.0 * 2.0 * viscosity * tangent).norm(), 1e-11);
      EXPECT_LE((t.shear[1] - 2.0 * 5.0 * viscosity * tangent).norm(), 1e-11);
    }
  }
}

void expect_same_cut_cells_in_a_box(bool in_part)
{
  const Grid box(MPI_COMM_SELF,
                 {test::stretched_faces(0, 1, cells[0], 0.0), test::stretched_faces(0, 1, cells[1], 0.0),
                  test::stretched_faces(0, 1, cells[2], 0.0)},
                 no_wrap);
  const Grid nodes(MPI_COMM_SELF, cells, test::mapped_nodes(cells, [](const Vec3& s) { return s; }), no_wrap);
  Flow cartesian(box);
  Flow curvilinear(nodes);
  const SheetMotion sheet = moving(tilted, [](const Vec3& x) { return Vec3(x[1], 0.3, -x[0]); });
  for (Flow* flow : {&cartesian, &curvilinear}) {
    if (in_part)
      flow->links.cover_in_part();
    flow->set_velocity([](const Vec3& x) { return Vec3(std::sin(3.0 * x[1]), x[0] * x[2], std::cos(2.0 * x[0])); });
    flow->set_pressure([](const Vec3& x) { return std::sin(4.0 * x[0] + x[1] - x[2]); });
    flow->freeze(sheet);
  }
  ASSERT_EQ(cartesian.links.cells().size(), curvilinear.links.cells().size());
  ASSERT_GT(cartesian.links.cells().size(), 30u);
  constexpr double round_off = 1e-11;  // of rates of order 1/h^2 with clipped distances
  for (std::size_t n = 0; n < cartesian.links.cells().size(); ++n) {
    const CutCell& cut = cartesian.links.cells()[n];
    ASSERT_EQ(cut.face, curvilinear.links.cells()[n].face);
    const CutCellTerms a = cartesian.terms(cut);
    const CutCellTerms b = curvilinear.terms(curvilinear.links.cells()[n]);
    EXPECT_LE((a.explicit_rate - b.explicit_rate).norm(), round_off * a.wall_rate);
    EXPECT_LE((a.wall_source - b.wall_source).norm(), round_off * a.wall_rate);
    EXPECT_LE(
        (pressure_gradient(box, cartesian.links, cut, std::as_const(cartesian.p).view()) -
         pressure_gradient(nodes, curvilinear.links, curvilinear.links.cells()[n], std::as_const(curvilinear.p).view()))
            .norm(),
        round_off);
  }
  const auto u_star = cartesian.velocity_of_cut_cells();
  const SheetLoads loads = sheet_loads(box, cartesian.links, cartesian.load_fields(u_star), sheet.position.size());
  const SheetLoads same = sheet_loads(nodes, curvilinear.links, curvilinear.load_fields(u_star), sheet.position.size());
  for (std::size_t v = 0; v < sheet.position.size(); ++v)
    EXPECT_LE((loads.force(v) - same.force(v)).norm(), round_off);
  for (Flow* flow : {&cartesian, &curvilinear}) {
    flow->links.impose_fluxes({1.0}, views(flow->U));
    recover_velocity(flow->grid, flow->links, views(std::as_const(flow->U)), {1.0}, views(flow->u));
  }
  for (const CutCell& cut : cartesian.links.cells())
    EXPECT_LE((at(cartesian.velocity(), cut.cell) - at(curvilinear.velocity(), cut.cell)).norm(), round_off);
}

TEST(CutCellsOfABoxGivenByItsNodes, AreThoseOfTheCartesianGrid)
{
  expect_same_cut_cells_in_a_box(/*in_part=*/false);
  expect_same_cut_cells_in_a_box(/*in_part=*/true);
}

}  // namespace
}  // namespace luff::immersed
