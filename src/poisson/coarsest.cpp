// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/coarsest.hpp"

namespace luff::poisson {

namespace {

/// Number of an unknown in the dense matrix: cells in their order, then extras.
int number(Unknown x, int cells)
{
  return is_cell(x) ? static_cast<int>(x) : cells + extra_number(x);
}

/// Of each column, over some rows.
void remove_means(const std::vector<int>& rows, Eigen::MatrixXd& matrix)
{
  for (auto column : matrix.colwise()) {
    double sum = 0.0;
    for (const int a : rows)
      sum += column[a];
    for (const int a : rows)
      column[a] -= sum / static_cast<double>(rows.size());
  }
}

}  // namespace

void CoarsestSolver::assemble(const Level& level, const Cuts& cuts, Eigen::MatrixXd& A, std::vector<char>& grounded)
{
  const Box& box = level.box();
  const auto [nx, ny, nz] = box.cells();
  const int cells = nx * ny * nz;
  const int n = cells + static_cast<int>(cuts.extras.size());
  A = Eigen::MatrixXd::Zero(n, n);
  grounded.assign(n, 0);
  place_.resize(n);
  const auto add = [&](int a, Unknown to, double c) {
    A(a, a) += c;
    if (to == outside)
      grounded[a] |= static_cast<char>(c > 0.0);
    else
      A(a, number(to, cells)) -= c;
  };
  for (int a = 0; a < cells; ++a) {
    const Index3 cell = box.cell(a);
    place_[a] = level.layout().index(cell[0], cell[1], cell[2]);
    const CutCell* cut = cuts.at(a);
    for (int side = 0; side < 6; ++side) {
      Index3 other;
      const bool inside = box.neighbour(cell, side, other);
      add(a, inside ? box.key(other) : outside, cut != nullptr ? cut->coefficient[side] : box.coefficient(cell, side));
    }
  }
  for (int a = cells; a < n; ++a)
    place_[a] = level.layout().size + (a - cells);
  for (const Link& link : cuts.links)
    add(number(link.from, cells), link.to, link.coefficient);
}

/// Components by flooding from each unknown not yet reached.
void CoarsestSolver::label(const Eigen::MatrixXd& A, const std::vector<char>& grounded)
{
  const int n = static_cast<int>(A.rows());
  component_.assign(n, -1);
  floating_.clear();
  std::vector<int> front;
  for (int start = 0; start < n; ++start) {
    if (component_[start] >= 0)
      continue;
    const int c = static_cast<int>(floating_.size());
    floating_.push_back(1);
    component_[start] = c;
    front.assign(1, start);
    while (!front.empty()) {
      const int a = front.back();
      front.pop_back();
      if (grounded[a] != 0)
        floating_[c] = 0;
      for (int b = 0; b < n; ++b)
        if (A(a, b) < 0.0 && component_[b] < 0) {
          component_[b] = c;
          front.push_back(b);
        }
    }
  }
}

/// The unknowns of each floating component.
std::vector<std::vector<int>> CoarsestSolver::floating_members() const
{
  std::vector<std::vector<int>> members(floating_.size());
  for (int a = 0; a < static_cast<int>(component_.size()); ++a)
    if (floating_[component_[a]] != 0)
      members[component_[a]].push_back(a);
  std::erase_if(members, [](const auto& m) { return m.empty(); });
  return members;
}

/// A^+ = Pi (A + sum_c s v_c v_c^T)^-1 Pi, v_c the unit constant on component c that floats, Pi the projection that
/// removes them.
void CoarsestSolver::factorise(const Level& level, const Cuts& cuts)
{
  Eigen::MatrixXd A;
  std::vector<char> grounded;
  assemble(level, cuts, A, grounded);
  label(A, grounded);
  const auto n = static_cast<int>(A.rows());
  A = 0.5 * (A + A.transpose()).eval();
  const double scale = std::max(A.diagonal().maxCoeff(), 1e-30);
  const std::vector<std::vector<int>> constants = floating_members();
  for (const std::vector<int>& members : constants)
    for (const int a : members)
      for (const int b : members)
        A(a, b) += scale / static_cast<double>(members.size());
  Eigen::MatrixXd inverse = A.llt().solve(Eigen::MatrixXd::Identity(n, n));
  for (int side = 0; side < 2; ++side) {
    for (const std::vector<int>& members : constants)
      remove_means(members, inverse);
    inverse.transposeInPlace();
  }
  inverse_ = (0.5 * (inverse + inverse.transpose())).cast<float>();
  f_.resize(n);
  u_.resize(n);
}

void CoarsestSolver::solve(Level& level) const
{
  const auto n = static_cast<int>(place_.size());
  for (int a = 0; a < n; ++a)
    f_[a] = level.f[place_[a]];
  u_.noalias() = inverse_ * f_;
  for (int a = 0; a < n; ++a)
    level.u[place_[a]] = u_[a];
}

}  // namespace luff::poisson
