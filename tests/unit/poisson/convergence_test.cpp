// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include <gtest/gtest.h>

#include "curvilinear_cases.hpp"

namespace luff::poisson {
namespace {

using std::numbers::pi;

/// Face coordinates x(s) = s + a sin(2 pi s) / (2 pi), s = i/n: widths differ by (1 + a) / (1 - a).
std::vector<double> smoothly_stretched(int n, double a)
{
  std::vector<double> x(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    x[i] = s + a * std::sin(2.0 * pi * s) / (2.0 * pi);
  }
  x[n] = 1.0;
  return x;
}

struct Solution {
  double (*p)(double x, double y, double z);
  Vec3 (*gradient)(double x, double y, double z);
};

/// All sides p_n = 0.
const Solution closed{
    [](double x, double y, double z) { return std::cos(pi * x) * std::cos(2.0 * pi * y) * std::cos(pi * z); },
    [](double x, double y, double z) -> Vec3 {
      return {-pi * std::sin(pi * x) * std::cos(2.0 * pi * y) * std::cos(pi * z),
              -2.0 * pi * std::cos(pi * x) * std::sin(2.0 * pi * y) * std::cos(pi * z),
              -pi * std::cos(pi * x) * std::cos(2.0 * pi * y) * std::sin(pi * z)};
    }};
/// p = 0 on x = 1 and z = 0, p_n = 0 elsewhere.
const Solution open{
    [](double x, double y, double z) { return std::cos(0.5 * pi * x) * std::cos(pi * y) * std::sin(0.5 * pi * z); },
    [](double x, double y, double z) -> Vec3 {
      return {-0.5 * pi * std::sin(0.5 * pi * x) * std::cos(pi * y) * std::sin(0.5 * pi * z),
              -pi * std::cos(0.5 * pi * x) * std::sin(pi * y) * std::sin(0.5 * pi * z),
              0.5 * pi * std::cos(0.5 * pi * x) * std::cos(pi * y) * std::cos(0.5 * pi * z)};
    }};

/// L2 error of the pressure whose gradient takes the exact one out of the fluxes.
double pressure_error(int n, double stretching, const Solution& exact, const SideConditions& sides)
{
  const auto line = smoothly_stretched(n, stretching);
  const grid::Grid grid(MPI_COMM_SELF, {line, line, line}, {false, false, false});
  Field3<double> U = make_field3<double>(grid.owned());
  test::for_faces(grid, [&](const FaceIndex& f) {
    std::array<double, 3> x;
    std::array<int, 3> inner = f.cell;
    for (int a = 0; a < 3; ++a)
      x[a] = a == f.axis ? grid.face(a, f.cell[a]) : grid.centre(a, f.cell[a]);
    inner[f.axis] = std::min(inner[f.axis], n - 1);
    U[f.axis](f.cell[0], f.cell[1], f.cell[2]) =
        grid.area(f.axis, inner[0], inner[1], inner[2]) * exact.gradient(x[0], x[1], x[2])[f.axis];
  });
  Field<double> p(grid.owned());
  const Report report = make_pressure_solver(grid, sides)->project(views(U), p.view(), 1.0, {.relative = 1e-11});
  EXPECT_TRUE(report.converged);
  // Between walls both pressures have zero mean, the exact one up to the error of the midpoint rule.
  const auto sum = [&](auto value) {
    double total = 0.0;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 x = grid.centre(i, j, k);
          total += grid.volume(i, j, k) * value(p(i, j, k) - exact.p(x[0], x[1], x[2]));
        }
    return total;
  };
  return std::sqrt(sum([](double error) { return error * error; }));
}

double observed_order(double stretching, const Solution& exact, const SideConditions& sides)
{
  return std::log2(pressure_error(16, stretching, exact, sides) / pressure_error(32, stretching, exact, sides));
}

constexpr auto N = SideCondition::Neumann;
constexpr auto D = SideCondition::Dirichlet;

TEST(Pressure, IsSecondOrderBetweenWalls)
{
  const SideConditions walls{{{N, N}, {N, N}, {N, N}}};
  EXPECT_GE(observed_order(0.0, closed, walls), 1.9);
  EXPECT_GE(observed_order(0.5, closed, walls), 1.9);
}

TEST(Pressure, IsSecondOrderWhereSidesPrescribeIt)
{
  const SideConditions sides{{{N, D}, {N, N}, {D, N}}};
  EXPECT_GE(observed_order(0.0, open, sides), 1.9);
  EXPECT_GE(observed_order(0.5, open, sides), 1.9);
}

/// p_n = 0 on the sides of the unit cube and on both sides of the plane y = 1/2, where a sheet makes p jump.
double jumping(const Vec3& x, bool above)
{
  return std::cos(pi * x[0]) * std::cos(2.0 * pi * x[1]) * std::cos(pi * x[2]) * (above ? -2.0 : 1.0);
}
Vec3 gradient_of_jumping(const Vec3& x, bool above)
{
  return (above ? -2.0 : 1.0) * Vec3(-pi * std::sin(pi * x[0]) * std::cos(2.0 * pi * x[1]) * std::cos(pi * x[2]),
                                     -2.0 * pi * std::cos(pi * x[0]) * std::sin(2.0 * pi * x[1]) * std::cos(pi * x[2]),
                                     -pi * std::cos(pi * x[0]) * std::cos(2.0 * pi * x[1]) * std::sin(pi * x[2]));
}

struct Errors {
  double norm = 0.0, largest = 0.0, gradient = 0.0;
};

/// Grid lines slide along the sides and along the sheet, so that they meet them at an angle.
Errors errors_on_slid_grid(int n, double amplitude, bool sheet)
{
  test::CurvilinearProblem problem{{n, n, n}, test::Slid{amplitude}};
  const grid::Grid grid = problem.grid();
  const auto above = [&](int j) { return sheet && j >= n / 2; };
  std::vector<FaceIndex> blocked;
  Field3<double> U = make_field3<double>(grid.owned());
  test::for_faces(grid, [&](const FaceIndex& f) {
    const auto [i, j, k] = f.cell;
    if (sheet && f.axis == 1 && j == n / 2)
      blocked.push_back(f);
    else if (!test::on_side(grid, f))
      U[f.axis](i, j, k) =
          grid.area_vector(f.axis, i, j, k).dot(gradient_of_jumping(grid.face_centre(f.axis, i, j, k), above(j)));
  });
  Field<double> p(grid.owned());
  const auto solver = make_pressure_solver(grid, problem.conditions());
  solver->set_blocked(blocked);
  const Report report = solver->project(views(U), p.view(), 1.0, {.relative = 1e-11});
  EXPECT_TRUE(report.converged);
  Field<double> error(grid.owned());
  std::array<double, 2> mean{}, volume{};  // on each side of the sheet
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    error(i, j, k) = p(i, j, k) - jumping(grid.centre(i, j, k), above(j));
    mean[above(j)] += grid.volume(i, j, k) * error(i, j, k);
    volume[above(j)] += grid.volume(i, j, k);
  });
  for_each_cell_in_order(grid.owned(),
                         [&](int i, int j, int k) { error(i, j, k) -= mean[above(j)] / volume[above(j)]; });
  Errors result;
  double exact = 0.0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const double e = error(i, j, k);
    result.norm += grid.volume(i, j, k) * e * e;
    result.largest = std::max(result.largest, std::abs(e));
    for (int a = 0; a < 3; ++a) {
      const Index3 low = stepped({i, j, k}, a, -1);
      if (low[a] < 0 || above(j) != above(low[1]))
        continue;
      const double d = e - error.view()(low);
      const double d_exact =
          jumping(grid.centre(i, j, k), above(j)) - jumping(grid.centre(low[0], low[1], low[2]), above(j));
      result.gradient += d * d;
      exact += d_exact * d_exact;
    }
  });
  result.norm = std::sqrt(result.norm);
  result.gradient = std::sqrt(result.gradient / exact);
  return result;
}

void expect_second_order(double amplitude, bool sheet)
{
  const Errors coarse = errors_on_slid_grid(20, amplitude, sheet);
  const Errors fine = errors_on_slid_grid(40, amplitude, sheet);
  const auto order = [](double a, double b) { return std::log2(a / b); };
  EXPECT_GE(order(coarse.norm, fine.norm), 1.9) << amplitude << sheet;
  EXPECT_GE(order(coarse.largest, fine.largest), 1.9) << amplitude << sheet;
  EXPECT_GE(order(coarse.gradient, fine.gradient), 1.9) << amplitude << sheet;
}

TEST(Pressure, IsSecondOrderOnASkewedGridBetweenSlantedWalls)
{
  expect_second_order(0.12, false);
  expect_second_order(0.08, false);
}

TEST(Pressure, IsSecondOrderOnBothSidesOfASheetOnASkewedGrid)
{
  expect_second_order(0.12, true);
  expect_second_order(0.08, true);
}

}  // namespace
}  // namespace luff::poisson
