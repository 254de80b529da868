// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/petsc_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "poisson/petsc.hpp"

namespace luff::poisson {

namespace {

using petsc::check;

/// Makes the singular matrix of closed domains definite; the refinement of the fluxes removes what it does to them.
constexpr double relative_shift = 1e-9;
constexpr double inner_tolerance = 1e-7;

class PetscSolver final : public PressureSolver {
 public:
  PetscSolver(const grid::Grid& grid, const SideConditions& sides)
      : grid_(grid),
        sides_(sides),
        fluxes_(make_flux_correction(grid, sides)),
        halo_(grid.ranks()),
        number_(grid.owned(), -1),
        component_(grid.owned(), -1),
        net_(grid.owned()),
        correction_(grid.owned()),
        conductance_(make_field3<double>(grid.owned()))
  {
    number_rows();
    rebuild();
  }

  void set_blocked(std::span<const FaceIndex> faces) override
  {
    std::vector<FaceIndex> sorted(faces.begin(), faces.end());
    std::sort(sorted.begin(), sorted.end());
    if (grid_.ranks().max(sorted == blocked_ ? 0.0 : 1.0) == 0.0)
      return;
    blocked_ = std::move(sorted);
    fluxes_->set_blocked(blocked_);
    rebuild();
  }

  Report project(const View3<double>& U, const View<double>& p, double dt, const Target& target) override;
  void subtract_gradient(const View3<double>& U, const View<double>& p, double dt) override;
  [[nodiscard]] int components() const override { return static_cast<int>(floating_.size()); }
  [[nodiscard]] bool is_floating(int component) const override { return floating_[component] != 0; }
  [[nodiscard]] int component_of(const Index3& cell) const override { return component_(cell[0], cell[1], cell[2]); }

 private:
  void rebuild()
  {
    set_conductances();
    assemble();
    flood_components();
    number_components();
    find_floating();
  }
  void number_rows();
  void set_conductances();
  [[nodiscard]] double open_conductance(int axis, const Index3& cell) const;
  void assemble();
  void flood_components();
  void number_components();
  void find_floating();
  [[nodiscard]] bool spread_component(const Index3& c);
  [[nodiscard]] int solve(double scale, int max_iterations);
  void remove_means(const View<double>& p);

  const grid::Grid& grid_;
  SideConditions sides_;
  std::unique_ptr<FluxCorrection> fluxes_;
  HaloExchange halo_;
  Field<int> number_;           // row of the matrix, halo included; -1 beyond the domain
  Field<int> component_;        // of owned cells
  std::vector<char> floating_;  // per component
  Field<double> net_;
  Field<double> correction_;
  Field3<double> conductance_;  // A / d of every face, 0 where closed
  std::vector<FaceIndex> blocked_;
  petsc::Matrix matrix_;
  petsc::Krylov krylov_;
  petsc::Vector solution_, right_hand_side_;
};

template <class Cell>
void for_owned(const IndexBox& box, Cell cell)
{
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i)
        cell(Index3{i, j, k});
}

Index3 beside(Index3 c, int side)
{
  c[side / 2] += side % 2 == 0 ? -1 : 1;
  return c;
}

void PetscSolver::number_rows()
{
  const int count = static_cast<int>(grid_.owned().volume());
  int next = 0;
  MPI_Exscan(&count, &next, 1, MPI_INT, MPI_SUM, grid_.ranks().comm());
  if (grid_.ranks().rank() == 0)
    next = 0;
  for_owned(grid_.owned(), [&](const Index3& c) { number_(c[0], c[1], c[2]) = next++; });
  halo_.exchange({number_.view()});
}

double PetscSolver::open_conductance(int axis, const Index3& cell) const
{
  const int n = grid_.cells()[axis];
  const int face = cell[axis];
  const bool periodic = grid_.ranks().periodic(axis);
  Index3 inner = cell;
  inner[axis] = std::min(face, n - 1);
  const double area = grid_.area(axis, inner[0], inner[1], inner[2]);
  if ((face > 0 && face < n) || periodic)
    return n == 1 ? 0.0 : area / grid_.distance(axis, face);
  const bool dirichlet = sides_[axis][face == 0 ? 0 : 1] == SideCondition::Dirichlet;
  return dirichlet ? area / (0.5 * grid_.width(axis, inner[axis])) : 0.0;
}

void PetscSolver::set_conductances()
{
  for (int a = 0; a < 3; ++a)
    for_owned(grid_.owned().faces(a),
              [&](const Index3& c) { conductance_[a](c[0], c[1], c[2]) = open_conductance(a, c); });
  for (const FaceIndex& face : blocked_)
    conductance_[face.axis](face.cell[0], face.cell[1], face.cell[2]) *= face.open;
}

/// Rows sum_f c_f (p_P - p_N), divided by nothing: the matrix is symmetric.
void PetscSolver::assemble()
{
  matrix_.reset();
  krylov_.reset();
  solution_.reset();
  right_hand_side_.reset();
  const MPI_Comm comm = grid_.ranks().comm();
  const auto rows = static_cast<PetscInt>(grid_.owned().volume());
  check(MatCreateAIJ(comm, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE, 7, nullptr, 6, nullptr, matrix_.out()));
  for_owned(grid_.owned(), [&](const Index3& c) {
    const PetscInt row = number_(c[0], c[1], c[2]);
    double diagonal = 0.0;
    for (int side = 0; side < 6; ++side) {
      const Index3 face = side % 2 == 0 ? c : beside(c, side);
      const double value = conductance_[side / 2](face[0], face[1], face[2]);
      const Index3 other = beside(c, side);
      const PetscInt column = number_(other[0], other[1], other[2]);
      diagonal += value;
      if (column >= 0 && value > 0.0)
        check(MatSetValue(matrix_, row, column, -value, ADD_VALUES));
    }
    check(MatSetValue(matrix_, row, row, diagonal > 0.0 ? diagonal * (1.0 + relative_shift) : 1.0, ADD_VALUES));
  });
  check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatCreateVecs(matrix_, solution_.out(), right_hand_side_.out()));
  check(KSPCreate(comm, krylov_.out()));
  check(KSPSetOperators(krylov_, matrix_, matrix_));
  check(KSPSetType(krylov_, KSPCG));
  check(KSPSetNormType(krylov_, KSP_NORM_UNPRECONDITIONED));
  PC preconditioner = nullptr;
  check(KSPGetPC(krylov_, &preconditioner));
  check(PCSetType(preconditioner, PCGAMG));
}

/// True when the cell took the smaller label of an open neighbour.
bool PetscSolver::spread_component(const Index3& c)
{
  int& own = component_(c[0], c[1], c[2]);
  const int before = own;
  for (int side = 0; side < 6; ++side) {
    const Index3 face = side % 2 == 0 ? c : beside(c, side);
    const Index3 other = beside(c, side);
    const int label = component_(other[0], other[1], other[2]);
    if (label >= 0 && conductance_[side / 2](face[0], face[1], face[2]) > 0.0)
      own = std::min(own, label);
  }
  return own < before;
}

/// Every cell learns the smallest row of its component.
void PetscSolver::flood_components()
{
  const IndexBox& box = grid_.owned();
  for_owned(box, [&](const Index3& c) { component_(c[0], c[1], c[2]) = number_(c[0], c[1], c[2]); });
  bool changed = true;
  while (changed) {
    halo_.exchange({component_.view()});
    bool here = false;
    for_owned(box, [&](const Index3& c) { here |= spread_component(c); });
    for (int k = box.hi[2] - 1; k >= box.lo[2]; --k)
      for (int j = box.hi[1] - 1; j >= box.lo[1]; --j)
        for (int i = box.hi[0] - 1; i >= box.lo[0]; --i)
          here |= spread_component({i, j, k});
    changed = grid_.ranks().max(here ? 1.0 : 0.0) > 0.0;
  }
}

/// Numbers from 0 in place of the smallest rows, in their order of ranks.
void PetscSolver::number_components()
{
  std::vector<int> number(static_cast<std::size_t>(grid_.cells()[0]) * grid_.cells()[1] * grid_.cells()[2], -1);
  int count = 0;
  for_owned(grid_.owned(), [&](const Index3& c) { count += component_of(c) == number_.view()(c) ? 1 : 0; });
  int next = 0;
  int all = 0;
  MPI_Exscan(&count, &next, 1, MPI_INT, MPI_SUM, grid_.ranks().comm());
  MPI_Allreduce(&count, &all, 1, MPI_INT, MPI_SUM, grid_.ranks().comm());
  for_owned(grid_.owned(), [&](const Index3& c) {
    if (component_of(c) == number_.view()(c))
      number[component_of(c)] = next++;
  });
  MPI_Allreduce(MPI_IN_PLACE, number.data(), static_cast<int>(number.size()), MPI_INT, MPI_MAX, grid_.ranks().comm());
  for_owned(grid_.owned(), [&](const Index3& c) { component_.view()(c) = number[component_of(c)]; });
  floating_.assign(all, 1);
}

/// Components float that no Dirichlet side touches.
void PetscSolver::find_floating()
{
  for_owned(grid_.owned(), [&](const Index3& c) {
    for (int side = 0; side < 6; ++side) {
      const Index3 face = side % 2 == 0 ? c : beside(c, side);
      if (number_.view()(beside(c, side)) < 0 && conductance_[side / 2].view()(face) > 0.0)
        floating_[component_of(c)] = 0;
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, floating_.data(), static_cast<int>(floating_.size()), MPI_SIGNED_CHAR, MPI_MIN,
                grid_.ranks().comm());
}

/// Subtracts the volume-weighted mean from floating components.
void PetscSolver::remove_means(const View<double>& p)
{
  std::vector<double> sums(2 * floating_.size(), 0.0);
  for_owned(grid_.owned(), [&](const Index3& c) {
    const double volume = grid_.volume(c[0], c[1], c[2]);
    sums[2 * component_of(c)] += volume * p(c);
    sums[2 * component_of(c) + 1] += volume;
  });
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  for_owned(grid_.owned(), [&](const Index3& c) {
    const int n = component_of(c);
    if (is_floating(n))
      p(c) -= sums[2 * n] / sums[2 * n + 1];
  });
}

/// correction = A^-1 (scale net) to the inner tolerance.
int PetscSolver::solve(double scale, int max_iterations)
{
  PetscScalar* values = nullptr;
  check(VecGetArray(right_hand_side_, &values));
  for_owned(grid_.owned(), [&, n = 0](const Index3& c) mutable { values[n++] = scale * net_(c[0], c[1], c[2]); });
  check(VecRestoreArray(right_hand_side_, &values));
  check(KSPSetTolerances(krylov_, inner_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, max_iterations));
  check(KSPSolve(krylov_, right_hand_side_, solution_));
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(krylov_, &iterations));
  check(VecGetArray(solution_, &values));
  for_owned(grid_.owned(), [&, n = 0](const Index3& c) mutable { correction_(c[0], c[1], c[2]) = values[n++]; });
  check(VecRestoreArray(solution_, &values));
  halo_.exchange({correction_.view()});
  mirror_beyond_sides(grid_, sides_, correction_.view());
  return static_cast<int>(iterations);
}

void PetscSolver::subtract_gradient(const View3<double>& U, const View<double>& p, double dt)
{
  halo_.exchange({p});
  fluxes_->subtract(U, p, dt);
}

Report PetscSolver::project(const View3<double>& U, const View<double>& p, double dt, const Target& target)
{
  const auto nothing = [](int) {};
  const auto to_net = [&](int j, int k, const double* outflow) {
    std::transform(outflow, outflow + grid_.cells()[0], net_.view().row(j, k), std::negate<>());
  };
  const double initial_norm = target.relative > 0.0 ? fluxes_->measure(U, to_net).norm : 0.0;
  halo_.exchange({p});
  const SidePressure given(grid_, sides_, p);
  Outflow outflow = fluxes_->correct<double>(U, p, dt, nothing, to_net);
  Report report;
  while (!meets(outflow, initial_norm, target) && report.iterations < target.max_iterations &&
         std::isfinite(outflow.norm)) {
    const double scale = 1.0 / outflow.norm;
    report.iterations += solve(scale, target.max_iterations - report.iterations);
    const View<const double> e = std::as_const(correction_).view();
    const Outflow corrected = fluxes_->correct<double>(U, e, 1.0 / scale, nothing, to_net);
    ++report.refinements;
    if (!(corrected.norm < 0.9 * outflow.norm)) {
      outflow = fluxes_->correct<double>(U, e, -1.0 / scale, nothing, to_net);
      break;
    }
    outflow = corrected;
    const double to_pressure = 1.0 / (scale * dt);
    for_each_cell(grid_.owned(), [=](int i, int j, int k) { p(i, j, k) += to_pressure * e(i, j, k); });
  }
  remove_means(p);
  given.restore(p);
  halo_.exchange({p});
  report.divergence = relative_divergence(outflow, target);
  report.worst_cell = outflow.worst_cell;
  report.converged = meets(outflow, initial_norm, target);
  return report;
}

}  // namespace

std::unique_ptr<PressureSolver> make_petsc_solver(const grid::Grid& grid, const SideConditions& sides)
{
  return std::make_unique<PetscSolver>(grid, sides);
}

}  // namespace luff::poisson
