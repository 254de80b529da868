// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include <gtest/gtest.h>

#include "support/faces.hpp"
#include <omp.h>

#include "core/error.hpp"
#include "cases.hpp"

namespace luff::poisson {
namespace {

using namespace test;

std::vector<NamedCase> all_cases()
{
  return {
      {"closed uniform box", {{16, 17, 19}, 1.0, "NNNNNN"}, no_sheet},
      {"closed stretched box", {{20, 16, 13}, 8.0, "NNNNNN"}, no_sheet},
      {"outflow", {{20, 16, 13}, 4.0, "NDNNNN"}, no_sheet},
      {"pressure on all sides", {{11, 12, 13}, 3.0, "DDDDDD"}, no_sheet},
      {"triply periodic, odd", {{15, 13, 9}, 1.0, "PPPPPP"}, no_sheet},
      {"periodic, stretched, outflow", {{16, 14, 15}, 5.0, "NDPPPP"}, no_sheet},
      {"flag", {{24, 20, 18}, 1.0, "NNNNNN"}, flag},
      {"flag, stretched, outflow", {{24, 20, 18}, 6.0, "NDNNNN"}, flag},
      {"flag, periodic", {{25, 20, 17}, 3.0, "NDNNPP"}, flag},
      {"closed box inside", {{20, 20, 20}, 2.0, "NNNNNN"}, closed_box},
      {"closed box inside, outflow", {{20, 20, 20}, 2.0, "NDNNNN"}, closed_box},
      {"orifice", {{24, 24, 24}, 1.0, "NNNNNN"}, orifice(0.06)},
      {"slab of one cell", {{24, 20, 1}, 3.0, "NDNNNN"}, flag},
      {"periodic slab of one cell", {{24, 20, 1}, 3.0, "NDNNPP"}, no_sheet},
      {"periodic slab of two cells", {{24, 20, 2}, 1.0, "NDNNPP"}, flag},
      {"column", {{1, 1, 30}, 2.0, "NNNNNN"}, no_sheet},
      {"periodic row of two cells", {{2, 12, 10}, 1.0, "PPNNNN"}, no_sheet},
  };
}

TEST(Projection, LeavesNoDivergenceInAnyCell)
{
  for (const NamedCase& c : all_cases()) {
    const grid::Grid grid = c.problem.grid();
    const Projection projection = project(c.problem, grid, c.cuts, tight);
    EXPECT_TRUE(projection.report.converged) << c.name;
    EXPECT_LE(divergence(grid, projection.U), 1e-13) << c.name;
    EXPECT_LE(projection.report.iterations, 30) << c.name;
    // Sums in another order differ by round-off.
    EXPECT_NEAR(projection.report.divergence, divergence(grid, projection.U), 1e-14) << c.name;
  }
}

TEST(Projection, AgreesWithPetsc)
{
  for (const NamedCase& c : all_cases()) {
    const grid::Grid grid = c.problem.grid();
    const Projection ours = project(c.problem, grid, c.cuts, tight);
    const Projection petsc = project(c.problem, grid, c.cuts, {.divergence = 2e-13, .max_iterations = 500}, "petsc");
    EXPECT_TRUE(petsc.report.converged) << c.name << ' ' << petsc.report.divergence;
    EXPECT_LE(difference(grid, ours.p, petsc.p), 1e-10 * largest(grid, petsc.p)) << c.name;
    Field3<double> before = make_field3<double>(grid.owned());
    set_random_fluxes(c.problem, grid, {}, before);
    for (int a = 0; a < 3; ++a)
      EXPECT_LE(difference(grid, ours.U[a], petsc.U[a]), 1e-11 * largest(grid, before[a])) << c.name << " axis " << a;
  }
}

TEST(Projection, CorrectsByTheGradientOfThePressureItReturns)
{
  const Problem problem{{14, 12, 10}, 3.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  Field3<double> before = make_field3<double>(grid.owned());
  const auto closed = blocked(grid, flag);
  set_random_fluxes(problem, grid, closed, before);
  const Projection projection = project(problem, grid, flag, tight);
  const double dt = 0.1;
  const auto p = [&](int i, int j, int k) { return projection.p(i, j, k); };
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 1; i <= 14; ++i) {
        const double A = grid.width(1, j) * grid.width(2, k);
        const double G = i < 14 ? A * (p(i, j, k) - p(i - 1, j, k)) / grid.distance(0, i)
                                : A * (0.0 - p(i - 1, j, k)) / (0.5 * grid.width(0, i - 1));
        const bool cut = std::binary_search(closed.begin(), closed.end(), FaceIndex{0, {i, j, k}}) ||
                         std::find(closed.begin(), closed.end(), FaceIndex{0, {i, j, k}}) != closed.end();
        EXPECT_NEAR(projection.U[0](i, j, k), before[0](i, j, k) - (cut ? 0.0 : dt * G), 1e-12 * A) << i << j << k;
      }
}

/// Every third face of the flag lets a part of the flow through.
TEST(Projection, CorrectsFacesThatAreBlockedInPartByTheirOpenPart)
{
  const Problem problem{{24, 20, 22}, 3.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  std::vector<FaceIndex> faces = blocked(grid, flag);
  for (std::size_t n = 0; n < faces.size(); n += 3)
    faces[n].open = 0.5 + 0.49 * noise(grid, faces[n]);
  Field3<double> before = make_field3<double>(grid.owned());
  set_random_fluxes(problem, grid, {}, before);
  const auto projected = [&](const std::string& kind, const Target& target) {
    Projection result{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
    result.U = before;
    const auto solver = make_pressure_solver(grid, problem.conditions(), {kind});
    solver->set_blocked(faces);
    result.report = solver->project(views(result.U), result.p.view(), 0.1, target);
    return result;
  };
  const Projection ours = projected("multigrid", tight);
  EXPECT_TRUE(ours.report.converged);
  EXPECT_LE(divergence(grid, ours.U), 1e-13);
  EXPECT_LE(ours.report.iterations, 30);
  for (const FaceIndex& f : faces) {
    const auto [i, j, k] = f.cell;
    const double A = grid.area(f.axis, i, j, k);
    Index3 below = f.cell;
    --below[f.axis];
    const double G =
        A * (ours.p(i, j, k) - ours.p(below[0], below[1], below[2])) / grid.distance(f.axis, f.cell[f.axis]);
    EXPECT_NEAR(ours.U[f.axis](i, j, k), before[f.axis](i, j, k) - f.open * 0.1 * G, 1e-12 * A);
  }
  const Projection petsc = projected("petsc", {.divergence = 2e-13, .max_iterations = 500});
  EXPECT_TRUE(petsc.report.converged);
  EXPECT_LE(difference(grid, ours.p, petsc.p), 1e-10 * largest(grid, petsc.p));
}

TEST(Projection, StartsFromTheGivenPressure)
{
  const Problem problem{{20, 18, 16}, 4.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  const auto closed = blocked(grid, flag);
  Projection first = project(problem, grid, flag, tight);
  const auto solver = make_pressure_solver(grid, problem.conditions());
  solver->set_blocked(closed);
  set_random_fluxes(problem, grid, closed, first.U);
  const Report again = solver->project(views(first.U), first.p.view(), 0.1, tight);
  EXPECT_TRUE(again.converged);
  EXPECT_LE(again.iterations, 2);
}

TEST(Projection, StopsWhenTheOutflowFellByTheRelativeTarget)
{
  const Problem problem{{32, 32, 32}};
  const grid::Grid grid = problem.grid();
  const Report loose = project(problem, grid, flag, {.relative = 1e-2}).report;
  const Report tighter = project(problem, grid, flag, {.relative = 1e-8}).report;
  EXPECT_TRUE(loose.converged);
  EXPECT_TRUE(tighter.converged);
  EXPECT_LE(loose.iterations, 3);
  EXPECT_GT(tighter.iterations, loose.iterations);
}

TEST(Projection, TakesAsManyIterationsThroughASmallHoleOnEveryGrid)
{
  for (const double ratio : {1.0, 20.0}) {
    std::vector<int> iterations;
    for (const int n : {32, 48, 64}) {
      const Problem problem{{n, n, n}, ratio};
      const grid::Grid grid = problem.grid();
      const Report report = project(problem, grid, orifice(1.2 / n), {.relative = 1e-10}).report;
      EXPECT_TRUE(report.converged) << n;
      iterations.push_back(report.iterations);
    }
    EXPECT_LE(*std::max_element(iterations.begin(), iterations.end()), 12) << ratio;
    EXPECT_LE(iterations.back(), iterations.front() + 2) << ratio;
  }
}

TEST(Projection, SolvesInsideAndOutsideAClosedBoxAtOnce)
{
  const Problem problem{{40, 40, 40}};
  const grid::Grid grid = problem.grid();
  const Projection projection = project(problem, grid, closed_box, {.relative = 1e-10});
  EXPECT_TRUE(projection.report.converged);
  EXPECT_LE(projection.report.iterations, 14);
  double inside = 0.0;
  double outside = 0.0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const Point here{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
        (closed_box(here, {0.0, 0.0, 0.0}) ? inside : outside) += projection.p(i, j, k);
      }
  const double scale = 64000.0 * largest(grid, projection.p);
  EXPECT_LE(std::abs(inside), 1e-13 * scale);
  EXPECT_LE(std::abs(outside), 1e-13 * scale);
}

TEST(Projection, GivesTheSameDigitsInAnyUnitOfLengthAndTime)
{
  const Problem metres{{24, 20, 18}, 5.0, "NDNNNN", 1.0};
  for (const double length : {0x1p-20, 1e-3}) {
    Problem scaled = metres;
    scaled.length = length;
    const grid::Grid grid = metres.grid();
    const grid::Grid small = scaled.grid();
    const double speed = length == 1e-3 ? 1e-7 : 0x1p-30;
    const Projection a = project(metres, grid, flag, tight);
    const Projection b = project(scaled, small, flag, {.divergence = 5e-14, .speed = speed}, "multigrid", speed);
    EXPECT_EQ(a.report.iterations, b.report.iterations);
    EXPECT_TRUE(b.report.converged);
    const double ratio = a.p(5, 6, 7) * length * speed / b.p(5, 6, 7);
    if (length == 1e-3) {
      EXPECT_NEAR(ratio, 1.0, 1e-9);
    } else {
      EXPECT_EQ(ratio, 1.0);  // powers of two change no digit
    }
  }
}

TEST(Projection, GivesTheSameBitsOnOneAndTwoThreads)
{
  // In the last one threads share out a level that holds extra unknowns, too.
  for (const Problem& problem : {Problem{{24, 40, 44}, 3.0, "NDNNNN"}, Problem{{24, 40, 44}, 3.0, "NDNNPP"},
                                 Problem{{24, 40, 44}, 3.0, "NNPPNN"}, Problem{{32, 32, 128}, 1.0, "NDNNNN"}}) {
    const grid::Grid grid = problem.grid();
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Projection one = project(problem, grid, flag, tight);
    omp_set_num_threads(2);
    const Projection two = project(problem, grid, flag, tight);
    omp_set_num_threads(threads);
    EXPECT_EQ(one.report.iterations, two.report.iterations);
    EXPECT_EQ(difference(grid, one.p, two.p), 0.0) << problem.sides;
    for (int a = 0; a < 3; ++a)
      EXPECT_EQ(difference(grid, one.U[a], two.U[a]), 0.0) << problem.sides;
  }
}

TEST(Projection, ForgetsFacesThatAreNoLongerBlocked)
{
  const Problem problem{{20, 20, 20}, 2.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  const auto solver = make_pressure_solver(grid, problem.conditions());
  Projection moved{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
  solver->set_blocked(blocked(grid, closed_box));
  solver->set_blocked(blocked(grid, flag));
  set_random_fluxes(problem, grid, blocked(grid, flag), moved.U);
  solver->project(views(moved.U), moved.p.view(), 0.1, tight);
  const Projection fresh = project(problem, grid, flag, tight);
  EXPECT_EQ(difference(grid, moved.p, fresh.p), 0.0);
}

/// The faces around the cells lo ... hi.
std::vector<FaceIndex> faces_around(const Index3& lo, const Index3& hi)
{
  std::vector<FaceIndex> faces;
  for (int a = 0; a < 3; ++a)
    for (const int plane : {lo[a], hi[a] + 1}) {
      IndexBox box{lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}};
      box.lo[a] = plane;
      box.hi[a] = plane + 1;
      for_each_cell_in_order(box, [&](int i, int j, int k) { faces.push_back({a, {i, j, k}}); });
    }
  return faces;
}

double net_outflow(const Field3<double>& U, int i, int j, int k)
{
  return U[0](i + 1, j, k) - U[0](i, j, k) + U[1](i, j + 1, k) - U[1](i, j, k) + U[2](i, j, k + 1) - U[2](i, j, k);
}

/// Largest net outflow of cells outside lo ... hi, over the area of a face.
double outflow_elsewhere(const Field3<double>& U, const Index3& lo, const Index3& hi)
{
  const IndexBox inside{lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}};
  double elsewhere = 0.0;
  for_each_cell_in_order({{0, 0, 0}, {10, 10, 10}}, [&](int i, int j, int k) {
    if (!inside.contains(i, j, k))
      elsewhere = std::max(elsewhere, std::abs(net_outflow(U, i, j, k)) / 0.01);
  });
  return elsewhere;
}

TEST(Projection, ReportsThePocketWhoseFluxesNoPressureCanBalance)
{
  const Problem problem{{10, 10, 10}, 1.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  const Index3 first{4, 5, 6};
  const Index3 second{5, 5, 6};
  Field3<double> U = make_field3<double>(grid.owned());
  set_random_fluxes(problem, grid, {}, U);
  Field<double> p(grid.owned());
  const auto solver = make_pressure_solver(grid, problem.conditions());
  solver->set_blocked(faces_around(first, second));
  const Report report = solver->project(views(U), p.view(), 0.1, tight);
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(report.worst_cell == first || report.worst_cell == second);
  EXPECT_GT(report.divergence, 1e-3);
  EXPECT_LE(outflow_elsewhere(U, first, second), 1e-13);
}

TEST(Projection, LeavesIsolatedCellsAlone)
{
  const Problem problem{{10, 10, 10}, 1.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  std::vector<FaceIndex> inside_a_body;  // every face of a block of cells
  const Index3 lo{3, 4, 5};
  const Index3 hi{5, 7, 7};
  for_each_cell_in_order({lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}}, [&](int i, int j, int k) {
    const auto faces = faces_around({i, j, k}, {i, j, k});
    inside_a_body.insert(inside_a_body.end(), faces.begin(), faces.end());
  });
  Field3<double> U = make_field3<double>(grid.owned());
  set_random_fluxes(problem, grid, {}, U);
  const double before = net_outflow(U, 4, 5, 6);
  Field<double> p(grid.owned());
  const auto solver = make_pressure_solver(grid, problem.conditions());
  solver->set_blocked(inside_a_body);
  const Report report = solver->project(views(U), p.view(), 0.1, tight);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(outflow_elsewhere(U, lo, hi), 1e-13);
  EXPECT_EQ(net_outflow(U, 4, 5, 6), before);
  EXPECT_EQ(p(4, 5, 6), 0.0);
}

TEST(Projection, TakesThePressureGivenOnASide)
{
  // Between p = 3 and p = 1 on two sides fluid is pushed uniformly: U = -dt A dp/dx.
  const Problem problem{{20, 6, 5}, 4.0, "DDNNNN"};
  const grid::Grid grid = problem.grid();
  Field3<double> U = make_field3<double>(grid.owned());
  Field<double> p(grid.owned());
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 6; ++j) {
      p(-1, j, k) = 6.0;
      p(20, j, k) = 2.0;
    }
  const Report report = make_pressure_solver(grid, problem.conditions())->project(views(U), p.view(), 0.1, tight);
  EXPECT_TRUE(report.converged);
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    EXPECT_NEAR(p(i, j, k), 3.0 - 2.0 * grid.centre(0, i), 1e-12);
    EXPECT_NEAR(U[0](i, j, k), 0.1 * 2.0 * grid.area(0, i, j, k), 1e-14);
  });
  EXPECT_NEAR(p(-1, 2, 2) + p(0, 2, 2), 6.0, 1e-14);
  EXPECT_NEAR(p(20, 2, 2) + p(19, 2, 2), 2.0, 1e-14);
}

TEST(Projection, LeavesAFluidAtRestAlone)
{
  const Problem problem{{10, 10, 10}};
  const grid::Grid grid = problem.grid();
  Field3<double> U = make_field3<double>(grid.owned());
  Field<double> p(grid.owned());
  const auto solver = make_pressure_solver(grid, problem.conditions());
  const Report report = solver->project(views(U), p.view(), 0.1, {.divergence = 5e-14, .speed = 0.0});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.divergence, 0.0);
  EXPECT_EQ(largest(grid, p), 0.0);
}

TEST(Projection, ReportsNotANumberAndWhereItIs)
{
  const Problem problem{{10, 10, 10}, 1.0, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  Field3<double> U = make_field3<double>(grid.owned());
  set_random_fluxes(problem, grid, {}, U);
  U[1](3, 4, 5) = std::numeric_limits<double>::quiet_NaN();
  Field<double> p(grid.owned());
  const Report report = make_pressure_solver(grid, problem.conditions())->project(views(U), p.view(), 0.1, tight);
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(std::isnan(report.divergence));
  EXPECT_EQ(report.worst_cell, (Index3{3, 3, 5}));
}

TEST(Projection, DoesNotClaimToHaveBalancedWhatIsForcedThroughClosedSides)
{
  const Problem problem{{12, 12, 12}};
  const grid::Grid grid = problem.grid();
  Field3<double> U = make_field3<double>(grid.owned());
  set_random_fluxes(problem, grid, {}, U);
  U[0](0, 3, 3) = 1.0;
  Field<double> p(grid.owned());
  const Report report = make_pressure_solver(grid, problem.conditions())->project(views(U), p.view(), 0.1, tight);
  EXPECT_FALSE(report.converged);
  EXPECT_LT(report.iterations, 60);
  EXPECT_NEAR(report.divergence, 1.0 / 1728.0 / (1.0 / 144.0), 1e-6);
}

TEST(PressureSolver, RefusesAnUnknownKind)
{
  const Problem problem{{4, 4, 4}};
  const grid::Grid grid = problem.grid();
  EXPECT_THROW((void)make_pressure_solver(grid, problem.conditions(), {"hypre"}), InputError);
}

TEST(Projection, FluxesLoseTheGradientOfALinearPressureExactly)
{
  const grid::Grid grid(MPI_COMM_SELF,
                        {luff::test::stretched_faces(0, 1, 8, 0.3), luff::test::stretched_faces(0, 1, 8, -0.3),
                         luff::test::stretched_faces(0, 1, 8, 0.3)},
                        {false, false, false});
  const Vec3 slope(1.0, 2.0, -3.0);
  Field3<double> U = make_field3<double>(grid.owned());
  Field<double> p(grid.owned());
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { p(i, j, k) = slope.dot(grid.centre(i, j, k)); });
  make_pressure_solver(grid, {})->subtract_gradient(views(U), p.view(), 0.5);
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(U[d](4, 4, 4) / grid.area(d, 4, 4, 4), -0.5 * slope[d], 1e-14);
    EXPECT_EQ(U[d](0, 0, 0), 0.0);
  }
}

}  // namespace
}  // namespace luff::poisson
