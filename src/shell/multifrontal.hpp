// SPDX-License-Identifier: BSD-3-Clause
// Sparse symmetric factorisation A = L D L' by dense fronts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace luff::shell {

/// Upper triangle of a symmetric matrix in compressed columns: rows of column j are row[start[j]] .. row[start[j +
/// 1]-1].
struct UpperTriangle {
  std::vector<int> start;
  std::vector<int> row;

  int size() const { return static_cast<int>(start.size()) - 1; }
};

/// Analysed once, factorised as often as needed; multifrontal [duff_1983_multifrontal] without pivoting, so for
/// indefinite matrices too as long as no pivot vanishes. Dense work is Eigen's on one thread: the same bits on any
/// number of threads and with any BLAS.
class Multifrontal {
 public:
  /// Ordered by minimum degree or nested dissection, whichever fills in less.
  explicit Multifrontal(const UpperTriangle& pattern);

  /// `values` in the order of the pattern's rows. False when a pivot is zero or no number.
  bool factorise(std::span<const double> values);
  /// Pivots below zero of the last factorisation, as many as A has negative eigenvalues (Sylvester's law).
  int n_negative_pivots() const { return n_negative_pivots_; }
  /// b := A^-1 b with the last factorisation.
  void solve(Eigen::VectorXd& b) const;

 private:
  /// Columns first .. first + n_pivots - 1 of L, which share the rows below them. The panel of n_rows x n_pivots
  /// numbers holds L below the diagonal and D on it.
  struct Front {
    int first = 0;
    int n_pivots = 0;
    int n_rows = 0;
    std::size_t rows = 0;   ///< where its row numbers start in rows_; its own columns come first
    std::size_t panel = 0;  ///< where its panel starts in L_
    std::size_t n_children = 0;

    int n_below() const { return n_rows - n_pivots; }
  };
  using Panel = Eigen::Map<Eigen::MatrixXd>;
  using ConstPanel = Eigen::Map<const Eigen::MatrixXd>;

  void analyse(const UpperTriangle& pattern);
  void place_entries(const UpperTriangle& pattern);
  void count_children();
  std::size_t stack_size() const;
  Panel panel(const Front& f) { return {L_.data() + f.panel, f.n_rows, f.n_pivots}; }
  ConstPanel panel(const Front& f) const { return {L_.data() + f.panel, f.n_rows, f.n_pivots}; }
  void add_child(const Front& child, const double* update, const Front& parent, double* parent_update);
  bool eliminate(const Front& f);
  void update_below(const Front& f, double* update);

  std::vector<int> permuted_;  ///< place of each unknown in the order of elimination
  std::vector<Front> fronts_;  ///< children before parents, each after all that it needs
  std::vector<int> rows_;
  std::vector<std::size_t> place_;  ///< in L_, of each entry of A
  std::vector<double> L_;
  std::vector<double> stack_;  ///< what fronts leave for their parents
  std::vector<int> local_;     ///< row of the current front, of each row of L
  Eigen::MatrixXd scaled_;     ///< L D of the current front
  int n_negative_pivots_ = 0;
};

}  // namespace luff::shell
