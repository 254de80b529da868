// SPDX-License-Identifier: BSD-3-Clause
// Projections by luff against hypre's structured multigrid (PFMG-preconditioned CG), in turns within one run.
//
// Prints iterations and processor time per cell (set-up of the blocked faces or of the matrix's hierarchy, and solve)
// until the net outflow fell by 1e-10.  hypre's matrix has its diagonal raised by 1e-9, without which its conjugate
// gradients break down on closed domains.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_struct_ls.h>
#include <mpi.h>

#include "poisson/pressure_solver.hpp"

namespace {

using namespace luff;
using poisson::FaceIndex;

constexpr double reduction = 1e-10;
constexpr int repetitions = 5;

double thread_time()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// n cells over [0, length], the widest `ratio` times the narrowest.
std::vector<double> faces(int n, double length, double ratio, double centre)
{
  std::vector<double> h(n);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = std::abs((i + 0.5) / n - centre) / std::max(centre, 1.0 - centre);
    sum += h[i] = std::pow(ratio, std::min(1.0, 1.3 * s));
  }
  std::vector<double> x(n + 1, 0.0);
  for (int i = 0; i < n; ++i)
    x[i + 1] = x[i] + length * h[i] / sum;
  return x;
}

struct Case {
  std::string name;
  Index3 cells;
  double ratio;
  bool sheet;
  bool outflow;
};

struct Flow {
  explicit Flow(const Case& c)
      : grid(MPI_COMM_SELF,
             {faces(c.cells[0], static_cast<double>(c.cells[0]) / c.cells[1], c.ratio, 0.4),
              faces(c.cells[1], 1.0, c.ratio, 0.5),
              faces(c.cells[2], static_cast<double>(c.cells[2]) / c.cells[1], c.ratio, 0.5)},
             {false, false, false}),
        U(make_field3<double>(grid.owned()))
  {
    using poisson::SideCondition;
    for (auto& axis : sides)
      axis = {SideCondition::Neumann, SideCondition::Neumann};
    if (c.outflow)
      sides[0][1] = SideCondition::Dirichlet;
    set_fluxes(c.outflow);
    if (c.sheet)
      block_sheet();
  }

  /// Large eddies with five per cent of noise.
  void set_fluxes(bool outflow)
  {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int a = 0; a < 3; ++a)
      for_faces(a, [&](const Index3& c) {
        const double x = 6.0 * c[0] / grid.cells()[0];
        const double y = 6.0 * c[1] / grid.cells()[1];
        const double z = 6.0 * c[2] / grid.cells()[2];
        const double eddy = a == 0   ? 1.0 + 0.3 * std::sin(y + 0.5 * z + x)
                            : a == 1 ? 0.4 * std::cos(x + 0.7 * z + 0.5 * y)
                                     : 0.4 * std::sin(x - 0.8 * y + 0.6 * z);
        const bool side = c[a] == 0 || c[a] == grid.cells()[a];
        const bool closed = side && !(outflow && a == 0 && c[0] > 0);
        Index3 inner = c;
        for (int d = 0; d < 3; ++d)
          inner[d] = std::min(c[d], grid.cells()[d] - 1);
        U[a](c[0], c[1], c[2]) =
            closed ? 0.0 : (eddy + 0.05 * uniform(random)) * grid.area(a, inner[0], inner[1], inner[2]);
      });
  }

  /// A curved flag that covers 40 % of the length and half of the width.
  void block_sheet()
  {
    const auto part = [&](int a, int i) { return (grid.centre(a, i) - grid.face(a, 0)) / grid.length(a); };
    const auto above = [&](const Index3& c) {
      const double s = (part(0, c[0]) - 0.3) / 0.4;
      return part(1, c[1]) > 0.38 + 0.14 * s + 0.10 * s * s + 0.04 * std::sin(6.0 * part(2, c[2]));
    };
    for (int a = 0; a < 3; ++a)
      for_faces(a, [&](const Index3& c) {
        if (c[a] == 0 || c[a] == grid.cells()[a])
          return;
        Index3 low = c;
        --low[a];
        const double x = 0.5 * (part(0, c[0]) + part(0, low[0]));
        const double z = 0.5 * (part(2, c[2]) + part(2, low[2]));
        if (above(c) != above(low) && x > 0.3 && x < 0.7 && z > 0.25 && z < 0.75) {
          blocked.push_back({a, c});
          U[a](c[0], c[1], c[2]) = 0.0;
        }
      });
  }

  template <class Visit>
  void for_faces(int axis, Visit visit) const
  {
    const IndexBox box = grid.owned().faces(axis);
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        for (int i = box.lo[0]; i < box.hi[0]; ++i)
          visit(Index3{i, j, k});
  }

  grid::Grid grid;
  poisson::SideConditions sides{};
  Field3<double> U;
  std::vector<FaceIndex> blocked;
};

struct Timing {
  int iterations = 0;
  double set_up = 1e30;
  double solve = 1e30;
  bool converged = false;
};

/// The same case for luff: set-up is the change from no sheet to the sheet.
class Luff {
 public:
  explicit Luff(const Flow& flow) : flow_(flow), solver_(poisson::make_pressure_solver(flow.grid, flow.sides)) {}

  void run(Timing& best)
  {
    Field3<double> U = flow_.U;
    Field<double> p(flow_.grid.owned());
    solver_->set_blocked({});
    const double start = thread_time();
    solver_->set_blocked(flow_.blocked);
    const double ready = thread_time();
    const auto report = solver_->project(views(U), p.view(), 1.0, {.relative = reduction});
    const double done = thread_time();
    best.set_up = std::min(best.set_up, ready - start);
    best.solve = std::min(best.solve, done - ready);
    best.iterations = report.iterations;
    best.converged = report.converged;
  }

 private:
  const Flow& flow_;
  std::unique_ptr<poisson::PressureSolver> solver_;
};

class Hypre {
 public:
  explicit Hypre(const Flow& flow) : cells_(flow.grid.cells())
  {
    HYPRE_StructGridCreate(MPI_COMM_SELF, 3, &grid_);
    HYPRE_StructGridSetExtents(grid_, lo_.data(), hi());
    HYPRE_StructGridAssemble(grid_);
    HYPRE_StructStencilCreate(3, 4, &stencil_);
    std::array<Index3, 4> offsets{Index3{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (int s = 0; s < 4; ++s)
      HYPRE_StructStencilSetElement(stencil_, s, offsets[s].data());
    HYPRE_StructMatrixCreate(MPI_COMM_SELF, grid_, stencil_, &matrix_);
    HYPRE_StructMatrixSetSymmetric(matrix_, 1);
    HYPRE_StructMatrixInitialize(matrix_);
    HYPRE_StructVectorCreate(MPI_COMM_SELF, grid_, &b_);
    HYPRE_StructVectorCreate(MPI_COMM_SELF, grid_, &x_);
    HYPRE_StructVectorInitialize(b_);
    HYPRE_StructVectorInitialize(x_);
    fill(flow);
    HYPRE_StructMatrixAssemble(matrix_);
    HYPRE_StructVectorAssemble(b_);
    HYPRE_StructVectorAssemble(x_);
  }
  Hypre(const Hypre&) = delete;
  Hypre& operator=(const Hypre&) = delete;
  ~Hypre()
  {
    HYPRE_StructVectorDestroy(x_);
    HYPRE_StructVectorDestroy(b_);
    HYPRE_StructMatrixDestroy(matrix_);
    HYPRE_StructStencilDestroy(stencil_);
    HYPRE_StructGridDestroy(grid_);
  }

  void run(Timing& best)
  {
    HYPRE_StructSolver krylov = nullptr;
    HYPRE_StructSolver multigrid = nullptr;
    HYPRE_StructPCGCreate(MPI_COMM_SELF, &krylov);
    HYPRE_StructPCGSetTol(krylov, reduction);
    HYPRE_StructPCGSetMaxIter(krylov, 300);
    HYPRE_StructPCGSetTwoNorm(krylov, 1);
    HYPRE_StructPFMGCreate(MPI_COMM_SELF, &multigrid);
    HYPRE_StructPFMGSetMaxIter(multigrid, 1);
    HYPRE_StructPFMGSetTol(multigrid, 0.0);
    HYPRE_StructPFMGSetZeroGuess(multigrid);
    HYPRE_StructPFMGSetRelaxType(multigrid, 2);  // red-black Gauss-Seidel
    HYPRE_StructPFMGSetNumPreRelax(multigrid, 1);
    HYPRE_StructPFMGSetNumPostRelax(multigrid, 1);
    HYPRE_StructPFMGSetSkipRelax(multigrid, 1);
    HYPRE_StructPCGSetPrecond(krylov, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid);
    HYPRE_StructVectorSetConstantValues(x_, 0.0);
    const double start = thread_time();
    HYPRE_StructPCGSetup(krylov, matrix_, b_, x_);
    const double ready = thread_time();
    HYPRE_StructPCGSolve(krylov, matrix_, b_, x_);
    const double done = thread_time();
    best.set_up = std::min(best.set_up, ready - start);
    best.solve = std::min(best.solve, done - ready);
    double residual = 0.0;
    HYPRE_StructPCGGetNumIterations(krylov, &best.iterations);
    HYPRE_StructPCGGetFinalRelativeResidualNorm(krylov, &residual);
    best.converged = residual <= reduction;
    HYPRE_ClearAllErrors();
    HYPRE_StructPCGDestroy(krylov);
    HYPRE_StructPFMGDestroy(multigrid);
  }

 private:
  int* hi()
  {
    for (int a = 0; a < 3; ++a)
      hi_[a] = cells_[a] - 1;
    return hi_.data();
  }

  void fill(const Flow& flow)
  {
    Field3<double> c = make_field3<double>(flow.grid.owned());
    for (int a = 0; a < 3; ++a)
      flow.for_faces(a, [&](const Index3& f) { c[a](f[0], f[1], f[2]) = conductance(flow, a, f); });
    for (const FaceIndex& f : flow.blocked)
      c[f.axis](f.cell[0], f.cell[1], f.cell[2]) = 0.0;
    std::vector<double> rows;
    std::vector<double> b;
    for (int k = 0; k < cells_[2]; ++k)
      for (int j = 0; j < cells_[1]; ++j)
        for (int i = 0; i < cells_[0]; ++i) {
          const double diagonal =
              c[0](i, j, k) + c[0](i + 1, j, k) + c[1](i, j, k) + c[1](i, j + 1, k) + c[2](i, j, k) + c[2](i, j, k + 1);
          rows.push_back(diagonal > 0.0 ? diagonal * (1.0 + 1e-9) : 1.0);
          rows.push_back(i > 0 ? -c[0](i, j, k) : 0.0);
          rows.push_back(j > 0 ? -c[1](i, j, k) : 0.0);
          rows.push_back(k > 0 ? -c[2](i, j, k) : 0.0);
          b.push_back(flow.U[0](i, j, k) - flow.U[0](i + 1, j, k) + flow.U[1](i, j, k) - flow.U[1](i, j + 1, k) +
                      flow.U[2](i, j, k) - flow.U[2](i, j, k + 1));
        }
    std::array<int, 4> entries{0, 1, 2, 3};
    HYPRE_StructMatrixSetBoxValues(matrix_, lo_.data(), hi_.data(), 4, entries.data(), rows.data());
    HYPRE_StructVectorSetBoxValues(b_, lo_.data(), hi_.data(), b.data());
  }

  static double conductance(const Flow& flow, int a, const Index3& f)
  {
    const int n = flow.grid.cells()[a];
    Index3 inner = f;
    inner[a] = std::min(f[a], n - 1);
    const double area = flow.grid.area(a, inner[0], inner[1], inner[2]);
    if (f[a] > 0 && f[a] < n)
      return area / flow.grid.distance(a, f[a]);
    const bool open = flow.sides[a][f[a] == 0 ? 0 : 1] == poisson::SideCondition::Dirichlet;
    return open ? area / (0.5 * flow.grid.width(a, inner[a])) : 0.0;
  }

  Index3 cells_;
  Index3 lo_{0, 0, 0};
  Index3 hi_{};
  HYPRE_StructGrid grid_ = nullptr;
  HYPRE_StructStencil stencil_ = nullptr;
  HYPRE_StructMatrix matrix_ = nullptr;
  HYPRE_StructVector b_ = nullptr;
  HYPRE_StructVector x_ = nullptr;
};

void compare(const Case& c)
{
  const Flow flow(c);
  Luff luff(flow);
  Hypre hypre(flow);
  Timing ours;
  Timing theirs;
  for (int r = 0; r < repetitions; ++r) {
    luff.run(ours);
    hypre.run(theirs);
  }
  const double per_cell = 1e9 / (static_cast<double>(c.cells[0]) * c.cells[1] * c.cells[2]);
  const auto show = [&](const char* name, const Timing& t) {
    std::printf("  %-6s  %3d%s  %8.1f  %8.1f  %8.1f", name, t.iterations, t.converged ? " " : "!", t.set_up * per_cell,
                t.solve * per_cell, (t.set_up + t.solve) * per_cell);
  };
  std::printf("%-34s", c.name.c_str());
  show("luff", ours);
  std::printf("\n%-34s", "");
  show("hypre", theirs);
  std::printf("   %.1f times luff's\n", (theirs.set_up + theirs.solve) / (ours.set_up + ours.solve));
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  HYPRE_Init();
  std::printf("to 1e-10, ns of processor time per cell; ! = not converged\n");
  std::printf("%-34s  %-6s  %4s  %8s  %8s  %8s\n", "case", "", "its", "set-up", "solve", "together");
  compare({"96^3 uniform", {96, 96, 96}, 1.0, false, false});
  compare({"96^3 uniform, sheet", {96, 96, 96}, 1.0, true, false});
  compare({"96^3 stretched 20:1", {96, 96, 96}, 20.0, false, false});
  compare({"96x64x64 flag, 20:1, sheet, outflow", {96, 64, 64}, 20.0, true, true});
  HYPRE_Finalize();
  MPI_Finalize();
}
