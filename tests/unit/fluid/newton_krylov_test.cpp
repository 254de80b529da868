// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/newton_krylov.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "support/faces.hpp"

namespace luff::fluid {
namespace {

class Newton : public ::testing::Test {
 protected:
  /// x <- f(x), cell by cell and component by component.
  template <class Function>
  NewtonKrylov::Map map(Function f)
  {
    return [this, f](const View3<double>& values) {
      ++evaluations;
      for (const View<double>& component : values)
        for_each_cell_in_order(grid.owned(),
                               [&](int i, int j, int k) { component(i, j, k) = f(component(i, j, k), i); });
    };
  }
  static void keep(const View3<double>&) {}

  grid::Grid grid{
      MPI_COMM_SELF,
      {test::stretched_faces(0, 1, 5, 0), test::stretched_faces(0, 1, 4, 0), test::stretched_faces(0, 1, 3, 0)},
      {true, true, true}};
  Field3<double> x = make_field3<double>(grid.owned());
  int evaluations = 0;
};

TEST_F(Newton, SolvesAnEquationWithoutContractionInFewSteps)
{
  // x = 3 - i - x - x^3: the iteration x <- T(x) runs away.
  NewtonKrylov newton(grid, map([](double v, int i) { return 3.0 - i - v - v * v * v; }), keep);
  const NewtonReport report = newton.solve(views(x), 1e-12);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 12);
  EXPECT_LE(report.residual, 1e-12);
  EXPECT_GE(evaluations, report.iterations + report.krylov_iterations);
  for (int i = 0; i < 5; ++i) {
    const double v = x[1](i, 2, 1);
    EXPECT_NEAR(2.0 * v + v * v * v, 3.0 - i, 1e-10);
  }
}

TEST_F(Newton, NeedsOneKrylovStepWithTheInverseAsPreconditioner)
{
  const auto slope = [](int i) { return 1.0 + 10.0 * i * i; };
  const NewtonKrylov::Preconditioner inverse = [&](const View3<double>& r) {
    for (const View<double>& component : r)
      for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { component(i, j, k) /= slope(i); });
  };
  NewtonKrylov newton(grid, map([slope](double v, int i) { return v - (slope(i) * v - 1.0); }), inverse);
  const NewtonReport report = newton.solve(views(x), 1e-6);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.krylov_iterations, report.iterations);
  EXPECT_NEAR(x[0](4, 0, 0), 1.0 / 161.0, 1e-7);
}

TEST_F(Newton, TellsThatThereIsNoSolution)
{
  NewtonKrylov newton(grid, map([](double v, int) { return 2.0 * v + 1.0 + v * v; }), keep);  // v^2 + v + 1 = 0
  EXPECT_FALSE(newton.solve(views(x), 1e-12).converged);
}

TEST_F(Newton, IsAtTheSolutionOfAProblemAtRest)
{
  NewtonKrylov newton(grid, map([](double v, int) { return 0.5 * v; }), keep);
  const NewtonReport report = newton.solve(views(x), 0.0);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
}

TEST_F(Newton, LetsAnErrorOfTheMapOutAndCanBeUsedAgain)
{
  bool broken = true;
  NewtonKrylov newton(grid, map([&broken](double v, int) {
                        if (broken)
                          fail_run("the map is broken");
                        return 0.5 * v + 1.0;
                      }),
                      keep);
  EXPECT_THROW((void)newton.solve(views(x), 1e-12), RunError);
  broken = false;
  EXPECT_TRUE(newton.solve(views(x), 1e-12).converged);
  EXPECT_NEAR(x[2](1, 1, 1), 2.0, 1e-11);
}

}  // namespace
}  // namespace luff::fluid
