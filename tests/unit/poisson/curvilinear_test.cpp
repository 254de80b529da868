// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <omp.h>

#include "core/error.hpp"
#include "curvilinear_cases.hpp"
#include "poisson/cross_terms.hpp"
#include "poisson/curvilinear_correction.hpp"
#include "poisson/multigrid.hpp"

namespace luff::poisson {
namespace {

using namespace test;

/// A p = div F, by the fluxes that correct U.
class Operator {
 public:
  Operator(const CurvilinearProblem& problem, const Sheet& sheet)
      : grid_(problem.grid()),
        conditions_(problem.conditions()),
        fluxes_(grid_, conditions_),
        halo_(grid_.ranks()),
        p_(grid_.owned()),
        U_(make_field3<double>(grid_.owned()))
  {
    fluxes_.set_blocked(blocked_links(grid_, sheet));
  }
  [[nodiscard]] const grid::Grid& grid() const { return grid_; }
  [[nodiscard]] int size() const { return static_cast<int>(grid_.owned().volume()); }
  [[nodiscard]] Eigen::VectorXd apply(const Eigen::VectorXd& x)
  {
    int n = 0;
    for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) { p_(i, j, k) = x[n++]; });
    halo_.exchange({p_.view()});
    mirror_beyond_sides(grid_, conditions_, p_.view());
    for (auto& U : U_)
      U.fill(0.0);
    fluxes_.subtract(views(U_), p_.view(), 1.0);
    Eigen::VectorXd y(size());
    n = 0;
    for_each_cell_in_order(grid_.owned(), [&](int i, int j, int k) {
      y[n++] = U_[0](i + 1, j, k) - U_[0](i, j, k) + U_[1](i, j + 1, k) - U_[1](i, j, k) + U_[2](i, j, k + 1) -
               U_[2](i, j, k);
    });
    return y;
  }
  CurvilinearCorrection& fluxes() { return fluxes_; }

 private:
  grid::Grid grid_;
  SideConditions conditions_;
  CurvilinearCorrection fluxes_;
  HaloExchange halo_;
  Field<double> p_;
  Field3<double> U_;
};

Eigen::VectorXd random_vector(int n)
{
  static std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd x(n);
  for (double& value : x)
    value = uniform(engine);
  return x;
}

TEST(CurvilinearOperator, IsSymmetricToRoundOff)
{
  for (const NamedCurvilinearCase& c : curvilinear_cases()) {
    Operator A(c.problem, c.sheet);
    const Eigen::VectorXd x = random_vector(A.size());
    const Eigen::VectorXd y = random_vector(A.size());
    const Eigen::VectorXd Ax = A.apply(x);
    const Eigen::VectorXd Ay = A.apply(y);
    EXPECT_NEAR(y.dot(Ax), x.dot(Ay), 1e-15 * Ax.norm() * y.norm()) << c.name;
    EXPECT_GT(x.dot(Ax), 0.0) << c.name;
  }
}

/// Null vectors are the constants on each component that touches no pressure side, and nothing else.
TEST(CurvilinearOperator, IsPositiveSemiDefiniteWithOneNullVectorPerClosedComponent)
{
  struct Case {
    std::string name;
    CurvilinearProblem problem;
    Sheet sheet;
    int components;
  };
  for (const Case& c : {Case{"pipe, valve", {{8, 7, 7}, BentPipe{0.9}}, orifice(0.2), 1},
                        Case{"pipe, closed valve", {{8, 7, 7}, BentPipe{0.9}}, orifice(-1.0), 2},
                        Case{"closed valve, outflow", {{8, 7, 7}, BentPipe{0.9}, "NDNNNN"}, orifice(-1.0), 1},
                        Case{"sheared", {{7, 7, 7}, Slid{0.25}}, flag, 1},
                        Case{"sheared, open in part", {{7, 7, 7}, Slid{0.25}}, {flag, true}, 1},
                        Case{"pipe, closed valve open in part", {{8, 7, 7}, BentPipe{0.9}}, {orifice(-1.0), true}, 1},
                        Case{"ring", {{8, 6, 5}, Ring{}, "PPNNNN"}, no_sheet, 1}}) {
    Operator A(c.problem, c.sheet);
    const int n = A.size();
    Eigen::MatrixXd matrix(n, n);
    for (int m = 0; m < n; ++m)
      matrix.col(m) = A.apply(Eigen::VectorXd::Unit(n, m));
    EXPECT_LE((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-15 * matrix.cwiseAbs().maxCoeff()) << c.name;
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
    EXPECT_GE(lambda[0], -1e-14 * lambda[n - 1]) << c.name;
    int null = 0;
    for (const double value : lambda)
      null += value < 1e-10 * lambda[n - 1] ? 1 : 0;
    EXPECT_EQ(null, c.components) << c.name;
  }
}

TEST(CurvilinearOperator, IsTheSameInSinglePrecision)
{
  for (const NamedCurvilinearCase& c : curvilinear_cases()) {
    Operator A(c.problem, c.sheet);
    const Eigen::VectorXd x = random_vector(A.size());
    const Eigen::VectorXd expected = A.apply(x);
    const CurvilinearOperator& gradient = A.fluxes().gradient();
    Box box;
    for (int a = 0; a < 3; ++a)
      box.lines[a] = make_line(std::vector<double>(c.problem.cells[a], 1.0), c.problem.periodic(a),
                               c.problem.conditions()[a], {0, c.problem.cells[a]});
    Level level(box, A.grid().owned(), nullptr, Level::Kind::Stored);
    level.coefficients().load(A.grid().owned(), [&](int a, const Index3& f) {
      const bool side = !c.problem.periodic(a) && (f[a] == 0 || f[a] == c.problem.cells[a]);
      return (side ? 2.0 : 1.0) * gradient.face()[a](f);
    });
    level.coefficients().close(level.exchange());
    CrossTerms cross(level);
    cross.load(A.grid().owned(), [&](int pair, const Index3& cell) { return gradient.cross()[pair](cell); });
    cross.close();
    cross.set_partial_faces(A.fluxes().partial_faces());
    Values p(level.layout().size), q(level.layout().size);
    int n = 0;
    for_each_cell_in_order(A.grid().owned(),
                           [&](int i, int j, int k) { p[level.layout().index(i, j, k)] = static_cast<float>(x[n++]); });
    level.exchange().exchange_with_edges(p.data());
    double energy = 0.0;
    for (int k = 0; k < c.problem.cells[2]; ++k)
      cross.prepare_plane(k, p.data());
    for (int k = 0; k < c.problem.cells[2]; ++k) {
      energy += level.apply_plane(k, p.data(), q.data());
      energy += cross.apply_plane(k, p.data(), q.data());
    }
    n = 0;
    double worst = 0.0;
    for_each_cell_in_order(A.grid().owned(), [&](int i, int j, int k) {
      worst = std::max(worst, std::abs(q[level.layout().index(i, j, k)] - expected[n++]));
    });
    EXPECT_LE(worst, 2e-6 * expected.cwiseAbs().maxCoeff()) << c.name;
    EXPECT_NEAR(energy, x.dot(expected), 1e-5 * std::abs(x.dot(expected))) << c.name;
  }
}

/// The cycle whose smoother knows of the cross terms, as an operator from right-hand sides without a mean.
TEST(CurvilinearMultigrid, IsASymmetricOperator)
{
  for (const NamedCurvilinearCase& c : curvilinear_cases()) {
    if (c.problem.sides[1] != 'D')
      continue;  // where no pressure is given, parts of the fluid have means of their own to remove
    Operator A(c.problem, c.sheet);
    const CurvilinearOperator& gradient = A.fluxes().gradient();
    Box box;
    for (int a = 0; a < 3; ++a)
      box.lines[a] = make_line(std::vector<double>(c.problem.cells[a], 1.0), c.problem.periodic(a),
                               c.problem.conditions()[a], {0, c.problem.cells[a]});
    Neighbourhood alone;
    alone.comm = MPI_COMM_SELF;
    Multigrid multigrid(box, A.grid().owned(), alone, [&](int a, const Index3& f) {
      const bool side = !c.problem.periodic(a) && (f[a] == 0 || f[a] == c.problem.cells[a]);
      return (side ? 2.0 : 1.0) * gradient.face()[a](f);
    });
    CrossTerms cross(multigrid.finest());
    cross.load(A.grid().owned(), [&](int pair, const Index3& cell) { return gradient.cross()[pair](cell); });
    cross.close();
    cross.set_partial_faces(A.fluxes().partial_faces());
    multigrid.smooth_cross_terms(cross);
    multigrid.set_blocked(blocked_links(A.grid(), c.sheet));
    const Layout& layout = multigrid.finest().layout();
    const auto apply = [&](const Eigen::VectorXd& x) {
      int n = 0;
      for_each_cell_in_order(A.grid().owned(), [&](int i, int j, int k) {
        multigrid.finest().f[layout.index(i, j, k)] = static_cast<float>(x[n++]);
      });
      multigrid.cycle();
      Eigen::VectorXd y(A.size());
      n = 0;
      for_each_cell_in_order(A.grid().owned(),
                             [&](int i, int j, int k) { y[n++] = multigrid.finest().u[layout.index(i, j, k)]; });
      return y;
    };
    const Eigen::VectorXd x = random_vector(A.size());
    const Eigen::VectorXd y = random_vector(A.size());
    const Eigen::VectorXd Mx = apply(x);
    const Eigen::VectorXd My = apply(y);
    EXPECT_NEAR(Mx.dot(y), x.dot(My), 5e-6 * Mx.norm() * y.norm()) << c.name;
    EXPECT_GT(Mx.dot(x), 0.0) << c.name;
  }
}

TEST(CurvilinearProjection, IsThatOfAUniformGridWhereTheGridIsOne)
{
  const Problem straight{{12, 10, 9}, 1.0, "NDNNNN"};
  const grid::Grid uniform = straight.grid();
  const CurvilinearProblem same{
      straight.cells, [](const Vec3& s) { return Vec3(s[0], s[1] * 10.0 / 12.0, s[2] * 9.0 / 12.0); }, straight.sides};
  const grid::Grid curvilinear = same.grid();
  ASSERT_EQ(curvilinear.kind(), grid::Kind::Curvilinear);
  for (const bool in_part : {false, true}) {
    auto closed = blocked(uniform, flag);
    if (in_part)
      open_in_part(uniform, closed);
    const auto projected = [&](const grid::Grid& grid) {
      Projection result{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
      set_random_fluxes(straight, uniform, closed, result.U);
      const auto solver = make_pressure_solver(grid, same.conditions());
      solver->set_blocked(closed);
      EXPECT_TRUE(solver->project(views(result.U), result.p.view(), 0.1, tight).converged);
      return result;
    };
    const Projection a = projected(uniform);
    const Projection b = projected(curvilinear);
    EXPECT_LE(difference(uniform, a.p, b.p), 1e-11 * largest(uniform, a.p));
    for (int d = 0; d < 3; ++d)
      EXPECT_LE(difference(uniform, a.U[d], b.U[d]), 1e-12 * largest(uniform, a.U[d]));
  }
}

TEST(CurvilinearProjection, LeavesNoDivergenceInAnyCell)
{
  for (const NamedCurvilinearCase& c : curvilinear_cases()) {
    const grid::Grid grid = c.problem.grid();
    const Projection projection = project(c.problem, grid, c.sheet, tight);
    EXPECT_TRUE(projection.report.converged) << c.name << ' ' << projection.report.divergence;
    EXPECT_LE(curvilinear_divergence(grid, projection.U), 1e-13) << c.name;
    EXPECT_LE(projection.report.iterations, 60) << c.name;
  }
}

TEST(CurvilinearProjection, CorrectsByTheGradientOfThePressureItReturns)
{
  for (const NamedCurvilinearCase& c : curvilinear_cases()) {
    const grid::Grid grid = c.problem.grid();
    Projection projection = project(c.problem, grid, c.sheet, tight);
    Field3<double> before = make_field3<double>(grid.owned());
    const auto closed = blocked_links(grid, c.sheet);
    set_random_fluxes(c.problem, grid, closed, before);
    CurvilinearCorrection fluxes(grid, c.problem.conditions());
    fluxes.set_blocked(closed);
    fluxes.subtract(views(before), projection.p.view(), 0.1);
    for (int a = 0; a < 3; ++a)
      EXPECT_LE(difference(grid, before[a], projection.U[a]), 1e-13 * largest(grid, before[a]) * 100.0)
          << c.name << " axis " << a;
  }
}

TEST(CurvilinearProjection, FindsAfterASheetMovedWhatAFreshSolverFinds)
{
  const CurvilinearProblem problem{{24, 20, 18}, Slid{}, "NDNNNN"};
  const grid::Grid grid = problem.grid();
  const auto solver = make_pressure_solver(grid, problem.conditions());
  const auto solve = [&](PressureSolver& with, const Sheet& sheet) {
    Projection result{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
    const auto closed = blocked_links(grid, sheet);
    set_random_fluxes(problem, grid, closed, result.U);
    with.set_blocked(closed);
    result.report = with.project(views(result.U), result.p.view(), 0.1, tight);
    return result;
  };
  for (const bool in_part : {false, true}) {
    (void)solve(*solver, {orifice(0.1), in_part});
    const Projection moved = solve(*solver, {flag, in_part});
    const Projection fresh = project(problem, grid, {flag, in_part}, tight);
    EXPECT_EQ(difference(grid, moved.p, fresh.p), 0.0);
  }
}

TEST(CurvilinearProjection, GivesTheSameBitsOnOneAndTwoThreads)
{
  const CurvilinearProblem problem{{24, 40, 44}, luff::test::Waved{}, "NDNNPP"};
  const grid::Grid grid = problem.grid();
  omp_set_num_threads(1);
  const Projection one = project(problem, grid, flag, tight);
  omp_set_num_threads(2);
  const Projection two = project(problem, grid, flag, tight);
  omp_set_num_threads(1);
  EXPECT_EQ(difference(grid, one.p, two.p), 0.0);
}

TEST(CurvilinearProjection, IsRefusedByPetsc)
{
  const CurvilinearProblem problem{{4, 4, 4}};
  const grid::Grid grid = problem.grid();
  EXPECT_THROW((void)make_pressure_solver(grid, problem.conditions(), {"petsc"}), InputError);
}

}  // namespace
}  // namespace luff::poisson
