// SPDX-License-Identifier: BSD-3-Clause
// Natural frequencies and modes of a shell.
#include "shell/modes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Spectra/SymGEigsShiftSolver.h>

#include "core/error.hpp"
#include "shell/free_unknowns.hpp"
#include "shell/linear_solver.hpp"

namespace luff::shell {

namespace {

double mean_diagonal(const BlockMatrix& A, const std::vector<int>& free)
{
  double sum = 0;
  for (const int i : free)
    sum += A.block(A.pattern().slot(i / 3, i / 3))(i % 3, i % 3);
  return sum / static_cast<double>(free.size());
}

/// The eigenproblem on the free unknowns, made dimensionless: eigenvalues in units of `shift`, masses in units of a
/// mean entry, because the iteration below has absolute thresholds.
class Pencil {
 public:
  Pencil(const Shell& shell, const BlockMatrix& K)
      : shell_(shell),
        unknowns_(shell.held()),
        K_(K),
        M_(shell.pattern()),
        shifted_(K),
        solver_(make_linear_solver(LinearSolverKind::Direct, *shell.pattern(), shell.held()))
  {
    shell_.add_mass(1, M_);
    shell_.supports().decouple(M_);
    mass_unit_ = mean_diagonal(M_, unknowns_.entries());
    shift_ = least_shift * mean_diagonal(K_, unknowns_.entries()) / mass_unit_;
    while (eigenvalues_below(-shift_) > 0)
      shift_ *= 16;
  }

  int size() const { return unknowns_.size(); }
  double shift() const { return shift_; }
  double mass_unit() const { return mass_unit_; }

  /// How many eigenvalues omega^2 lie below this one: the negative pivots of K - omega^2 M (Sylvester's law).
  int eigenvalues_below(double omega_squared)
  {
    shifted_ = K_;
    shifted_.add(-omega_squared, M_);
    return solver_->factorise(shifted_).negative_pivots.value();
  }

  /// b -> (K/shift + M)^-1 b with the matrix factorised last, in units of mass.
  void solve(const double* b, double* u) const
  {
    const Eigen::VectorXd full = solver_->solve(expanded(b));
    Eigen::Map<Eigen::VectorXd>(u, size()) = (shift_ * mass_unit_) * unknowns_.restricted(full);
  }

  void mass_times(const double* x, double* Mx) const
  {
    Eigen::VectorXd v = expanded(x);
    shell_.clear_held(v);
    v = shell_.mass_times(v);
    shell_.clear_held(v);
    Eigen::Map<Eigen::VectorXd>(Mx, size()) = unknowns_.restricted(v) / mass_unit_;
  }

  Eigen::VectorXd expanded(const double* x) const
  {
    return unknowns_.expanded(Eigen::Map<const Eigen::VectorXd>(x, size()));
  }

 private:
  // Keeps K + shift M definite where K has rigid motions: a million times the round-off of K, and less than bending
  // alone makes of the lowest frequency unless the shell is very thin.
  static constexpr double least_shift = 1e-10;

  const Shell& shell_;
  FreeUnknowns unknowns_;
  const BlockMatrix& K_;
  BlockMatrix M_;
  BlockMatrix shifted_;
  std::unique_ptr<LinearSolver> solver_;
  double mass_unit_ = 0;
  double shift_ = 0;
};

/// What Spectra needs of (K - sigma M)^-1 with sigma = -1 in units of the shift.
struct ShiftedInverse {
  using Scalar = double;
  const Pencil& pencil;
  Eigen::Index rows() const { return pencil.size(); }
  Eigen::Index cols() const { return pencil.size(); }
  void set_shift(double) {}  // the pencil is factorised already
  void perform_op(const double* b, double* u) const { pencil.solve(b, u); }
};

struct MassProduct {
  using Scalar = double;
  const Pencil& pencil;
  Eigen::Index rows() const { return pencil.size(); }
  Eigen::Index cols() const { return pencil.size(); }
  void perform_op(const double* x, double* Mx) const { pencil.mass_times(x, Mx); }
};

/// Lanczos with implicit restarts on (K + shift M)^-1 M [sorensen_1992_implicit, ericsson_1980_spectral]; ascending.
bool iterate(const Pencil& pencil, int wanted, int basis, Modes& modes)
{
  constexpr int max_restarts = 300;
  constexpr double tolerance = 1e-11;
  ShiftedInverse inverse{pencil};
  MassProduct mass{pencil};
  Spectra::SymGEigsShiftSolver<ShiftedInverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass,
                                                                                                    wanted, basis, -1);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, max_restarts, tolerance, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    return false;
  modes.omega_squared = pencil.shift() * solver.eigenvalues();
  const Eigen::MatrixXd shapes = solver.eigenvectors() / std::sqrt(pencil.mass_unit());
  modes.shapes.resize(pencil.expanded(shapes.data()).size(), wanted);
  for (int k = 0; k < wanted; ++k)
    modes.shapes.col(k) = pencil.expanded(shapes.col(k).data());
  return true;
}

/// Is the number of eigenvalues below the widest gap at or above `count` the one found? Lanczos may miss copies of
/// multiple eigenvalues.
bool is_complete(Pencil& pencil, const Modes& modes, int count)
{
  int below = count;
  const auto gap = [&](int k) { return modes.omega_squared[k] - modes.omega_squared[k - 1]; };
  for (int k = count + 1; k < modes.count(); ++k)
    if (gap(k) > gap(below))
      below = k;
  const double middle = 0.5 * (modes.omega_squared[below - 1] + modes.omega_squared[below]);
  return pencil.eigenvalues_below(middle) == below;
}

Modes lanczos(const Shell& shell, const BlockMatrix& K, int count)
{
  // Some more than asked, to see where the next eigenvalues are.
  constexpr int more = 4;
  Pencil pencil(shell, K);
  const int wanted = count + more;
  for (int basis = std::max(2 * wanted, wanted + 20); basis < pencil.size(); basis *= 2) {
    Modes modes;
    if (iterate(pencil, wanted, basis, modes) && is_complete(pencil, modes, count))
      return {modes.omega_squared.head(count), modes.shapes.leftCols(count)};
    (void)pencil.eigenvalues_below(-pencil.shift());  // factorise for the next iteration again
  }
  fail_run("shell '{}': the {} lowest modes did not converge; ask for fewer or more", shell.name(), count);
}

Modes dense_modes(const Shell& shell, const BlockMatrix& K, int count)
{
  const FreeUnknowns unknowns(shell.held());
  const std::vector<int>& free = unknowns.entries();
  BlockMatrix M(shell.pattern());
  shell.add_mass(1, M);
  shell.supports().decouple(M);
  const Eigen::MatrixXd K_free = K.dense()(free, free), M_free = M.dense()(free, free);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K_free, M_free);
  Modes modes{solver.eigenvalues().head(count), Eigen::MatrixXd::Zero(3 * shell.n_vertices(), count)};
  modes.shapes(free, Eigen::all) = solver.eigenvectors().leftCols(count);
  return modes;
}

/// The sign of a mode is free; the largest component, the first of equals to round-off, is made positive.
void fix_signs(Eigen::MatrixXd& shapes)
{
  constexpr double equal = 1 - 1e-6;
  for (auto shape : shapes.colwise()) {
    const double largest = equal * shape.cwiseAbs().maxCoeff();
    const auto first = std::find_if(shape.begin(), shape.end(), [&](double u) { return std::abs(u) >= largest; });
    if (*first < 0)
      shape *= -1;
  }
}

}  // namespace

double Modes::angular_frequency(int k) const
{
  return std::copysign(std::sqrt(std::abs(omega_squared[k])), omega_squared[k]);
}

Vec3 Modes::mass_share(const Shell& shell, int k) const
{
  const Eigen::VectorXd M_phi = shell.mass_times(shapes.col(k));
  Vec3 share;
  for (int d = 0; d < 3; ++d) {
    Eigen::VectorXd e = Eigen::VectorXd::Zero(M_phi.size());
    for (Eigen::Index i = d; i < e.size(); i += 3)
      e[i] = 1;
    share[d] = std::pow(e.dot(M_phi), 2) / e.dot(shell.mass_times(e));
  }
  return share;
}

void check_modes(const Shell& shell, int count)
{
  const auto n_free = FreeUnknowns(shell.held()).size();
  if (count < 1 || count > n_free)
    fail_input("shell '{}': modes = {} must be from 1 to {}, the number of its free displacements", shell.name(), count,
               n_free);
  if (!(shell.mass_times(Eigen::VectorXd::Ones(3 * shell.n_vertices())).minCoeff() > 0))
    fail_input("shell '{}': density = 0 gives no vibrations; it must be above 0", shell.name());
}

Modes natural_modes(const Shell& shell, const BlockMatrix& stiffness, int count)
{
  check_modes(shell, count);
  // What is held along no axis vibrates alone, far above all else.
  constexpr double far_above = 1e6;
  BlockMatrix K = stiffness;
  shell.supports().decouple(K, far_above);
  // Below this, or when many of all modes are wanted, the dense solver is as fast and needs no shift.
  constexpr int small = 150;
  const auto n_free = FreeUnknowns(shell.held()).size();
  Modes modes = n_free < small || count > n_free / 4 ? dense_modes(shell, K, count) : lanczos(shell, K, count);
  fix_signs(modes.shapes);
  return modes;
}

Modes natural_modes(const Shell& shell, int count)
{
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  return natural_modes(shell, K, count);
}

}  // namespace luff::shell
